"""The Python package gives back what riesel has written."""

import json
import math

import h5py
import numpy as np
import riesel

from riesel_command import CommandTest

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

    def test_an_unknown_name_is_a_key_error_with_those_like_it(self):
        for name, meant in (("grain", "grains"), ("balance.x", "balance.n_dot"), ("grains.x", "grains"),
                            ("mean_velocity", "mean_axial_velocity.value")):
            with self.assertRaisesRegex(KeyError, f"{name}: there is no such value; there is .*{meant}"):
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
        for name in ("mean_velocity", "mean_axial_velocity.value"):
            with self.assertRaisesRegex(KeyError, "; there is mean_axial_velocity\\b"):
                self.run_of_it.estimate(name)
        for name in ("balance.ndot", "balance.n_dot_dvy"):
            with self.assertRaisesRegex(KeyError, "there is .*balance.n_dot"):
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
        self.assertEqual(run.summary["structure_factor"][1]["value"], run.summary["structure_factor.1.value"])
        self.assertNotIn(0, run.summary)
        self.assertEqual(run.series.label("mean_vy"), "mean_vy (m/s)")
        self.assertEqual(run.series.label("contacts"), "contacts")

    def test_a_column_that_is_not_there_is_a_key_error_with_those_like_it(self):
        series = self.run_of_it.series
        with self.assertRaisesRegex(KeyError, "mean_v: there is no such column; there is .*mean_vy"):
            series.label("mean_v")
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
        self.assertEqual(len(validity.findings), len(self.run_of_it.summary["validity.findings"]))
        run = riesel.Run(self.directory)
        verdicts = ["valid", "suspect", "unphysical", "valid", "suspect"]
        findings = [{**finding, "verdict": verdict} for finding, verdict
                    in zip(run.summary["validity.findings"], verdicts)]
        run.summary = riesel.Tree({"validity": {"verdict": "unphysical", "findings": findings}})
        self.assertEqual(run.validity.verdict, "unphysical")
        self.assertEqual([finding.name for finding in run.validity.reasons()],
                         [findings[i]["name"] for i in (1, 2, 4)])

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
