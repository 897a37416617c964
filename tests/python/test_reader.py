"""The Python package gives back what riesel has written, and says what is not there."""

import csv
import json
import math
import re
import shutil
import statistics

import h5py
import numpy as np
import riesel

from riesel_command import SMALL_TUBE, CommandTest, saved_step
from seal import changed_behind_seal

IMPACTS = """\
scenario: wall_array
contact: {stiffness: 2000 N/m, restitution: 0.7}
impact: {starts: 3, normal_velocity: 0.1 m/s, axial_velocity: [0.5 m/s, 30 m/s]}
"""
COLUMN = """\
scenario: bead_column
contact: {stiffness: 2000 N/m, restitution: 0.9}
column: {beads: 3, gap_ratio: [0.1, 10]}
"""
SWEEP = """\
base: tube.yaml
set: {run.duration: 3 ms}
axes: {contact.restitution: [0.7, 0.9], contact.law: [linear]}
branches: {slow: {start.axial_velocity: 1 m/s}, fast: {start.axial_velocity: 3 m/s}}
"""


class Flow(CommandTest):
    """A run that was resumed."""

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        directory = maker.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        maker.resume_to_end(directory, "--set", "run.duration=30 ms")
        cls.directory = directory
        cls.run_of_it = riesel.Run(directory)

    def file(self):
        return h5py.File(self.directory / "run.h5", "r")

    def test_the_summary_is_that_of_the_file(self):
        summary = self.run_of_it.summary
        flat = {}

        def add(prefix, values):
            for name, value in values.items():
                if isinstance(value, dict):
                    add(f"{prefix}{name}.", value)
                else:
                    flat[prefix + name] = value

        add("", json.loads((self.directory / "summary.json").read_text(encoding="utf-8")))
        self.assertEqual(dict(summary), flat)
        self.assertEqual(len(summary), len(flat))
        self.assertEqual(summary["balance.errors"]["n_dot"], flat["balance.errors.n_dot"])

    def test_an_unknown_name_is_a_key_error(self):
        for name in ("grain", "balance.x", "grains.x"):
            with self.assertRaises(KeyError):
                self.run_of_it.summary[name]

    def test_estimates_have_errors_and_unknown_ones_are_not_a_number(self):
        mean = self.run_of_it.estimate("mean_axial_velocity")
        self.assertEqual(mean, (self.run_of_it.summary["mean_axial_velocity.value"],
                                self.run_of_it.summary["mean_axial_velocity.error"]))
        unknown = riesel.Run(self.directory)
        unknown.summary = riesel.Tree({"x": {"value": 2.0, "error": None}})
        self.assertEqual(unknown.estimate("x").value, 2.0)
        self.assertTrue(math.isnan(unknown.estimate("x").error))

    def test_estimates_of_the_balance_have_the_errors_that_stand_beside_it(self):
        balance = json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))["balance"]
        for name in ("n_dot", "dv_y", "n_dot_dv_y"):
            self.assertEqual(self.run_of_it.estimate(f"balance.{name}"),
                             (balance[name], balance["errors"][name]))
            self.assertGreater(balance["errors"][name], 0.0)

    def test_an_estimate_of_what_has_no_error_is_a_key_error(self):
        for name in ("grains", "state", "balance", "balance.gravity", "balance.x", "x"):
            with self.assertRaisesRegex(KeyError, f"{name}: .*no such value with an error"):
                self.run_of_it.estimate(name)

    def test_settings_are_the_effective_ones_in_si_units(self):
        settings = self.run_of_it.settings
        self.assertEqual(settings["tube.width"], 0.01)
        self.assertEqual(settings["run.duration"], 0.03)
        self.assertEqual(settings["contact"]["law"], "linear")
        self.assertIs(type(settings["grains.mass"]), float)

    def test_tables_are_those_of_the_file(self):
        run = self.run_of_it
        with self.file() as file:
            for table, group in ((run.series, file["series"]), (run.profiles, file["profiles"]),
                                 (run.final.grains, file["final"]),
                                 (run.final.contacts, file["final/contacts"]),
                                 (run.final.walls, file["final/walls"])):
                names = [name for name in group if isinstance(group[name], h5py.Dataset)]
                self.assertEqual(sorted(table), sorted(names))
                for name in names:
                    np.testing.assert_array_equal(table[name], group[name][()])
                    self.assertEqual(table.unit[name], group[name].attrs["unit"].decode())
        self.assertEqual(run.series.label("mean_vy"), "mean_vy (m/s)")
        self.assertEqual(run.series.label("contacts"), "contacts")

    def test_a_column_that_is_not_there_is_a_key_error_with_those_like_it(self):
        series = self.run_of_it.series
        with self.assertRaisesRegex(KeyError, "mean_v: there is no such column; there is .*mean_vy"):
            series["mean_v"]
        with self.assertRaisesRegex(KeyError, f"xyz: there is no such column; there is {', '.join(sorted(series))}"):
            series["xyz"]

    def test_the_final_state(self):
        final = self.run_of_it.final
        self.assertEqual((final.width, final.length), (0.01, 0.01))
        self.assertEqual(final.step, self.run_of_it.summary["steps"])
        self.assertEqual(final.time, self.run_of_it.summary["time"])
        self.assertEqual(final.grains["velocity"].shape, (self.run_of_it.summary["grains"], 2))
        self.assertTrue(np.all(np.diff(final.grains["id"]) > 0))

    def test_the_trajectory(self):
        trajectory, final = self.run_of_it.trajectory, self.run_of_it.final
        with h5py.File(self.directory / "trajectory.h5", "r") as file:
            written = file["particles/grains"]
            self.assertEqual(len(trajectory), len(written["position/time"]))
            np.testing.assert_array_equal(trajectory[-2].position,
                                          written["position/value"][-2, :, :2])
            self.assertEqual([frame.step for frame in trajectory],
                             written["velocity/step"][()].tolist())
        self.assertGreater(len(trajectory), 20)
        self.assertEqual(len(trajectory[3:5]), 2)
        self.assertEqual(trajectory[4].time, trajectory.time[4])
        np.testing.assert_array_equal(trajectory.radius, final.grains["radius"])
        self.assertEqual(trajectory[0].wall_position.shape, (sum(final.walls["count"]), 2))
        self.assertFalse(trajectory.walls_move)
        self.assertEqual(set(trajectory[0].wall_position[:, 0]), {0.0, np.float32(0.01)})
        self.assertIsNone(trajectory[0].spin)
        with self.assertRaises(IndexError):
            trajectory[len(trajectory)]

    def test_what_holds_arrays_is_equal_to_itself_only(self):
        one, other = self.run_of_it, riesel.Run(self.directory)
        for of in (lambda run: run.trajectory[0], lambda run: run.final, lambda run: run.series,
                   lambda run: run.histograms["wall_contact_duration"]):
            mine, same = of(one), of(other)
            self.assertEqual((mine == mine, mine == same), (True, False))
            self.assertIn(mine, {mine})

    def test_histograms(self):
        with self.file() as file:
            self.assertEqual(sorted(self.run_of_it.histograms), sorted(file["histograms"]))
            written = file["histograms/grain_contact_duration"]
            histogram = self.run_of_it.histograms["grain_contact_duration"]
            np.testing.assert_array_equal(histogram.count, written["count"][()])
            np.testing.assert_array_equal(histogram.rate_error, written["rate_error"][()])
        self.assertGreater(histogram.count.sum(), 0)
        np.testing.assert_array_equal(histogram.edges[4:], 2.0 * histogram.edges[:-4])
        self.assertEqual(histogram.unit, "s")

    def test_the_verdict_with_its_reasons(self):
        validity = self.run_of_it.validity
        self.assertEqual(validity.verdict, self.run_of_it.summary["validity.verdict"])
        worst = {finding.verdict for finding in validity.findings}
        self.assertIn(validity.verdict, worst)
        self.assertEqual([finding.name for finding in validity.reasons()],
                         [finding.name for finding in validity.findings
                          if finding.verdict in ("suspect", "unphysical")])

    def test_findings_may_come_to_tell_more(self):
        run = riesel.Run(self.directory)
        findings = [{**finding, "sigma": 1.0} for finding in run.summary["validity.findings"]]
        run.summary = riesel.Tree({"validity": {"verdict": "valid", "findings": findings}})
        self.assertEqual(run.validity.findings, self.run_of_it.validity.findings)

    def test_provenance_of_the_start_and_of_each_resumption(self):
        run = self.run_of_it
        self.assertIn(" run ", run.provenance["command"])
        self.assertEqual(["resume" in each["command"] for each in run.resumptions], [True])
        self.assertEqual(run.provenance["git_commit"], run.summary["commit"])


class TrajectoryOfMore(CommandTest):
    """Of grains that rotate, between walls that are shaken across the tube."""

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        directory = maker.run_small_tube(
            "run", "--set", "output.trajectory_interval=1 ms", "--set", "grains.rotation=disc",
            "--set", "wall.shake_amplitude=0.1 mm", "--set", "wall.shake_frequency=100 Hz",
            "--set", "wall.shake_angle=90 degrees")
        cls.final = riesel.Run(directory).final
        cls.frames = riesel.Run(directory).trajectory
        cls.file = h5py.File(directory / "trajectory.h5", "r")
        cls.addClassCleanup(cls.file.close)

    def test_radii_and_masses(self):
        self.assertEqual(len(set(self.frames.radius)), len(self.frames.radius))
        np.testing.assert_array_equal(self.frames.mass, self.final.grains["mass"])
        # 1 mg of 1 mm, by area.
        np.testing.assert_allclose(self.frames.mass, 1e-6 * (self.frames.radius / 0.5e-3) ** 2,
                                   rtol=1e-12)
        np.testing.assert_array_equal(self.frames.wall_radius,
                                      np.full(sum(self.final.walls["count"]), 0.33e-3))

    def test_spins(self):
        written = self.file["particles/grains/spin/value"]
        for i, frame in enumerate(self.frames):
            np.testing.assert_array_equal(frame.spin, written[i])
        self.assertEqual(self.frames[0].spin.tolist(), [0.0] * len(self.frames.radius))
        self.assertTrue(np.any(self.frames[-1].spin))

    def test_walls_are_where_they_have_moved_to(self):
        self.assertTrue(self.frames.walls_move)
        left, right = self.final.walls["count"]
        at_rest = np.repeat([0.0, 0.01], [left, right])
        for frame in self.frames:
            swing = 1e-4 * math.sin(2.0 * math.pi * 100.0 * frame.time)
            np.testing.assert_allclose(frame.wall_position[:, 0], at_rest + swing, atol=2e-9)
            np.testing.assert_array_equal(frame.wall_position[:, 1],
                                          self.frames[0].wall_position[:, 1])


class GrowingTrajectory(CommandTest):

    def test_a_loop_over_frames_outlives_the_checkpoints_of_a_run_that_goes_on(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=0.05 ms")
        frames = riesel.Run(directory).trajectory
        loop = iter(frames)
        next(loop)
        # Each ends with a checkpoint, and every other one is written over what was read.
        for duration in (10, 15, 20):
            self.resume_to_end(directory, "--set", f"run.duration={duration} ms")
        grown = riesel.Run(directory).trajectory
        self.assertGreater(len(grown), len(frames))
        rest = list(loop)
        self.assertEqual(len(rest), len(frames) - 1)
        for frame, same in zip(rest, grown[1:]):
            np.testing.assert_array_equal(frame.position, same.position)


class Impacts(CommandTest):

    def test_a_curve_and_no_flow(self):
        run = riesel.Run(self.run_to_end(self.write("wall.yaml", IMPACTS), "out"))
        points = run.summary["curve"]
        for name in ("v_y", "dv_y", "contacts"):
            np.testing.assert_array_equal(run.curve[name], [point[name] for point in points])
        self.assertEqual(run.curve["verdict"].tolist(), [0.0, 2.0])
        self.assertEqual([point["verdict"] for point in points], ["valid", "unphysical"])
        for part in ("profiles", "histograms", "validity"):
            with self.assertRaisesRegex(riesel.NotThere, "out.*; "):
                getattr(run, part)
        for part in ("series", "final", "trajectory"):
            with self.assertRaisesRegex(riesel.NotThere, "out.*; only flows have one"):
                getattr(run, part)

    def test_a_column_of_beads_has_a_curve_and_no_verdict_of_all(self):
        run = riesel.Run(self.run_to_end(self.write("column.yaml", COLUMN), "out"))
        points = run.summary["column"]
        self.assertEqual(len(points), 2)
        for name in ("gap", "restitution", "contacts"):
            np.testing.assert_array_equal(run.curve[name], [point[name] for point in points])
        with self.assertRaisesRegex(riesel.NotThere, r"columns of beads .* see curve\['verdict'\]"):
            run.validity
        with self.assertRaisesRegex(riesel.NotThere, "run.h5: has no series; only flows have one"):
            run.series

    def test_of_those_that_were_stopped_none_is_told_to_be_resumed(self):
        self.run_to_end(self.write("wall.yaml", IMPACTS), "out")
        for name in ("run.h5", "summary.json"):  # come last
            (self.home / "out" / name).unlink()
        run = riesel.Run(self.home / "out")
        for part in ("curve", "summary"):
            with self.assertRaisesRegex(riesel.NotThere, "start it again if it was stopped") as told:
                getattr(run, part)
            self.assertNotIn("resume", str(told.exception))
        self.assert_refused(self.riesel("resume", "out"))


class NotThere(CommandTest):

    def test_what_is_no_run(self):
        with self.assertRaisesRegex(riesel.NotThere, "nowhere: is not a directory; "):
            riesel.Run(self.home / "nowhere")
        empty = riesel.Run(self.home)
        self.assertFalse(empty.is_done)
        for part in ("summary", "settings", "series", "provenance"):
            with self.assertRaisesRegex(riesel.NotThere, "is not there; "):
                getattr(empty, part)
        with self.assertRaisesRegex(riesel.NotThere, "manifest.json: is not there; "):
            riesel.Sweep(self.home)

    def unfinished_run(self):
        self.write("tube.yaml", SMALL_TUBE.replace("5 ms", "1000 s"))
        result = self.riesel("run", "tube.yaml", "--out", "run", "--max-walltime", "1 s")
        self.assertEqual(result.returncode, 3, result)
        return riesel.Run(self.home / "run")

    def test_a_run_that_is_not_over(self):
        run = self.unfinished_run()
        self.assertFalse(run.is_done)
        self.assertGreater(len(run.series["time"]), 1)
        with self.assertRaisesRegex(riesel.NotThere, "summary.json.*riesel resume"):
            run.summary
        with self.assertRaisesRegex(riesel.NotThere, "come to their end"):
            run.profiles
        with self.assertRaisesRegex(riesel.NotThere, "only impact scenarios and bead_column"):
            run.curve

    def test_the_state_of_a_run_that_is_not_over_is_that_of_its_checkpoint(self):
        run = self.unfinished_run()
        self.assertEqual(run.final.step, saved_step(run.directory))
        self.assertGreater(run.final.step, 0)
        self.assertGreaterEqual(run.final.time, run.series["time"][-1])


class Unreadable(CommandTest):
    """What is damaged is told with the path and a remedy."""

    def assert_unreadable(self, path, read, remedy):
        with self.assertRaisesRegex(riesel.Unreadable, rf"{path}: .*; {remedy}"):
            read()

    @staticmethod
    def cut_in_half(path):
        path.write_bytes(path.read_bytes()[:path.stat().st_size // 2])

    def test_files_of_a_run(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        frames = riesel.Run(directory).trajectory
        for name in ("run.h5", "trajectory.h5", "summary.json"):
            self.cut_in_half(directory / name)
        (directory / "effective.yaml").write_text("contact: {", encoding="utf-8")
        run = riesel.Run(directory)
        for name, parts in (("run.h5", ("series", "profiles", "histograms", "final", "provenance")),
                            ("trajectory.h5", ("trajectory",)), ("summary.json", ("summary",)),
                            ("effective.yaml", ("settings",))):
            of_summary = name == "summary.json"
            anew = "make it anew by 'riesel resume" if of_summary else "make the run again"
            for part in parts:
                self.assert_unreadable(directory / name, lambda: getattr(run, part),
                                       f"restore the file, or {anew}")
        self.assert_unreadable(directory / "trajectory.h5", lambda: list(frames), "restore")

    def test_files_that_hold_something_else(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        for name in ("summary.json", "effective.yaml"):
            (directory / name).write_text("[1, 2]", encoding="utf-8")
        with changed_behind_seal(directory / "run.h5") as file:
            del file["final"].attrs["time"]
        with h5py.File(directory / "trajectory.h5", "w"):
            pass
        run = riesel.Run(directory)
        for name, part in (("summary.json", "summary"), ("effective.yaml", "settings"),
                           ("run.h5", "final"), ("trajectory.h5", "trajectory")):
            self.assert_unreadable(directory / name, lambda: getattr(run, part), "restore")

    def test_what_is_nested_without_end(self):
        directory = self.run_small_tube("run")
        for name, part in (("summary.json", "summary"), ("effective.yaml", "settings")):
            (directory / name).write_text("[" * 100_000, encoding="utf-8")
            self.assert_unreadable(directory / name, lambda: getattr(riesel.Run(directory), part), "restore")

    def test_a_directory_in_the_place_of_a_file(self):
        directory = self.run_small_tube("run")
        (directory / "summary.json").unlink()
        (directory / "summary.json").mkdir()
        self.assert_unreadable(directory / "summary.json", lambda: riesel.Run(directory).summary, "restore")

    def test_findings_that_are_none(self):
        directory = self.run_small_tube("run")
        summary = self.summary(directory)
        for findings in (None, [None], [{"value": 1.0}], [1]):
            summary["validity"]["findings"] = findings
            (directory / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
            self.assert_unreadable(directory / "summary.json", lambda: riesel.Run(directory).validity, "restore")

    def test_numbers_in_the_place_of_groups(self):
        directory = self.run_small_tube("run")
        for part in ("series", "profiles", "histograms", "provenance", "final"):
            with changed_behind_seal(directory / "run.h5") as file:
                del file[part]
                file[part] = 1.0
            self.assert_unreadable(directory / "run.h5", lambda: getattr(riesel.Run(directory), part), "restore")
        with changed_behind_seal(directory / "run.h5") as file:
            del file["series"]
            file["series"] = [1.0, 2.0]
        self.assert_unreadable(directory / "run.h5", lambda: riesel.Run(directory).series, "restore")

    def test_a_changed_bit_behind_the_seal(self):
        path = self.run_small_tube("run") / "run.h5"
        good = path.read_bytes()
        for place in (512, 512 + 97, len(good) // 2, len(good) - 1):
            bad = bytearray(good)
            bad[place] ^= 1
            path.write_bytes(bad)
            self.assert_unreadable(path, lambda: riesel.Run(path.parent).provenance, "restore")

    def test_seals_of_riesel_0_10_say_nothing_to_python(self):
        path = self.run_small_tube("run") / "run.h5"
        good = path.read_bytes()
        time = riesel.Run(path.parent).final.time
        line = re.compile(rb"CRC-32 .*\n")
        self.assertRegex(good[:512], line)
        path.write_bytes(line.sub(b"", good[:512]).ljust(512, b"\0") + good[512:])
        self.assertEqual(riesel.Run(path.parent).final.time, time)

    def test_a_summary_of_another_format(self):
        directory = self.run_small_tube("run")
        summary = self.summary(directory) | {"version": "0.3.9"}
        later = json.dumps(summary | {"format": 3})
        del summary["format"]
        for number, text in ((1, json.dumps(summary)), (3, later)):
            (directory / "summary.json").write_text(text, encoding="utf-8")
            self.assert_unreadable(
                directory / "summary.json", lambda: riesel.Run(directory).summary,
                "use the package of that riesel, or make the run again")
            with self.assertRaisesRegex(riesel.Unreadable,
                                        rf"format {number} of riesel 0\.3\.9, .* reads 2;"):
                riesel.Run(directory).estimate("mean_axial_velocity")

    def test_files_of_a_sweep(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        out = self.home / "out"
        sweep = riesel.Sweep(out)
        self.write("out/sweep.h5", "no HDF5")
        self.assert_unreadable(out / "sweep.h5", lambda: sweep.table, "make it with 'riesel collect")
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
        unset = json.loads(json.dumps(manifest).replace('"settings": {', '"settings": null, "x": {'))
        del manifest["points"][1]["branch"]
        for text in (json.dumps(manifest), "{}", "[]", '{"varied": 1}', '{"varied', json.dumps(unset),
                     "[" * 100_000):
            self.write("out/manifest.json", text)
            self.assert_unreadable(out / "manifest.json", lambda: riesel.Sweep(out),
                                   "run 'riesel sweep' with its sweep file")


class OfSweep(CommandTest):

    def test_mean_profiles_over_seeds(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP.replace("3 ms", "20 ms") + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        fast = sweep.mean_profiles()[3]
        self.assertNotEqual(fast, sweep.mean_profiles()[3])
        self.assertEqual((fast.settings["contact.restitution"], fast.branch, fast.runs, fast.steady), (0.9, "fast", 3, 0))
        tables = [point.run.profiles for point in sweep.points
                  if (point.settings["contact.restitution"], point.branch) == (0.9, "fast")]
        self.assertEqual(set(fast.profiles), set(tables[0]))
        np.testing.assert_array_equal(fast.profiles["x"], tables[0]["x"])
        for name in ("area_fraction", "stress_yy"):
            values = np.array([table[name] for table in tables])
            np.testing.assert_allclose(fast.profiles[name], values.mean(axis=0), rtol=1e-12)
            np.testing.assert_allclose(fast.profiles[f"{name}_error"], 1.321 * values.std(axis=0, ddof=1) / 3 ** 0.5, rtol=1e-3)
        self.assertEqual(fast.profiles.label("stress_yy"), "stress_yy (N/m)")
        # One run less, one that is steady and has a strip without grains, and then one that has other strips.
        points = self.home / "out/points"
        (points / sweep.points[0].name / "summary.json").unlink()
        last = points / sweep.points[-1].name
        summary = json.loads((last / "summary.json").read_text(encoding="utf-8"))
        summary["validity"]["verdict"] = "valid"
        (last / "summary.json").write_text(json.dumps(summary | {"state": "steady"}), encoding="utf-8")
        with changed_behind_seal(last / "run.h5") as file:
            file["profiles/temperature_x"][0] = np.nan
        means = riesel.Sweep(self.home / "out").mean_profiles()
        self.assertEqual([(mean.runs, mean.steady) for mean in means], [(2, 0), (3, 0), (3, 0), (3, 1)])
        verdicts = [table["validity.verdict"] for table in (point.run.summary for point in sweep.points[-3:])]
        self.assertEqual(means[3].valid, verdicts[:2].count("valid") + 1)
        others = [table["temperature_x"][0] for table in tables[:-1]]
        self.assertAlmostEqual(means[3].profiles["temperature_x"][0], statistics.mean(others), places=12)
        with changed_behind_seal(last / "run.h5") as file:
            file["profiles/x"][:] *= 2.0
        with self.assertRaisesRegex(ValueError, "its strips differ from those of") as told:
            riesel.Sweep(self.home / "out").mean_profiles()
        self.assertIs(type(told.exception), ValueError)  # nothing is missing or damaged

    def test_mean_profiles_of_what_has_not_begun(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        planned = riesel.Sweep(self.home / "out").mean_profiles()
        self.assertEqual([(mean.runs, len(mean.profiles)) for mean in planned], [(0, 0)] * 4)

    def test_means_over_seeds(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        column = "mean_axial_velocity.value"
        means = sweep.means(column)
        self.assertEqual([(mean.settings["contact.restitution"], mean.branch) for mean in means],
                         [(0.7, "slow"), (0.7, "fast"), (0.9, "slow"), (0.9, "fast")])
        for mean in means:
            values = [point.run.summary[column] for point in sweep.points
                      if (point.settings["contact.restitution"], point.branch)
                      == (mean.settings["contact.restitution"], mean.branch)]
            self.assertNotIn("seed", mean.settings)
            valid = [point for point in sweep.points if point.settings["contact.restitution"] == mean.settings[
                "contact.restitution"] and point.branch == mean.branch and point.run.validity.verdict == "valid"]
            self.assertEqual((mean.runs, mean.steady, mean.valid), (3, 0, len(valid)))
            self.assertIn(f"(3 runs, 0 steady, {len(valid)} valid)", str(mean))
            self.assertAlmostEqual(mean.value, statistics.mean(values), places=12)
            self.assertAlmostEqual(mean.error, 1.321 * statistics.stdev(values) / 3 ** 0.5, delta=0.001 * mean.error)
        (single,) = {mean.runs for mean in sweep.means(column, over="contact.restitution")}
        self.assertEqual(single, 2)
        (self.home / "out/points" / sweep.points[0].name / "summary.json").unlink()
        self.assert_done(self.riesel("collect", "out"))
        self.assertEqual([mean.runs for mean in riesel.Sweep(self.home / "out").means(column)], [2, 3, 3, 3])
        for wrong in ((column, "gravity"), ("no.such", "seed"), ("state", "seed")):
            with self.assertRaises(riesel.NotThere):
                sweep.means(*wrong)
        # A point more in the plan, and the table of before.
        before = sweep.means(column)
        self.write("sweep.yaml", (SWEEP + "seeds: 3\n").replace("[0.7, 0.9]", "[0.6, 0.7, 0.9]"))
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        with self.assertRaisesRegex(riesel.NotThere, "riesel collect"):
            riesel.Sweep(self.home / "out").means(column)
        self.assert_done(self.riesel("collect", "out"))
        after = riesel.Sweep(self.home / "out").means(column)
        self.assertEqual([mean.runs for mean in after], [0, 0, 2, 3, 3, 3])
        self.assertEqual([mean.value for mean in after[3:]], [mean.value for mean in before[1:]])

    def test_points_and_table(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        planned = riesel.Sweep(self.home / "out")
        self.assertEqual([point.status for point in planned.points], ["waiting"] * 4)
        self.assertFalse(planned.points[0].is_done)
        with self.assertRaisesRegex(riesel.NotThere, "riesel collect"):
            planned.table

        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        self.assertEqual([point.status for point in sweep.points], ["done"] * 4)
        self.assertEqual([point.is_done for point in sweep.points], [True] * 4)
        self.assertEqual([point.branch for point in sweep.points], ["slow", "fast"] * 2)
        self.assertEqual([point.settings["contact.restitution"] for point in sweep.points],
                         [0.7, 0.7, 0.9, 0.9])
        self.assertEqual(sweep.varied["start.axial_velocity"], "m/s")
        self.assertEqual([point.run.estimate("mean_axial_velocity").value for point in sweep.points],
                         sweep.table["mean_axial_velocity.value"].tolist())
        with open(self.home / "out/sweep.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(sorted(sweep.table), sorted(rows[0]))
        self.assertEqual(sweep.table["state_hash"].tolist(), [row["state_hash"] for row in rows])
        self.assertEqual(sweep.table["energy.residual"].tolist(),
                         [float(row["energy.residual"]) for row in rows])
        shutil.rmtree(sweep.points[1].directory)
        self.assertEqual([point.is_done for point in sweep.points], [True, False, True, True])
        with self.assertRaisesRegex(riesel.NotThere, "is not a directory"):
            sweep.points[1].run
