"""A run that is stopped at any moment, politely or not, goes on as if it had never been stopped."""

import pathlib
import random
import re
import signal
import time

from riesel_command import PATIENCE, SMALL_TUBE, CommandTest, data_of, final_time

# Rows of 1 ms hold about 1000 steps; the run ends long after the tests.
LONG_TUBE = SMALL_TUBE.replace("5 ms", "1000 s") + "output: {checkpoint_interval: 0.02 s}\n"
IMPACT = """\
scenario: single_wall_grain
contact: {stiffness: 2000 N/m, restitution: 0.9}
impact: {axial_velocity: [1 m/s]}
"""
OUT_OF_TIME = 3


def catches(process, number):
    """Whether the process has a handler for the signal."""
    status = pathlib.Path(f"/proc/{process}/status").read_text(encoding="ascii")
    caught = int(re.search(r"^SigCgt:\s*([0-9a-f]+)$", status, re.MULTILINE).group(1), 16)
    return caught >> (number - 1) & 1 == 1


class Interruption(CommandTest):

    def setUp(self):
        super().setUp()
        self.out = self.home / "out"
        self.moments = random.Random(1)
        self.write("long.yaml", LONG_TUBE)

    def wait_until(self, happened, what):
        deadline = time.monotonic() + PATIENCE
        while not happened():
            self.assertLess(time.monotonic(), deadline, f"{what} has not happened")
            time.sleep(0.002)

    def holds_the_directory(self, process):
        lock = self.out / ".lock"
        return lock.exists() and f"process {process.pid} " in lock.read_text(encoding="utf-8")

    def start_and_stop(self, arguments, *signals):
        """Runs the command for a random moment; returns it with stdout and stderr."""
        process = self.start(*arguments, "--threads", 1)
        self.wait_until(lambda: self.holds_the_directory(process), "the start")
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        time.sleep(self.moments.uniform(0.0, 0.3))
        self.assertIsNone(process.poll(), "the run has ended by itself")
        for number in signals:
            process.send_signal(number)
        stdout, stderr = process.communicate(timeout=PATIENCE)
        return process.returncode, stdout, stderr

    def run_and_resume(self, stops):
        """`stops`: (signals, expected status) one after the other. Returns the time reached."""
        arguments = ["run", "long.yaml", "--out", "out"]
        for signals, status in stops:
            with self.subTest(signals):
                returned, stdout, stderr = self.start_and_stop(arguments, *signals)
                self.assertEqual(returned, status, stderr)
                self.assertEqual(stdout, "")
            arguments = ["resume", "out"]
        return final_time(self.out)

    def assert_goes_on_as_uninterrupted(self, reached):
        end = f"run.duration={reached + 3.3e-3!r}"
        self.resume_to_end(self.out, "--set", end)
        whole = self.run_to_end("long.yaml", "whole", "--set", end)
        self.assert_same_result(whole, self.out)
        self.assertGreater(data_of(whole)["/series/time"][1][0], 5, "rows")

    def test_by_polite_signals(self):
        reached = self.run_and_resume([([signal.SIGTERM], 143), ([signal.SIGINT], 130),
                                       ([signal.SIGTERM], 143)])
        self.assert_goes_on_as_uninterrupted(reached)

    def test_by_impatient_signals_and_kills(self):
        reached = self.run_and_resume([([signal.SIGKILL], -signal.SIGKILL),
                                       ([signal.SIGTERM, signal.SIGTERM], 143),
                                       ([signal.SIGKILL], -signal.SIGKILL),
                                       ([signal.SIGINT], 130)])
        self.assert_goes_on_as_uninterrupted(reached)

    def test_the_way_to_go_on_is_told(self):
        _, _, stderr = self.start_and_stop(["run", "long.yaml", "--out", "out"], signal.SIGINT)
        self.assertRegex(
            stderr, r"interrupted at t = \S+ s; 'riesel resume out' goes on from there\n\Z")
        self.assertFalse((self.out / "summary.json").exists())

    def test_before_the_first_checkpoint(self):
        """A run that was killed early can be resumed, or else says how to begin again."""
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1, "--set",
                             "output.checkpoint_interval=1 h")
        self.wait_until((self.out / "run.h5").exists, "the start")
        process.kill()
        process.communicate()
        result = self.riesel("resume", "out", "--set", "run.duration=1 ms")
        if result.returncode != 0:
            self.assert_refused(result, "out", "start the run again")

    def test_by_the_limit_on_the_clock(self):
        limit = ["--max-walltime", "1.5 s"]
        for arguments in (["run", "long.yaml", "--out", "out"], ["resume", "out"]):
            result = self.riesel(*arguments, "--threads", 1, *limit)
            self.assertEqual((result.returncode, result.stdout), (OUT_OF_TIME, ""), result)
            self.assertRegex(result.stderr, r"out of time \(--max-walltime\) at t = \S+ s; "
                                            r"'riesel resume out' goes on from there\n\Z")
        self.assert_goes_on_as_uninterrupted(final_time(self.out))

    def test_a_limit_on_the_clock_that_is_none(self):
        for limit in ("soon", "3 m", "-1 s", "0"):
            self.assert_refused(self.riesel("run", "long.yaml", "--max-walltime", limit),
                                "--max-walltime", limit)
        self.write("impact.yaml", IMPACT)
        self.assert_refused(self.riesel("run", "impact.yaml", "--max-walltime", "1 h"),
                            "--max-walltime", "no effect")
        self.assertFalse((self.home / "runs").exists())

    def test_while_nothing_is_written_yet(self):
        """The packing of a dense tube and riesel check, which runs on for a while to measure speed."""
        dense = ["--set", "grains.area_fraction=0.76", "--set", "tube.length=400 mm"]
        for command in (["run", "long.yaml", "--out", "out"], ["check", "long.yaml"]):
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(command=command, number=number):
                    process = self.start(*command, *dense)
                    self.wait_until(lambda p=process: catches(p.pid, number), "the start")
                    process.send_signal(number)
                    _, stderr = process.communicate(timeout=PATIENCE)
                    self.assertEqual(process.returncode, 128 + number, stderr)
                    self.assertRegex(stderr, r"riesel: interrupted, [^\n]+; [^\n]+\n\Z")
                    self.assertFalse(self.out.exists())

    def test_the_directory_of_a_run_that_goes_on_is_nobody_elses(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1)
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        second = self.riesel("resume", "out")
        self.assertNotEqual(second.returncode, 0)
        self.assert_one_message(second.stderr, "out", "in use", str(process.pid))
        self.assert_refused(self.riesel("run", "long.yaml", "--out", "out"), "out", "a run already")
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.assertEqual(process.returncode, 143)
        self.assert_goes_on_as_uninterrupted(final_time(self.out))
