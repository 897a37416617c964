"""The task command of batch systems: any task runner that calls it makes the sweep that `riesel sweep`
would make."""

import json
import os
import shutil
import subprocess
import unittest

from riesel_command import BAD_INPUT, COMMAND, DONE, FAILED, OUT_OF_TIME
from sweep_command import CHAIN, GRID, ONE_FAILS, ONE_POINT, SweepTest

ENDLESS = """\
base: tube.yaml
set: {run.duration: 1000 s}
axes: {contact.restitution: [0.7, 0.8]}
"""


class Tasks(SweepTest):

    def prepare(self, text):
        self.write("sweep.yaml", text)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out", "--prepare"))

    def task(self, *arguments):
        return self.riesel("sweep-task", "out", *arguments, "--threads", 1)

    def names_told(self, result):
        return [line.split()[1].rstrip(":") for line in result.stdout.splitlines()]

    def assert_same_as_local(self, text):
        self.assert_done(self.riesel("collect", "out"))
        self.sweep_to_end(text, "local")
        self.assertEqual(self.hashes("out"), self.hashes("local"))

    def test_the_points_of_a_prepared_sweep_can_be_run_one_by_one(self):
        self.sweep_to_end(CHAIN, "whole")
        self.assert_done(self.sweep(CHAIN, "out", "--prepare"))
        self.assertEqual({point["status"] for point in self.points()}, {"waiting"})
        refused = self.riesel("sweep-task", "out", 1)
        self.assert_refused(refused, "neighbour", self.points()[0]["name"], "run that one first")
        for index in range(5):
            result = self.riesel("sweep-task", "out", index)
            self.assert_done(result)
            self.assertIn(": done", result.stdout)
        self.assertEqual({point["status"] for point in self.points()}, {"waiting"})  # tasks leave it alone
        self.assert_done(self.riesel("collect", "out"))
        self.assertEqual({point["status"] for point in self.points()}, {"done"})
        self.assertEqual(self.hashes("whole"), self.hashes("out"))

    def test_what_is_done_is_known_when_more_is_prepared(self):
        self.sweep_to_end(ONE_POINT)
        self.assert_done(self.sweep(ONE_POINT.replace("2000 N/m", "2000 N/m, 3000 N/m"), "out", "--prepare"))
        self.assertEqual([(point["status"], point["attempts"]) for point in self.points()],
                         [("done", 1), ("waiting", 0)])

    def test_a_task_that_fails_says_so(self):
        self.sweep(ONE_FAILS, "out", "--prepare")
        for options, attempts in (([], 1), ([], 1), (["--retry-failed"], 2)):
            result = self.riesel("sweep-task", "out", 1, *options)
            self.assertEqual(result.returncode, FAILED, result)
            record = self.home / "out/points" / self.points()[1]["name"] / "attempts.json"
            self.assertEqual(json.loads(record.read_text(encoding="utf-8"))["attempts"], attempts)

    def test_what_is_no_point_is_refused(self):
        self.sweep(CHAIN, "out", "--prepare")
        self.assert_refused(self.riesel("sweep-task", "out", 5), "no point 5", "from 0 to 4")
        for command in (["sweep-task", "nowhere", 0], ["status", "nowhere"], ["collect", "."]):
            self.assert_refused(self.riesel(*command), "manifest.json", "'riesel sweep'")

    def test_the_parts_of_a_sweep_are_all_of_it_and_nothing_twice(self):
        self.prepare(GRID)
        told = []
        for part in range(3):
            result = self.task(part, "--of", 3)
            self.assert_done(result)
            told += self.names_told(result)
        self.assertEqual(sorted(told), sorted({point["name"] for point in self.points()}))
        self.assert_same_as_local(GRID)

    def test_a_part_holds_whole_chains_in_their_order(self):
        self.prepare(CHAIN)
        result = self.task(0, "--of", 2)
        self.assert_done(result)
        self.assertEqual(self.names_told(result), [point["name"] for point in self.points()])
        self.assertEqual((self.task(1, "--of", 2).returncode, self.task(1, "--of", 2).stdout),
                         (DONE, ""))

    def test_done_parts_are_not_run_again(self):
        self.prepare(GRID)
        self.assert_done(self.task(0, "--of", 4))
        before = {path: path.stat().st_mtime_ns for path in self.home.glob("out/points/*/run.h5")}
        self.assert_done(self.task(0, "--of", 4))
        self.assertEqual({path: path.stat().st_mtime_ns for path in before}, before)

    def test_what_tasks_have_done_is_not_put_aside_by_another_sweep(self):
        self.prepare(GRID)
        self.assert_done(self.task(0))
        self.write("sweep.yaml", ENDLESS)
        self.assert_refused(self.riesel("sweep", "sweep.yaml", "--out", "out", "--prepare"), "holds another sweep", "--out")

    def test_a_failure_is_told_and_does_not_stop_the_part(self):
        self.prepare(ONE_FAILS)
        result = self.task(0, "--of", 1)
        self.assertEqual(result.returncode, FAILED)
        self.assertEqual(result.stdout.count(": done"), 2)
        self.assertEqual(result.stdout.count(": failed: "), 1)

    def test_a_task_ends_before_its_time_is_over_and_goes_on_later(self):
        self.prepare(ENDLESS)
        for _ in range(2):
            result = self.task(0, "--of", 1, "--max-walltime", "1 s")
            self.assertEqual(result.returncode, OUT_OF_TIME, result)
        self.assertEqual(len(list(self.home.glob("out/points/*/checkpoint.h5"))), 1)
        status = self.riesel("status", "out").stdout
        self.assertIn("1 interrupted, 1 waiting", status)

    def test_a_sweep_ends_before_its_time_is_over(self):
        result = self.sweep(ENDLESS, "out", "--max-walltime", "1 s", "--jobs", 2)
        self.assertEqual(result.returncode, OUT_OF_TIME, result)
        self.assertIn("2 interrupted", result.stdout)
        self.assertIn("goes on", result.stderr)

    def test_no_such_part(self):
        self.prepare(GRID)
        self.assert_refused(self.task(3, "--of", 3), "part 3", "from 0 to 2")
        for index in ("-1", "99999999999999999999999"):
            result = self.task(index)
            self.assertEqual(result.returncode, BAD_INPUT)
            self.assertIn(f"INDEX: Value {index} not in range 0 to ", result.stderr)

    def test_numbers_are_decimal(self):
        self.prepare(GRID)
        names = [point["name"] for point in self.points()]
        self.assertEqual(self.names_told(self.task("006")), [names[6]])
        self.assertEqual(len(self.names_told(self.task("00", "--of", "08"))), 1)
        for number in ("0x1", "+1", "1e0", "1.0", "0b1", ""):
            for arguments in (["sweep-task", "out", number], ["sweep-task", "out", 1, "--of", number],
                              ["sweep", "out", "--jobs", number],
                              ["sweep", "out", "--slurm", "--dry-run", "--tasks", number]):
                with self.subTest(arguments):
                    self.assertEqual(self.riesel(*arguments).returncode, BAD_INPUT)
        self.assertEqual(sum(path.exists() for path in self.home.glob("out/points/*/summary.json")), 2)

    @unittest.skipIf(shutil.which("parallel") is None, "there is no GNU parallel")
    def test_gnu_parallel(self):
        self.prepare(GRID)
        (self.home / "bin").mkdir()
        (self.home / "bin/riesel").symlink_to(COMMAND)
        ran = subprocess.run(
            "seq 0 4 | parallel --jobs 2 --joblog jobs.log riesel sweep-task out {} --of 5 --threads 1",
            shell=True, cwd=self.home, check=False,
            env={**os.environ, "HOME": str(self.home), "PATH": f"{self.home / 'bin'}:{os.environ['PATH']}"},
            capture_output=True, text=True)
        self.assertEqual(ran.returncode, DONE, ran)
        self.assertEqual(len((self.home / "jobs.log").read_text(encoding="utf-8").splitlines()), 1 + 5)
        self.assert_same_as_local(GRID)
