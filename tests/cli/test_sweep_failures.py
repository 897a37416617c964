"""Points of a sweep that fail, or whose results are damaged: they are told, and do not stop the others."""

import fcntl
import json
import re
import shutil

from riesel_command import BAD_INPUT, DONE, FAILED, OUT_OF_TIME, bytes_of_files
from sweep_command import CHAIN, GRID, ONE_FAILS, ONE_POINT, SweepTest


class Failures(SweepTest):

    def test_a_failure_is_recorded_and_does_not_stop_the_others(self):
        result = self.sweep(ONE_FAILS)
        self.assertEqual(result.returncode, FAILED, result)
        points = self.points()
        self.assertEqual([point["status"] for point in points], ["done", "failed", "done"])
        self.assertIn("gone through a wall", points[1]["reason"])
        self.assertIn("gone through a wall", result.stderr)
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows], ["done", "failed", "done"])
        self.assertEqual((rows[1]["state_hash"], rows[1]["reason"]), ("", points[1]["reason"]))

    def test_a_directory_may_look_like_an_option(self):
        self.write("sweep.yaml", ONE_FAILS)
        told = self.riesel("sweep", "sweep.yaml", "--out=-x").stdout
        again, = re.findall(r"'riesel (sweep .*) --retry-failed'", told)
        self.assertEqual(self.riesel(*again.split()).returncode, FAILED)
        self.assertEqual(again, "sweep ./-x")

    def test_a_failed_point_is_run_again_only_if_asked(self):
        attempts = []
        for options in ([], [], ["--retry-failed"]):
            result = self.sweep(ONE_FAILS, "out", *options)
            self.assertEqual(result.returncode, FAILED, result)
            attempts.append([point["attempts"] for point in self.points()])
        self.assertEqual(attempts, [[1, 1, 1], [1, 1, 1], [1, 2, 1]])

    def test_attempts_do_not_overflow(self):
        most = 2**31 - 1
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        record = self.home / "out/points" / self.points()[0]["name"] / "attempts.json"
        record.write_text(json.dumps({"attempts": most, "failure": ""}), encoding="utf-8")
        self.assert_done(self.riesel("sweep", "out"))
        self.assertEqual(self.points()[0]["attempts"], most)

    def damage(self, text):
        """The summary of the first point."""
        point = self.home / "out/points" / self.points()[0]["name"]
        (point / "summary.json").write_text(text, encoding="utf-8")
        return point

    def test_a_result_that_is_cut_short_is_made_anew(self):
        self.sweep_to_end(ONE_POINT)
        whole = self.hashes()
        for text in ("", "{", '{"scenario": "peri'):
            with self.subTest(text):
                self.damage(text)
                self.assertIn("1 interrupted", self.riesel("status", "out").stdout)
                self.assert_done(self.riesel("sweep", "out"))
                self.assertEqual(self.hashes(), whole)

    def test_a_result_that_is_cut_short_and_cannot_be_made_anew_is_a_failure(self):
        self.sweep_to_end(ONE_POINT)
        point = self.damage("{")
        for path in point.glob("checkpoint*"):
            path.unlink()
        before = bytes_of_files(point)
        for options in ([], ["--retry-failed"]):
            result = self.riesel("sweep", "out", *options)
            self.assertEqual(result.returncode, FAILED, result)
            self.assertIn("summary.json is damaged; restore it", result.stdout)
            self.assertEqual(bytes_of_files(point), before)

    def test_a_result_that_is_damaged_otherwise_is_told(self):
        self.sweep_to_end(ONE_POINT)
        point = self.damage("{]}")
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED, result)
        self.assert_one_message(result.stderr, "summary.json",
                                f"riesel resume out/points/{point.name}'")
        self.resume_to_end(point)
        self.assert_done(self.riesel("sweep", "out"))

    def test_results_of_other_points_are_not_taken(self):
        """After two directories have changed places: of other settings, or of another past."""
        for text, one, other in ((GRID, 0, 1), (CHAIN, 1, 3)):
            with self.subTest(text):
                shutil.rmtree(self.home / "out", ignore_errors=True)
                out = self.sweep_to_end(text)
                points = self.points()
                one_point, other_point = (out / "points" / points[i]["name"] for i in (one, other))
                self.exchange(one_point, other_point)
                for command, status in ((["collect", "out"], FAILED), (["status", "out"], DONE)):
                    result = self.riesel(*command)
                    self.assertEqual((result.returncode, result.stderr), (status, ""))
                    self.assertIn("2 failed", result.stdout)
                    self.assertEqual(result.stdout.count("is of another point"), 2)
                    self.assertNotIn("--retry-failed", result.stdout)
                self.assertEqual(self.riesel("sweep", "out").returncode, FAILED)
                for row in self.rows():
                    misplaced = row["point"] in (one_point.name, other_point.name)
                    self.assertEqual((row["status"], row["state_hash"] == ""),
                                     ("failed", True) if misplaced else ("done", False))

    def test_runs_of_other_points_do_not_begin(self):
        """After two directories have changed places, or a settings file was changed by hand."""
        self.assert_done(self.sweep(GRID, "out", "--prepare"))
        one, other, edited, *others = (self.home / "out/points" / point["name"] for point in self.points())
        settings = edited / "point.yaml"
        planned = settings.read_text(encoding="utf-8")
        settings.write_text(re.sub("restitution: .*", "restitution: 0.75", planned), encoding="utf-8")
        self.exchange(one, other)
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED, result)
        self.assertEqual(result.stderr.count("is of another point"), 3)
        self.assertIn("contact.restitution is 0.75 in its point.yaml, not ", result.stderr)
        self.assertEqual([point["status"] for point in self.points()], ["failed"] * 3 + ["done"] * len(others))
        for point in (one, other, edited):
            self.assertFalse((point / "run.h5").exists())
        self.exchange(one, other)
        settings.write_text(planned, encoding="utf-8")
        self.assert_done(self.riesel("sweep", "out", "--retry-failed"))

    def test_a_neighbour_that_has_lost_its_checkpoint_can_be_made_anew(self):
        out = self.sweep_to_end(CHAIN)
        whole = self.hashes()
        first, second, *_ = (out / "points" / point["name"] for point in self.points())
        for lost in (*first.glob("checkpoint.h5*"), *second.glob("*.h5*"), second / "summary.json"):
            lost.unlink()
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED, result)
        self.assert_one_message(result.stderr, "lost its checkpoint", f"remove out/points/{first.name}", "--retry-failed")
        shutil.rmtree(first)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out", "--retry-failed"))
        self.assertEqual(self.hashes(), whole)

    def test_interrupted_runs_of_other_points_do_not_go_on(self):
        self.assert_done(self.sweep(GRID, "out", "--prepare"))
        one, other, *_ = (self.home / "out/points" / point["name"] for point in self.points())
        for point in (one, other):  # a run that was stopped has no result
            self.assert_done(self.riesel("run", point / "point.yaml", "--out", point))
            (point / "summary.json").unlink()
        self.exchange(one, other)
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED, result)
        self.assertEqual(result.stderr.count("in its effective.yaml, not "), 2)
        self.assertFalse((one / "summary.json").exists() or (other / "summary.json").exists())
        self.exchange(one, other)
        self.assert_done(self.riesel("sweep", "out", "--retry-failed"))

    def exchange(self, one, other):
        """The directories of two points."""
        aside = self.home / "out/points/aside"
        one.rename(aside)
        other.rename(one)
        aside.rename(other)

    def test_chains_do_not_start_from_results_of_other_points(self):
        text = CHAIN.replace("[0.7, 0.8, 0.9]", "[0.7, 0.8]") + "seeds: 2\n"
        self.assert_done(self.sweep(text, "out", "--prepare"))
        first = [i for i, point in enumerate(self.points()) if not point.get("parent")]
        for index in first:
            self.assert_done(self.riesel("sweep-task", "out", index))
        directories = [self.home / "out/points" / self.points()[i]["name"] for i in first]
        self.exchange(*directories)
        self.assert_refused(self.riesel("sweep-task", "out", first[0] + 1), "neighbour", "not done")
        self.assertEqual(self.riesel("sweep", "out", "--retry-failed").returncode, FAILED)
        statuses = [point["status"] for point in self.points()]
        self.assertEqual((statuses.count("failed"), statuses.count("waiting")), (2, 4))
        self.exchange(*directories)
        self.assert_done(self.riesel("sweep", "out"))
        self.sweep_to_end(text, "ref")
        self.assertEqual(self.hashes("out"), self.hashes("ref"))

    def test_results_from_other_files_are_not_taken(self):
        for name, velocity in (("a", 1), ("b", 2)):
            self.write(f"{name}.csv", f"x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n2, 2, {velocity}, 0, 1\n")
        self.write("tube.yaml", """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 10 mm, length: 6 mm}
start: {kind: file, from: a.csv}
""")
        self.sweep_to_end("base: tube.yaml\nset: {run.duration: 1 ms}\naxes: {start.from: [a.csv, b.csv]}\n")
        self.assert_done(self.riesel("collect", "out"))
        self.exchange(*(self.home / "out/points" / point["name"] for point in self.points()))
        self.assertEqual(self.riesel("collect", "out").returncode, FAILED)
        self.assertEqual([point["status"] for point in self.points()], ["failed", "failed"])

    def test_a_result_that_is_being_reported_on_is_one(self):
        out = self.sweep_to_end(ONE_POINT)
        with open(out / "points" / self.points()[0]["name"] / ".lock", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assert_done(self.riesel("sweep", "out"))
            self.assertEqual([row["status"] for row in self.rows()], ["done"])

    def test_what_is_left_takes_no_time_for_what_has_failed(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        manifest = self.manifest()
        for point in manifest["points"]:
            point["expected_seconds"] = 36000.0
        self.write("out/manifest.json", json.dumps(manifest))
        for options, told in (([], "1 s"), (["--retry-failed"], "10.0 h")):
            result = self.riesel("sweep", "out", "--dry-run", *options)
            self.assertIn(f"3 runs, about {told} with ", result.stdout)

    def test_a_sweep_is_not_out_of_time_if_nothing_is_left_to_do(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        again = self.riesel("sweep", "out", "--max-walltime", "1 ms")
        self.assertEqual((again.returncode, "interrupted" in again.stdout + again.stderr), (FAILED, False), again)
        retried = self.riesel("sweep", "out", "--max-walltime", "1 ms", "--retry-failed")
        self.assertEqual(retried.returncode, OUT_OF_TIME, retried)

    def test_failed_chains_are_not_to_be_run_with_changes(self):
        out = self.sweep_to_end(CHAIN)
        point = out / "points" / self.points()[-1]["name"]
        for path in [point / "summary.json", *point.glob("checkpoint*")]:
            path.unlink()
        (point / "attempts.json").write_text(json.dumps({"attempts": 1, "failure": "bad luck"}),
                                             encoding="utf-8")
        told = self.riesel("status", "out").stdout
        self.assertIn("to run the failed points again: '", told)
        self.assertNotIn("--set", told)

    def prepare_three(self):
        """Returns their directories."""
        self.assert_done(self.sweep(CHAIN.replace("continue_along: contact.restitution\n", ""), "out", "--prepare"))
        return [self.home / "out/points" / point["name"] for point in self.points()]

    def assert_the_others_are_done(self, result, failed, reason):
        """Of three points."""
        self.assertEqual(result.returncode, FAILED, result)
        self.assertEqual([row["status"] for row in self.rows()],
                         ["failed" if i == failed else "done" for i in range(3)])
        self.assertIn(reason, self.rows()[failed]["reason"])
        self.assertIn(reason, result.stderr + result.stdout)

    def test_a_point_that_cannot_be_written_fails_alone(self):
        for name, reason in (("log.txt", "log.txt: cannot be written: Is a directory"),
                             ("attempts.json", "attempts.json: "), (".lock", "cannot be locked: Is a directory")):
            with self.subTest(name):
                shutil.rmtree(self.home / "out", ignore_errors=True)
                obstacle = self.prepare_three()[1] / name
                obstacle.mkdir()
                self.assertIn(f"failed: {obstacle.parent}".replace(f"{self.home}/", ""),
                              self.riesel("sweep-task", "out", 1).stdout)
                for options in ([], ["--retry-failed"]):
                    self.assert_the_others_are_done(self.riesel("sweep", "out", *options), 1, reason)
                obstacle.rmdir()
                self.assert_done(self.riesel("sweep", "out", "--retry-failed"))

    def test_a_sweep_whose_disk_is_full_goes_on_when_there_is_room(self):
        result = self.riesel_with_files_of_at_most(20_000, *self.arguments_for(ONE_POINT))
        self.assertEqual(result.returncode, FAILED, result)
        self.assertIn("raise the limit on the size of files", self.rows()[0]["reason"])
        self.assert_done(self.riesel("sweep", "out", "--retry-failed"))
        whole = self.sweep_to_end(ONE_POINT, "whole") / "points" / self.points()[0]["name"]
        self.assert_same_result(whole, self.home / "out/points" / whole.name)

    def test_tables_and_reports_stay_as_they_are_while_the_disk_is_full(self):
        out = self.sweep_to_end(ONE_POINT)
        self.assert_done(self.riesel("report", "out"))
        before = bytes_of_files(out)
        for command in ("collect", "report", "sweep"):
            with self.subTest(command):
                self.assert_failed(self.riesel_with_files_of_at_most(0, command, "out"),
                                   "raise the limit on the size of files")
                after = bytes_of_files(out)
                self.assertEqual({**after, ".lock": before[".lock"]}, before)

    def test_tables_stay_as_they_are_if_the_copy_of_the_sweep_file_is_gone(self):
        out = self.sweep_to_end(ONE_POINT)
        (out / "sweep.yaml").unlink()
        (out / "points" / self.points()[0]["name"] / "summary.json").unlink()
        before = {name: (out / name).read_bytes() for name in ("sweep.csv", "sweep.h5")}
        self.assertEqual(self.riesel("collect", "out").returncode, BAD_INPUT)
        self.assertEqual({name: (out / name).read_bytes() for name in before}, before)

    def test_a_point_out_of_reach_fails_alone(self):
        point = self.prepare_three()[0]
        aside = point.with_name("aside")
        point.rename(aside)
        point.symlink_to(point.name)  # to itself: as without permission, but for root, too
        for command in (["out"], ["out", "--retry-failed"], ["sweep.yaml", "--out", "out"]):
            self.assert_the_others_are_done(self.riesel("sweep", *command), 0, "cannot be reached")
        for command in ("status", "report"):
            self.assert_done(self.riesel(command, "out"))
        collected = self.riesel("collect", "out")
        self.assertEqual((collected.returncode, "2 done, 1 failed" in collected.stdout), (FAILED, True), collected)
        self.assertEqual(self.sweep(CHAIN.replace("continue_along: contact.restitution\n", ""), "out",
                                    "--prepare").returncode, FAILED)
        point.unlink()
        aside.rename(point)
        self.assert_done(self.riesel("sweep", "out"))

    def test_status_tells_why(self):
        self.sweep(ONE_FAILS)
        result = self.riesel("status", "out")
        self.assert_done(result)
        self.assertIn("3 points: 2 done, 1 failed", result.stdout)
        self.assertIn("--retry-failed'", result.stdout)
        self.assertIn("--set", result.stdout)
        self.assertRegex(result.stdout, r"failed \(contact.stiffness=0.5 seed=1\): .*a wall")
