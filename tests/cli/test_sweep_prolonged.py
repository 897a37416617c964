"""Going on with the runs of a sweep that are done: what they come to is what they would have come to
if they had been planned like this."""

import json
import shutil
import signal
import time
import unittest

from riesel_command import DONE, FAILED, PATIENCE, bytes_of_files
from sweep_command import CHAIN, ONE_FAILS, SweepTest

TWO = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes: {contact.restitution: [0.7, 0.9]}
"""
# The first point is planned to go further than the others.
UNEQUAL = """\
base: tube.yaml
axes:
  - contact.restitution: [0.7, 0.8, 0.9]
    run.duration: [6 ms, 3 ms, 2 ms]
"""
# Soft contacts take long steps; at 20 % it ends after 1.4 s.
TUBE_TO_A_PRECISION = """\
base: tube.yaml
set: {seed: 2, contact.stiffness: 200 N/m, run.duration: , run.until.relative_error: 20 %, run.until.at_most: 3 s}
"""
LONG_ENOUGH_TO_INTERRUPT = "4 s"


class Prolonged(SweepTest):

    def go_on(self, *changes, out="out", options=()):
        return self.riesel("sweep", out, *[f"--set={change}" for change in changes], *options)

    def whole(self, restitution, *changes):
        """The run as it would have been if nobody had stopped it before."""
        return self.run_to_end("tube.yaml", f"whole/{restitution}",
                               f"--set=contact.restitution={restitution}",
                               *[f"--set={change}" for change in changes])

    def directory_of(self, restitution):
        row = next(row for row in self.rows() if row["contact.restitution"] == restitution)
        return self.home / "out/points" / row["point"]

    def assert_is_whole(self, restitution, duration):
        self.assert_same_result(self.directory_of(restitution),
                                self.whole(restitution, f"run.duration={duration}"))

    def test_what_is_done_goes_on_to_the_same_bits(self):
        self.sweep_to_end(TWO)
        names = [row["point"] for row in self.rows()]
        self.assert_done(self.go_on("run.duration=5 ms"))
        self.assertEqual([row["point"] for row in self.rows()], names)
        for restitution in ("0.7", "0.9"):
            self.assert_is_whole(restitution, "5 ms")

    def test_what_has_not_begun_begins_like_that(self):
        self.sweep_to_end(TWO.replace("[0.7, 0.9]", "[0.7]"))
        self.assert_done(self.sweep(TWO, "out", "--prepare"))
        self.assert_done(self.go_on("run.duration=5 ms"))
        for restitution in ("0.7", "0.9"):
            self.assert_is_whole(restitution, "5 ms")

    def test_what_has_come_further_stays(self):
        self.sweep_to_end(UNEQUAL)
        before = bytes_of_files(self.directory_of("0.7"))
        self.assert_done(self.go_on("run.duration=4 ms"))
        self.assertEqual(bytes_of_files(self.directory_of("0.7")), before)
        for restitution in ("0.8", "0.9"):
            self.assert_is_whole(restitution, "4 ms")

    def test_what_has_gone_on_is_not_run_again(self):
        self.sweep_to_end(TWO)
        self.assert_done(self.go_on("run.duration=5 ms"))
        before = bytes_of_files(self.home / "out/points")
        self.assert_done(self.go_on("run.duration=5 ms"))
        self.assert_done(self.sweep(TWO, "out"))
        self.assertEqual(bytes_of_files(self.home / "out/points"), before)

    def test_to_a_precision(self):
        changes = ["run.duration=", "run.until.relative_error=0.01 %", "run.until.at_most=6 ms"]
        self.sweep_to_end(TWO)
        for _ in range(2):  # the second time there is no duration to be taken out
            self.assert_done(self.go_on(*changes))
        self.assertEqual(self.summary(self.directory_of("0.7"))["ended_by"], "at_most")
        self.assert_same_result(self.directory_of("0.7"), self.whole("0.7", *changes))

    def test_the_directory_alone_goes_on_with_what_is_left(self):
        self.assert_done(self.sweep(TWO, "out", "--prepare"))
        self.assert_done(self.riesel("sweep", "out"))
        for restitution in ("0.7", "0.9"):
            self.assert_is_whole(restitution, "2 ms")

    def test_by_tasks(self):
        self.sweep_to_end(TWO)
        for part in (0, 1):
            self.assert_done(self.riesel("sweep-task", "out", part, "--of", 2, "--threads", 1,
                                         "--set", "run.duration=5 ms"))
        self.assert_done(self.riesel("collect", "out"))
        for restitution in ("0.7", "0.9"):
            self.assert_is_whole(restitution, "5 ms")

    def test_a_script_for_slurm_hands_it_on(self):
        self.sweep_to_end(UNEQUAL)
        self.assertEqual(self.script_for("run.duration=2 ms"), "# nothing is left to be done\n")
        script = self.script_for("run.duration=4 ms")
        self.assertIn("#SBATCH --array=1-2\n", script)
        self.assertIn(" --set 'run.duration=4 ms'", script)

    def script_for(self, change):
        result = self.riesel("sweep", "out", "--slurm", "--dry-run", "--set", change, PATH="/nowhere")
        self.assert_done(result)
        return result.stdout

    def test_a_dry_run_tells_what_would_go_on(self):
        self.sweep_to_end(UNEQUAL)
        before = bytes_of_files(self.home)
        result = self.go_on("run.duration=4 ms", options=["--dry-run"])
        self.assert_done(result)
        self.assertEqual((result.stdout.count(" done "), result.stdout.count(" interrupted ")),
                         (1, 2), result.stdout)
        self.assertEqual(bytes_of_files(self.home), before)

    def test_failures_stay_failures(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        self.assertEqual(self.go_on("run.duration=6 ms").returncode, FAILED)
        self.assertEqual(sorted(row["status"] for row in self.rows()), ["done", "done", "failed"])

    def test_what_is_done_does_not_go_on_for_other_settings_alone(self):
        self.sweep_to_end(TWO)
        before = bytes_of_files(self.home / "out/points")
        self.assert_done(self.go_on("limits.overlap=1e-9", "run.stepping=plain",
                                    "output.checkpoint_interval=1 s"))
        self.assertEqual(bytes_of_files(self.home / "out/points"), before)

    def test_what_fails_on_the_way_is_told_and_tried_again_only_if_asked(self):
        self.sweep_to_end(TWO)
        for options, attempts in (((), 2), ((), 2), (("--retry-failed",), 3)):
            result = self.go_on("run.duration=5 ms", "limits.overlap=1e-9", options=options)
            self.assertEqual(result.returncode, FAILED, result)
            self.assertIn("2 failed", result.stdout)
            self.assertIn("limits.overlap", result.stdout)
            self.assertEqual([point["attempts"] for point in self.points()], 2 * [attempts])
            # They keep the results that they had.
            self.assertEqual([0.0019 < float(row["time"]) < 0.0021 for row in self.rows()], [True, True])
        self.assert_done(self.go_on("run.duration=5 ms", "limits.overlap=1", options=["--retry-failed"]))
        self.assert_is_whole("0.9", "5 ms")

    def test_earlier_results_of_other_points_are_not_taken(self):
        """After both have failed to go on, and their directories have changed places."""
        self.sweep_to_end(TWO)
        self.assertEqual(self.go_on("run.duration=5 ms", "limits.overlap=1e-9").returncode, FAILED)
        one, other = self.directory_of("0.7"), self.directory_of("0.9")
        self.assertFalse((one / "summary.json").exists())
        for source, target in ((one, "aside"), (other, one), (self.home / "aside", other)):
            shutil.move(source, self.home / target)
        self.riesel("collect", "out")
        self.assertEqual({row.get("state_hash", "") for row in self.rows()}, {""})

    def test_a_run_that_begins_anew_has_no_earlier_result(self):
        self.sweep_to_end(TWO)
        self.assertEqual(self.go_on("run.duration=5 ms", "limits.overlap=1e-9").returncode, FAILED)
        point = self.directory_of("0.7")
        (point / "run.h5").unlink()
        self.assertEqual(self.go_on("run.duration=5 ms", "limits.overlap=1e-9", options=["--retry-failed"]).returncode,
                         FAILED)
        row = next(row for row in self.rows() if row["point"] == point.name)
        self.assertEqual((row["status"], row["state_hash"]), ("failed", ""))

    def test_what_cannot_even_begin_to_go_on_is_told_and_not_tried_again(self):
        self.sweep_to_end(TWO)
        for checkpoint in self.directory_of("0.7").glob("checkpoint*"):
            checkpoint.write_bytes(checkpoint.read_bytes()[:-100])
        for options, attempts in (((), 2), ((), 2), (("--retry-failed",), 3)):
            result = self.go_on("run.duration=5 ms", options=options)
            self.assertEqual(result.returncode, FAILED, result)
            self.assertIn("1 done, 1 failed", result.stdout)
            self.assertIn("is damaged", result.stdout)
            point, = [point for point in self.points() if point["status"] == "failed"]
            self.assertEqual(point["attempts"], attempts)
        self.assertTrue((self.directory_of("0.7") / "summary.json").exists())

    def test_what_has_no_checkpoint_cannot_go_on(self):
        self.sweep_to_end(TWO)
        for checkpoint in self.directory_of("0.7").glob("checkpoint*"):
            checkpoint.unlink()
        before = bytes_of_files(self.directory_of("0.7"))
        result = self.go_on("run.duration=5 ms")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("has no checkpoint to go on from; remove its directory", result.stdout)
        self.assertEqual(bytes_of_files(self.directory_of("0.7")), before)
        kept = next(row for row in self.rows() if row["contact.restitution"] == "0.7")
        self.assertEqual((kept["status"], float(kept["time"])), ("failed", self.summary(self.directory_of("0.7"))["time"]))
        self.assert_is_whole("0.9", "5 ms")

    def test_what_knew_its_mean_goes_on_to_less_than_it_might_have_taken(self):
        precise = TUBE_TO_A_PRECISION + "axes: {start.random_velocity: [2 m/s]}\n"
        self.assert_done(self.sweep(precise, "out"))
        (row,) = self.rows()
        run = self.home / "out/points" / row["point"]
        self.assertEqual(self.summary(run)["ended_by"], "precision")
        longer = 1.2 * float(row["time"])
        self.assert_done(self.go_on("run.until=", f"run.duration={longer}"))
        self.assertAlmostEqual(self.summary(run)["time"], longer, delta=1e-4 * longer)

    def test_a_checkpoint_without_a_series_is_not_thrown_away(self):
        self.sweep_to_end(TWO)
        run = self.directory_of("0.7")
        for name in ("run.h5", "summary.json"):
            (run / name).unlink()
        before = bytes_of_files(run)
        self.assertRegex(self.riesel("sweep", "out", "--dry-run").stdout, r"failed +contact\.restitution=0\.7")
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("run.h5 is missing beside its checkpoint; restore it, or begin the point anew with --retry-failed",
                      result.stdout)
        after = bytes_of_files(run)
        self.assertEqual({name: after[name] for name in after if "checkpoint" in name},
                         {name: before[name] for name in before if "checkpoint" in name})
        self.assert_done(self.riesel("sweep", "out", "--retry-failed"))
        self.assert_is_whole("0.7", "2 ms")

    def test_results_of_other_versions_stay_as_they_are(self):
        self.sweep_to_end(TWO)
        summary = self.directory_of("0.7") / "summary.json"
        summary.write_text(summary.read_text(encoding="utf-8").replace('"format": 2', '"format": 1'),
                           encoding="utf-8")
        before = bytes_of_files(self.directory_of("0.7"))
        self.riesel("sweep", "out", "--set", "run.duration=5 ms")
        self.assertEqual(bytes_of_files(self.directory_of("0.7")), before)

    def test_a_crash_between_any_two_files_costs_nothing(self):
        """What a run leaves that is killed while it begins to go on: the summary has been set aside, and
        the settings are the new ones or not; the checkpoint is the old one."""
        changes = ["run.duration=", "run.until.relative_error=0.01 %", "run.until.at_most=6 ms"]
        self.sweep_to_end(TWO)
        whole = self.sweep_whole(changes)
        for settings_too in (False, True):
            out = f"crashed_{settings_too}"
            shutil.copytree(self.home / "out", self.home / out)
            points = list((self.home / out / "points").iterdir())
            self.assertEqual(len(points), 2)
            for point in points:
                (point / "summary.json").rename(point / "summary.json.previous")
                new_settings = whole / point.name / "effective.yaml"
                if settings_too:
                    shutil.copy(new_settings, point)
                has_new_settings = (point / "effective.yaml").read_bytes() == new_settings.read_bytes()
                self.assertEqual(has_new_settings, settings_too)
            self.assert_done(self.go_on(*changes, out=out))
            for point in points:
                self.assert_same_result(point, whole / point.name)

    def sweep_whole(self, changes):
        """The points of a copy that has gone on undisturbed."""
        shutil.copytree(self.home / "out", self.home / "undisturbed")
        self.assert_done(self.go_on(*changes, out="undisturbed"))
        return self.home / "undisturbed/points"

    def test_a_length_given_by_mistake_can_be_taken_back(self):
        self.sweep_to_end(TWO)
        process = self.start("sweep", "out", "--set", "run.duration=1000 s")
        self.wait_until(lambda: not list(self.home.glob("out/points/*/summary.json")), "the start of both runs")
        process.kill()  # before anything is saved, or after
        process.communicate(timeout=PATIENCE)
        result = self.go_on("run.duration=5 ms")
        if result.returncode == DONE:
            self.assert_is_whole("0.9", "5 ms")
        else:
            self.assertRegex(result.stdout, "the run has come to .* already; choose a longer time")

    def test_the_expected_time_is_that_of_what_is_left(self):
        self.sweep_to_end(TWO)
        manifest = self.manifest()
        for point in manifest["points"]:
            point["expected_seconds"] = 3600.0  # of 2 ms
        self.write("out/manifest.json", json.dumps(manifest))
        self.assertIn(" 9.0 h ", self.go_on("run.duration=20 ms", options=["--dry-run"]).stdout)
        self.assert_done(self.go_on("run.duration=6 ms"))
        self.assertIn(" 7.0 h ", self.go_on("run.duration=20 ms", options=["--dry-run"]).stdout)

    def test_interrupted_it_goes_on_by_the_same_command_and_by_the_sweep_file(self):
        self.sweep_to_end(TWO)
        change = f"run.duration={LONG_ENOUGH_TO_INTERRUPT}"
        process = self.start("sweep", "out", "--set", change, "--jobs", 1)
        self.wait_until(lambda: len(list(self.home.glob("out/points/*/summary.json"))) < 2, "the start of a run")
        time.sleep(0.3)  # which is no matter: the runs catch signals from their beginning
        process.send_signal(signal.SIGTERM)
        output, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        self.assertIn("2 points: 1 done, 1 interrupted", output)
        self.assertEqual([0.0019 < float(row["time"]) < 0.0021 for row in self.rows()], [True, True], "earlier results")
        begun = [point for point in (self.home / "out/points").iterdir()
                 if not (point / "summary.json").exists()]
        self.assertEqual(len(begun), 1)
        self.assertTrue((begun[0] / "summary.json.previous").exists())
        # The sweep file alone lets what was begun come to its new end, and leaves the other as it was.
        shutil.copytree(self.home / "out", self.home / "other")
        self.assert_done(self.sweep(TWO, "other"))
        times = sorted(float(row["time"]) for row in self.rows("other"))
        self.assertAlmostEqual(times[0], 2e-3, delta=1e-6)
        self.assertAlmostEqual(times[1], 4.0, delta=1e-3)
        self.assert_done(self.go_on(change))
        self.assertEqual(self.hashes()[begun[0].name], self.hashes("other")[begun[0].name])
        self.assert_is_whole("0.9", LONG_ENOUGH_TO_INTERRUPT)


    def test_what_is_taken_out_need_not_be_there(self):
        self.sweep_to_end(TWO)
        self.assert_done(self.go_on("run.duration=5 ms", "limits.speed="))

    def test_what_failed_with_one_change_is_tried_again_with_another(self):
        self.sweep_to_end(TWO)
        for limit, attempts in (("1e-9", 2), ("1e-9", 2), ("1", 3)):
            self.go_on("run.duration=5 ms", f"limits.overlap={limit}")
            self.assertEqual([point["attempts"] for point in self.points()], 2 * [attempts])
        self.assertEqual({row["status"] for row in self.rows()}, {"done"})
        self.assert_is_whole("0.9", "5 ms")

    def test_what_is_taken_out_need_not_be_there_before_the_beginning(self):
        self.assert_done(self.sweep(TWO, "out", "--prepare"))
        self.assert_done(self.go_on("run.duration=5 ms", "limits.speed="))


class Refused(SweepTest):

    def assert_refused_without_a_trace(self, arguments, *mentions):
        before = bytes_of_files(self.home)
        self.assert_refused(self.riesel("sweep", *arguments), *mentions)
        self.assertEqual(bytes_of_files(self.home), before)

    def test_what_would_be_other_runs(self):
        self.sweep_to_end(TWO)
        for change, mentions in {
                "contact.friction=0.1": ("contact.friction", "new run"),
                "run.threads=2": ("run.threads", "share the cores"),
                "run.duration=5 mm": ("run.duration", "mm"),
                "run.duration=-1 s": ("run.duration",),
                "run.duratoin=5 ms": ("run.duratoin",),
                "run.until.at_most=5 s": ("run.until",)}.items():
            with self.subTest(change):
                self.assert_refused_without_a_trace(["out", "--set", change], *mentions)

    def test_runs_that_others_started_from(self):
        self.sweep_to_end(CHAIN)
        self.assert_refused_without_a_trace(["out", "--set", "run.duration=5 ms"],
                                            "start from each other")

    def test_runs_without_a_length(self):
        self.write("grain.yaml", "scenario: single_wall_grain\n"
                                 "impact: {axial_velocity: [1 m/s, 2 m/s]}\n"
                                 "contact: {stiffness: 2000 N/m, restitution: 0.9}\n")
        self.sweep_to_end("base: grain.yaml\naxes: {contact.restitution: [0.7, 0.9]}\n")
        self.assert_refused_without_a_trace(["out", "--set", "output.checkpoint_interval=5 s"],
                                            "single_wall_grain")

    def test_a_sweep_file_has_its_own_settings(self):
        self.write("sweep.yaml", TWO)
        self.assert_refused_without_a_trace(["sweep.yaml", "--set", "run.duration=5 ms"], "--set",
                                            "directory")

    def test_a_sweep_goes_on_where_it_is(self):
        self.sweep_to_end(TWO)
        self.assert_refused_without_a_trace(["out", "--out", "elsewhere"], "--out")

    def test_a_point_whose_directory_is_missing(self):
        self.assert_done(self.sweep(TWO, "out", "--prepare"))
        shutil.rmtree(next(iter(sorted(self.home.glob("out/points/*")))))
        self.assert_refused_without_a_trace(["out"], "point.yaml: is missing", "with the sweep file", "--out out")
        self.sweep_to_end(TWO)
        (self.home / "out/sweep.yaml").unlink()
        self.assert_refused_without_a_trace(["out"], "sweep.yaml: is missing")

    def test_a_directory_that_is_not_there(self):
        result = self.riesel("sweep", "sweeps/nix", "--set", "run.duration=1 s")
        self.assert_refused(result, "sweeps/nix", "No such file")

    def test_a_directory_without_a_sweep(self):
        self.run_to_end("tube.yaml", "run")
        self.assert_refused_without_a_trace(["run"], "run")

    def test_damaged_settings_of_a_point(self):
        self.sweep_to_end(TWO)
        point = next(iter(sorted(self.home.glob("out/points/*"))))
        (point / "point.yaml").write_text("scenario: [", encoding="utf-8")
        self.assert_refused_without_a_trace(["out", "--set", "run.duration=5 ms"], str(point.name))

    def test_resume_tells_the_way(self):
        self.sweep_to_end(TWO)
        self.assert_refused(self.riesel("resume", "out"), "sweep out")

    def test_what_a_resume_refuses(self):
        """It goes by the settings with which the runs have gone on, not by the plan."""
        self.sweep_to_end(TWO)
        until = ("run.duration=", "run.until.relative_error=99 %", "run.until.at_most=4 ms")
        self.assert_done(self.riesel("sweep", "out", *[f"--set={change}" for change in until]))
        for change, mention in (("run.duration=6 ms", "cannot be given together with run.until"),
                                ("run.until.at_most=1e300 s", "more time steps than can be counted")):
            for options in ([], ["--dry-run"], ["--slurm", "--dry-run"]):
                self.assert_refused_without_a_trace(["out", "--set", change, *options], mention)
            self.assert_refused(self.riesel("sweep-task", "out", 0, "--set", change), mention)
        self.assert_done(self.riesel("sweep", "out", "--set", "run.until=", "--set", "run.duration=6 ms"))
        self.assertEqual({row["ended_by"] for row in self.rows()}, {"duration"})


if __name__ == "__main__":
    unittest.main()
