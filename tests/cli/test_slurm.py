"""Sweeps on a real Slurm, of one node, which the test starts: they end as local ones do, also when the
time of a task is not enough. The script alone is looked at, and run, without Slurm."""

import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

import slurm_cluster
from riesel_command import BAD_INPUT, DONE, FAILED, OUT_OF_TIME, PATIENCE, bytes_of_files, saved_step
from sweep_command import ONE_FAILS, SweepTest
from test_sweep_tasks import ENDLESS

FOUR = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes: {contact.restitution: [0.7, 0.75, 0.8, 0.85]}
"""
CHAINS = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes: {contact.restitution: [0.7, 0.8], contact.friction: [0.3, 0.5, 0.7]}
continue_along: contact.restitution
"""
# Each run takes several seconds.
LONG = """\
base: tube.yaml
set: {run.duration: 20 s, output.checkpoint_interval: 1 h}
axes: {contact.restitution: [0.8, 0.9]}
"""


def lines_of(script, pattern):
    return re.findall(rf"^{pattern}$", script, re.MULTILINE)


class Script(SweepTest):
    """Where no Slurm answers."""

    def script(self, text, *options):
        self.write("sweep.yaml", text)
        result = self.riesel("sweep", "sweep.yaml", "--out", "out", "--slurm", "--dry-run", *options,
                             PATH="/nowhere")
        self.assert_done(result)
        return result.stdout

    def test_it_says_what_is_wanted_and_writes_nothing(self):
        script = self.script(FOUR, "--threads", 2, "--max-walltime", "90 s",
                             "--sbatch=--partition=long", "--sbatch=--mem=1G")
        for line in ("--job-name=out", "--array=0-3", "--cpus-per-task=2", "--time=2", "--requeue",
                     "--partition=long", "--mem=1G"):
            self.assertEqual(lines_of(script, f"#SBATCH {line}"), [f"#SBATCH {line}"])
        self.assertIn("--of 4 --threads 2 --max-walltime '90 s'", script)
        self.assertFalse((self.home / "out").exists())
        checked = subprocess.run(["bash", "-n"], input=script, text=True, check=False)
        self.assertEqual(checked.returncode, 0)

    def test_a_directory_may_have_any_name(self):
        self.write("my sweep.yaml", FOUR)
        result = self.riesel("sweep", "my sweep.yaml", "--slurm", "--dry-run", PATH="/nowhere")
        self.assert_done(result)
        self.assertEqual(lines_of(result.stdout, "#SBATCH --job-name=.*"), ["#SBATCH --job-name='my sweep'"])

    def test_only_long_tasks_are_signalled(self):
        """The signal may come two minutes early, so that short ones would get nowhere."""
        signalled = r"#SBATCH --signal=B:USR1@60"
        self.assertEqual(lines_of(self.script(FOUR, "--max-walltime", "2 min"), signalled), [])
        self.assertEqual(len(lines_of(self.script(FOUR, "--max-walltime", "1 h"), signalled)), 1)
        self.assertEqual(len(lines_of(self.script(FOUR), signalled)), 1)

    def test_chains_stay_together(self):
        self.assertIn("#SBATCH --array=0-2\n", self.script(CHAINS))

    def test_tasks_may_be_fewer_than_points(self):
        script = self.script(FOUR, "--tasks", 3)
        self.assertIn("#SBATCH --array=0-2\n", script)
        self.assertIn("--of 3 ", script)

    def test_what_is_done_needs_no_task(self):
        self.sweep_to_end(FOUR.replace("0.7, 0.75, 0.8, 0.85", "0.75"), "out")
        self.assertIn("#SBATCH --array=0,2-3\n", self.script(FOUR))
        self.sweep_to_end(FOUR, "out")
        self.assertEqual(self.script(FOUR), "# nothing is left to be done\n")

    def test_without_slurm_nothing_can_be_submitted(self):
        self.write("sweep.yaml", FOUR)
        result = self.riesel("sweep", "sweep.yaml", "--out", "out", "--slurm", PATH="/nowhere")
        self.assert_refused(result, "--slurm", "--prepare")
        self.assertFalse((self.home / "out").exists())

    def test_slurm_replaces_nothing_in_the_name_of_the_directory(self):
        self.write("sweep.yaml", FOUR)
        result = self.riesel("sweep", "sweep.yaml", "--out", "10%j", "--slurm", "--dry-run",
                             PATH="/nowhere")
        self.assert_done(result)
        self.assertEqual(lines_of(result.stdout, "#SBATCH --output=.*/(.*/.*/.*)"),
                         ["10%%j/slurm/%a.txt"])
        self.assertIn("/10%j 0", result.stdout.replace('"$SLURM_ARRAY_TASK_ID"', "0"))

    def test_an_option_is_a_line(self):
        self.write("sweep.yaml", FOUR)
        before = bytes_of_files(self.home)
        for options in ([], ["--dry-run"]):
            result = self.riesel("sweep", "sweep.yaml", "--slurm", "--sbatch=--mem=1G\nrm -r x",
                                 *options)
            self.assert_refused(result, "--sbatch", "line break")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_a_path_is_within_a_line(self):
        self.write("sweep.yaml", FOUR)
        before = bytes_of_files(self.home)
        for options in ([], ["--dry-run"]):
            result = self.riesel("sweep", "sweep.yaml", "--out", "two\nlines", "--slurm", *options, PATH="/nowhere")
            self.assert_refused(result, "--slurm: the path of the sweep has a line break", "--out")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_options_of_slurm_want_slurm(self):
        self.write("sweep.yaml", FOUR)
        for option in (["--tasks", 3], ["--sbatch=--mem=1G"]):
            result = self.riesel("sweep", "sweep.yaml", *option)
            self.assertEqual(result.returncode, BAD_INPUT)
            self.assertIn("requires --slurm", result.stderr)

    def test_options_that_slurm_would_ignore_are_refused(self):
        self.write("sweep.yaml", FOUR)
        for options in (["--jobs", 2], ["--prepare"]):
            self.assert_sweep_refuses(["--slurm"], options)

    def test_what_failed_is_submitted_again_only_if_asked(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        before = bytes_of_files(self.home)
        self.assertEqual(self.script(ONE_FAILS), "# nothing is left to be done\n")
        self.assertIn("#SBATCH --array=1\n", self.script(ONE_FAILS, "--retry-failed"))
        self.assertEqual(bytes_of_files(self.home), before)


class StandIns(SweepTest):
    """Programs that stand for those of Slurm."""

    def setUp(self):
        super().setUp()
        (self.home / "slurm").mkdir()
        self.path = f"{self.home / 'slurm'}:{os.environ['PATH']}"
        self.stand_in("scontrol", "echo 'MaxArraySize = 1001'")
        self.stand_in("sbatch", "echo 17")

    def stand_in(self, name, text):
        """It also keeps what it was asked for."""
        self.write(f"slurm/{name}", f'#!/bin/sh\necho "$*" >> "$0.txt"\n{text}\n').chmod(0o755)

    def asked(self, name):
        path = self.home / f"slurm/{name}.txt"
        return path.read_text(encoding="utf-8").splitlines() if path.exists() else []

    def submit(self, *options):
        return self.riesel("sweep", "sweep.yaml", "--out", "out", "--slurm", *options, PATH=self.path)


class Submission(StandIns):

    def test_what_failed_is_tried_once_more(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        nothing = self.submit()
        self.assertEqual((nothing.returncode, nothing.stdout),
                         (FAILED, self.riesel("status", "out").stdout))
        self.assertEqual(self.asked("sbatch"), [])
        result = self.submit("--retry-failed")
        self.assert_done(result)
        self.assertIn("submitted as job 17; see 'riesel status out'", result.stdout)
        self.assertEqual(self.asked("sbatch"), ["--parsable out/slurm.sh"])
        self.assertIn("#SBATCH --array=1\n", (self.home / "out/slurm.sh").read_text())
        for _ in range(2):  # as if the task were queued again
            self.assertEqual(self.riesel("sweep-task", "out", 1, "--of", 3).returncode, FAILED)
        self.assert_done(self.riesel("collect", "out"))
        self.assertEqual([row["attempts"] for row in self.rows()], ["1", "2", "1"])

    def test_a_job_without_a_number_is_submitted_too(self):
        self.write("sweep.yaml", FOUR)
        self.stand_in("sbatch", "true")
        result = self.submit()
        self.assert_done(result)
        self.assertEqual(result.stdout, "out: submitted; see 'riesel status out'\n")

    def test_what_failed_to_go_on_is_tried_once_more(self):
        """Its result of before is still there, and so it is done for those who do not ask for more."""
        self.sweep_to_end(ONE_FAILS.replace(", 0.5 N/m", ""))
        point = self.home / "out/points" / self.points()[0]["name"]
        for checkpoint in point.glob("checkpoint*"):
            checkpoint.write_bytes(checkpoint.read_bytes()[:-100])
        further = ["--set", "run.duration=5 ms"]
        self.assertEqual(self.riesel("sweep", "out", *further).returncode, FAILED)
        self.assert_done(self.riesel("sweep", "out", "--slurm", "--retry-failed", *further, PATH=self.path))
        self.assertIn("#SBATCH --array=0\n", (self.home / "out/slurm.sh").read_text())
        self.assertEqual(self.riesel("sweep-task", "out", 0, "--of", 2, *further).returncode, FAILED)
        self.assertEqual(json.loads((point / "attempts.json").read_text())["attempts"], 3)

    def test_what_failed_stays_failed_if_slurm_refuses(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        before = self.riesel("status", "out").stdout
        self.stand_in("sbatch", "exit 1")
        self.assert_failed(self.submit("--retry-failed"), "sbatch refused the job")
        self.assertEqual(self.riesel("status", "out").stdout, before)


class Submitted(StandIns):
    """The script that was submitted, as Slurm would run it: as the first task of an array."""

    def start_task(self, text, *options):
        self.write("sweep.yaml", text)
        self.assert_done(self.submit(*options))
        return self.start_again()

    def start_again(self):
        task = subprocess.Popen(["bash", "out/slurm.sh"], cwd=self.home, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                env={**os.environ, "PATH": self.path, "SLURM_ARRAY_JOB_ID": "17",
                                     "SLURM_ARRAY_TASK_ID": "0"})
        self.addCleanup(self._end, task)
        return task

    def requeued(self):
        return [line for line in self.asked("scontrol") if line != "show config"]

    def signal_within_run(self, task, number):
        self.wait_until(lambda: list(self.home.glob("out/points/*/checkpoint.h5")), "the first checkpoint")
        task.send_signal(number)

    def test_what_has_ended_is_not_queued_again(self):
        task = self.start_task(FOUR)
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (DONE, []))
        self.assertIn(": 4 points: 1 done", self.riesel("status", "out").stdout)

    def test_what_has_failed_is_not_queued_again(self):
        task = self.start_task(ONE_FAILS.replace("2000 N/m, ", ""))
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (FAILED, []))

    def test_whose_time_is_over_is_queued_again_and_goes_on(self):
        task = self.start_task(ENDLESS, "--max-walltime", "2 s")
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (OUT_OF_TIME, ["requeue 17_0"]))
        point, = self.home.glob("out/points/*/checkpoint.h5")
        before = saved_step(point.parent)
        self.assertEqual(self.start_again().wait(PATIENCE), OUT_OF_TIME)
        self.assertGreater(saved_step(point.parent), before)
        self.assertEqual(self.requeued(), ["requeue 17_0"] * 2)

    def test_the_signal_before_the_end_of_the_time_queues_it_again(self):
        task = self.start_task(ENDLESS)
        self.signal_within_run(task, signal.SIGUSR1)
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (143, ["requeue 17_0"]))

    def test_a_second_signal_does_not_end_the_script_before_its_task(self):
        task = self.start_task(ENDLESS)
        self.signal_within_run(task, signal.SIGSTOP)
        child, = pathlib.Path(f"/proc/{task.pid}/task/{task.pid}/children").read_text().split()
        os.kill(int(child), signal.SIGSTOP)
        for number in (signal.SIGCONT, signal.SIGUSR1, signal.SIGTERM):
            task.send_signal(number)
            time.sleep(0.3)  # to be taken one by one
            self.assertIsNone(task.poll(), number)
        os.kill(int(child), signal.SIGCONT)
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (143, ["requeue 17_0"]))
        self.assertIn("1 interrupted", self.riesel("status", "out").stdout)

    def test_what_is_cancelled_is_not_queued_again(self):
        task = self.start_task(ENDLESS)
        self.signal_within_run(task, signal.SIGTERM)
        self.assertEqual((task.wait(PATIENCE), self.requeued()), (143, []))


@unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
class OnACluster(SweepTest):

    @classmethod
    def setUpClass(cls):
        directory = tempfile.TemporaryDirectory(prefix="riesel-slurm-")
        cls.addClassCleanup(directory.cleanup)
        cls.cluster = slurm_cluster.Cluster(directory.name, array_size=4)
        cls.addClassCleanup(cls.cluster.stop)
        cls.cluster.start()

    def submit(self, text, *options):
        self.write("sweep.yaml", text)
        result = self.riesel("sweep", "sweep.yaml", "--out", "out", "--slurm", *options,
                             **self.cluster.environment)
        self.assert_done(result)
        self.assertRegex(result.stdout, r"submitted as job \d+; ")

    def result(self, text, out):
        self.assert_done(self.riesel("collect", out))
        return [{name: value for name, value in row.items()
                 if name != "attempts" and not name.startswith("performance.")}
                for row in self.rows(out)]

    def assert_ends_as_locally(self, text):
        self.assertIn(": {0} points: {0} done".format(len(self.points())),
                      self.riesel("status", "out").stdout, self.logs())
        self.sweep_to_end(text, "local")
        self.assertEqual(self.result(text, "out"), self.result(text, "local"))

    def attempts(self):
        return [json.loads(path.read_text(encoding="utf-8"))["attempts"]
                for path in self.home.glob("out/points/*/attempts.json")]

    def logs(self):
        return "\n".join(path.read_text() for path in self.home.glob("out/slurm/*.txt"))

    def test_a_sweep_larger_than_an_array(self):
        self.submit(FOUR)  # four points, and an array has three tasks here
        self.assertIn("--of 3 ", (self.home / "out/slurm.sh").read_text())
        self.cluster.wait_for_all_jobs()
        self.assert_ends_as_locally(FOUR)
        again = self.riesel("sweep", "sweep.yaml", "--out", "out", "--slurm",
                            **self.cluster.environment)
        self.assertEqual(again.stdout, self.riesel("status", "out").stdout)

    def test_chains(self):
        self.submit(CHAINS)
        self.cluster.wait_for_all_jobs()
        self.assert_ends_as_locally(CHAINS)

    def test_a_task_whose_time_is_over_is_queued_again(self):
        begin = time.monotonic()
        self.sweep_to_end(LONG, "local")
        takes = time.monotonic() - begin  # as long as a run: both go at once
        self.submit(LONG, "--max-walltime", f"{0.5 * takes:.1f} s")
        self.wait_for_requeue()
        self.cluster.wait_for_all_jobs(patience=240.0)
        self.assertGreater(max(self.attempts()), 1)
        self.assert_ends_as_locally(LONG)

    def test_the_signal_of_slurm_before_the_end_of_the_time(self):
        self.submit(LONG)
        self.wait_for_checkpoints(2)
        # What --signal=B:USR1@60 makes Slurm do, without the waiting.
        self.cluster.ask("scancel", "--batch", "--signal=USR1", "--user=root")
        self.wait_for_requeue()
        self.cluster.wait_for_all_jobs(patience=240.0)
        self.assertGreater(max(self.attempts()), 1)
        self.assert_ends_as_locally(LONG)

    def test_what_is_cancelled_is_not_queued_again(self):
        self.submit(LONG)
        self.wait_for_checkpoints(2)
        self.cluster.ask("scancel", "--batch", f"--signal={signal.SIGTERM.value}", "--user=root")
        self.cluster.wait_for_all_jobs()
        self.assertEqual(set(self.attempts()), {1})
        self.assertIn("2 interrupted", self.riesel("status", "out").stdout, self.logs())
        self.submit(LONG)
        self.cluster.wait_for_all_jobs(patience=240.0)
        self.assert_ends_as_locally(LONG)

    def wait_for_checkpoints(self, count):
        self.wait_for_slurm(lambda: len(list(self.home.glob("out/points/*/checkpoint.h5"))) >= count,
                            f"checkpoints of {count} points")

    def wait_for_requeue(self):
        self.wait_for_slurm(lambda: any(job[2] != "0" for job in self.cluster.jobs() or []), "a job queued again")

    def wait_for_slurm(self, happened, what):
        """It may need minutes to queue a job again."""
        self.cluster.wait_until(happened, what, 240.0, self.logs)
