"""A run that is stopped at any moment, politely or not, goes on as if it had never been stopped."""

import fcntl
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time

import h5py

from riesel_command import (COMMAND, FAILED, IMPACT, OUT_OF_TIME, PATIENCE, SMALL_TUBE, CommandTest, bytes_of_files,
                            data_of, final_time, saved_step)

# Rows of 1 ms hold about 1000 steps; the run ends long after the tests. After its first checkpoint none is due:
# what is saved later has been saved because the run was told to stop.
LONG_TUBE = SMALL_TUBE.replace("5 ms", "1000 s") + (
    "output: {checkpoint_interval: 1 h, trajectory_interval: 10 ms}\n")
SAVE_OFTEN = ["--set", "output.checkpoint_interval=0.02 s"]
LIMIT = 6.0  # s, on the clock


def reaction(process, number):
    """What the process does about the signal: "catches" or "ignores" it, or neither."""
    status = pathlib.Path(f"/proc/{process}/status").read_text(encoding="ascii")
    for name, word in (("SigCgt", "catches"), ("SigIgn", "ignores")):
        signals = int(re.search(rf"^{name}:\s*([0-9a-f]+)$", status, re.MULTILINE).group(1), 16)
        if signals >> (number - 1) & 1:
            return word
    return "neither"


class Interruption(CommandTest):

    def setUp(self):
        super().setUp()
        self.out = self.home / "out"
        self.moments = random.Random(1)
        self.write("long.yaml", LONG_TUBE)

    def holds_the_directory(self, process):
        lock = self.out / ".lock"
        return lock.exists() and f"process {process.pid} " in lock.read_text(encoding="utf-8")

    def last_frame(self):
        """When it was written: a frame is, long before a checkpoint tells of it."""
        return (self.out / "trajectory.h5").stat().st_mtime_ns

    def start_and_get_on(self, arguments, progress):
        """Starts the command; returns it when it has made steps: `progress` is a number that grows with them."""
        process = self.start(*arguments, "--threads", 1)
        self.wait_until(lambda: self.holds_the_directory(process), "the start")
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        before = progress()
        self.wait_until(lambda: progress() > before or process.poll() is not None, "a step")
        return process

    def start_and_stop(self, arguments, number, progress=None):
        """Runs the command on for a random moment; returns its status and stderr."""
        process = self.start_and_get_on(arguments, progress or self.last_frame)
        time.sleep(self.moments.uniform(0.0, 0.3))
        self.assertIsNone(process.poll(), "the run has ended by itself")
        process.send_signal(number)
        stdout, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(stdout, "")
        return process.returncode, stderr

    def assert_saved_where_it_stopped(self, stderr, before):
        """At the time that is told, and later than the step `before`. Returns the step of the checkpoint."""
        with h5py.File(self.out / "checkpoint.h5", "r") as file:
            step, reached = file.attrs["step"].item(), file.attrs["step"] * file.attrs["time_step"]
        self.assertGreater(step, before)
        self.assertTrue(stderr.endswith(f" at t = {reached:.6g} s; 'riesel resume out' goes on from there\n"), stderr)
        self.assertEqual(final_time(self.out), reached)
        return step

    def assert_goes_on_as_uninterrupted(self, settings="long.yaml", rows=5):
        end = f"run.duration={final_time(self.out) + 3.3e-3!r}"
        self.resume_to_end(self.out, "--set", end)
        whole = self.run_to_end(settings, "whole", "--set", end)
        self.assert_same_result(whole, self.out)
        self.assertGreater(data_of(whole)["/series/time"][1][0], rows, "rows")

    def test_by_polite_signals(self):
        arguments, step = ["run", "long.yaml", "--out", "out"], 0
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            status, stderr = self.start_and_stop(arguments, number)
            self.assertEqual(status, 128 + number, stderr)
            self.assertIn("interrupted at t = ", stderr)
            step = self.assert_saved_where_it_stopped(stderr, step)
            arguments = ["resume", "out"]
        self.assert_goes_on_as_uninterrupted()

    def test_a_terminal_that_goes_is_nothing_to_a_run_that_was_told_so(self):
        """As nohup tells it."""
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1,
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        self.assertEqual(reaction(process.pid, signal.SIGTERM), "catches")
        self.assertEqual(reaction(process.pid, signal.SIGHUP), "ignores")

    def test_a_limit_on_the_size_of_files_is_an_error_of_writing(self):
        """Which the system tells by a signal besides."""
        result = self.riesel_with_files_of_at_most(20_000, "run", "long.yaml", "--out", "out", "--threads", 1)
        self.assertEqual(result.returncode, FAILED, result)
        self.assert_one_message(result.stderr, "File too large", "raise the limit on the size of files")
        self.assertEqual(list(self.out.glob("*.tmp")), [])

    def test_one_wish_may_come_several_times(self):
        """Of a terminal that goes, or of whoever ends all processes."""
        for number, arguments in ((signal.SIGHUP, ["run", "long.yaml", "--out", "out"]),
                                  (signal.SIGTERM, ["resume", "out"])):
            process = self.start_and_get_on(arguments, self.last_frame)
            before = saved_step(self.out)
            for _ in range(3):
                process.send_signal(number)
                time.sleep(0.001)
            _, stderr = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 128 + number, stderr)
            self.assert_saved_where_it_stopped(stderr, before)

    def test_whoever_reads_the_messages_may_go(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1, "--verbose", *SAVE_OFTEN)
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        process.stderr.close()
        before = saved_step(self.out)
        self.wait_until(lambda: saved_step(self.out) > before or process.poll() is not None, "another checkpoint")
        self.assertIsNone(process.poll())

    def test_whoever_reads_the_result_may_go(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1, "--set", "run.duration=1 ms")
        process.stdout.close()
        process.wait(timeout=PATIENCE)
        self.assertIn("the reader of the output has closed it", process.stderr.read())
        self.assertEqual(process.returncode, 1)
        self.assertTrue((self.out / "summary.json").exists())

    def test_by_kills_and_polite_signals(self):
        """A kill loses what has come since the last checkpoint, which is another one each time."""
        arguments = ["run", "long.yaml", "--out", "out", *SAVE_OFTEN]
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGKILL, signal.SIGINT):
            status, stderr = self.start_and_stop(arguments, number, lambda: saved_step(self.out))
            self.assertEqual(status, -number if number == signal.SIGKILL else 128 + number, stderr)
            arguments = ["resume", "out"]
        self.assert_goes_on_as_uninterrupted()

    def test_after_a_signal_there_is_no_summary(self):
        self.start_and_stop(["run", "long.yaml", "--out", "out"], signal.SIGINT)
        self.assertFalse((self.out / "summary.json").exists())

    def test_before_the_first_checkpoint(self):
        """A run that was killed early can be resumed, or else says how to begin again."""
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1)
        self.wait_until((self.out / "run.h5").exists, "the start")
        process.kill()
        process.communicate()
        can_go_on = any((self.out / name).exists() for name in ("checkpoint.h5", "checkpoint.h5.previous"))
        result = self.riesel("resume", "out", "--set", "run.duration=1000 s", "--max-walltime", "0.2 s")
        if can_go_on:
            self.assertEqual(result.returncode, OUT_OF_TIME, result)
        else:
            self.assert_refused(result, "out", "start the run again")

    def test_what_has_hardly_begun_is_not_called_dead(self):
        """A run in its first save is one that holds the lock and has no checkpoint."""
        self.run_to_end("long.yaml", "out", "--set", "run.duration=1 ms")
        for path in [self.out / "summary.json", *self.out.glob("checkpoint*")]:
            path.unlink()
        with open(self.out / ".lock", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            before = bytes_of_files(self.out)
            self.assert_refused(self.riesel("resume", "out"), "out: is in use by another process", "wait")
            self.assert_refused(self.riesel("run", "long.yaml", "--out", "out"),
                                "out: is in use by another process", "--out")
            self.assertEqual(bytes_of_files(self.out), before)
        self.assert_refused(self.riesel("resume", "out"), "remove it and start the run again")

    def test_by_the_limit_on_the_clock(self):
        """Of a run that is resumed, too. It is held up for a while, in a piece of the way or in saving: from then on
        it keeps twice that time in reserve, which is far more than what a busy machine may delay its end by."""
        self.write("pieces.yaml", LONG_TUBE.replace("10 ms}", "0.3 s, interval: 0.3 s}"))
        arguments, step = ["run", "pieces.yaml", "--out", "out"], 0
        for _ in range(2):
            begin = time.monotonic()
            process = self.start_and_get_on([*arguments, "--max-walltime", f"{LIMIT} s"], self.last_frame)
            process.send_signal(signal.SIGSTOP)
            time.sleep(LIMIT / 6)
            process.send_signal(signal.SIGCONT)
            stdout, stderr = process.communicate(timeout=PATIENCE)
            self.assertLess(time.monotonic() - begin, LIMIT)
            self.assertEqual((process.returncode, stdout), (OUT_OF_TIME, ""), stderr)
            self.assertIn("out of time (--max-walltime) at t = ", stderr)
            step = self.assert_saved_where_it_stopped(stderr, step)
            arguments = ["resume", "out"]
        self.assert_goes_on_as_uninterrupted("pieces.yaml", rows=1)

    def test_by_the_limit_on_the_clock_with_far_more_threads_than_cores(self):
        """Whose steps may take a thousand times as long: ten thousand of them are not to be waited for."""
        self.write("slow.yaml", LONG_TUBE.replace("10 ms}", "100 s, interval: 1 s}"))
        begin = time.monotonic()
        result = self.riesel("run", "slow.yaml", "--out", "out", "--threads", 64, "--set", "run.stepping=plain",
                             "--max-walltime", f"{LIMIT} s")
        self.assertEqual(result.returncode, OUT_OF_TIME, result)
        self.assertLess(time.monotonic() - begin, LIMIT)

    def test_by_the_limit_on_the_clock_when_saving_takes_longer_and_longer(self):
        """The reserve is twice what the last saving took, so it is saved whenever the series has doubled."""
        for limit, saves in (["--max-walltime", "1 h"], 4), ([], 2):
            result = self.riesel("run", "long.yaml", "--out", "out", "--verbose", "--set", "run.duration=10 ms",
                                 "--set", "output.interval=2 us", *limit)
            self.assertEqual(result.returncode, 0, result)
            self.assertEqual(result.stderr.count("checkpoint at t = "), saves, result.stderr)
            shutil.rmtree(self.out)

    def test_messages_are_never_written_into_the_files_of_a_run(self):
        """If standard streams are closed the next files that are opened would get their numbers."""
        for closed in ("2>&-", "<&- 2>&-", "<&- >&- 2>&-"):
            with self.subTest(closed=closed):
                for earlier in (self.out, self.home / "whole"):
                    shutil.rmtree(earlier, ignore_errors=True)
                arguments = ["run", "long.yaml", "--out", "out", "--threads", "1", *SAVE_OFTEN]
                process = subprocess.Popen(["sh", "-c", f'exec "$@" {closed}', "sh", COMMAND, *arguments], cwd=self.home)
                self.wait_until((self.out / "checkpoint.h5.previous").exists, "the second checkpoint")
                process.terminate()
                self.assertEqual(process.wait(PATIENCE), 143)
                lock = (self.out / ".lock").read_text(encoding="utf-8")
                self.assertRegex(lock, r"\Aprocess \d+ on \S+\Z")
                self.assert_goes_on_as_uninterrupted(rows=1)

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
                    self.wait_until(lambda p=process: reaction(p.pid, number) == "catches", "the start")
                    process.send_signal(number)
                    _, stderr = process.communicate(timeout=PATIENCE)
                    self.assertEqual(process.returncode, 128 + number, stderr)
                    self.assertRegex(stderr, r"riesel: interrupted; [^\n]+\. [^\n]+\n\Z")
                    self.assertFalse(self.out.exists())

    def test_a_run_whose_lock_is_removed_ends_and_can_go_on(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1, *SAVE_OFTEN)
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        (self.out / ".lock").unlink()
        _, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 1, stderr)
        self.assertIn("out/.lock: has been removed or replaced", stderr)
        self.assert_goes_on_as_uninterrupted(rows=1)

    def test_files_of_another_run_are_not_taken_for_its_own(self):
        short = ["--set", "run.duration=21 ms"]
        mine = self.run_to_end("long.yaml", "mine", *short)
        for change in ("seed=7", "contact.friction=0.1"):
            other = self.run_to_end("long.yaml", change, *short, "--set", change)
            for name in ("run.h5", "checkpoint.h5", "trajectory.h5"):
                with self.subTest(change=change, name=name):
                    shutil.rmtree(self.home / "mixed", ignore_errors=True)
                    mixed = pathlib.Path(shutil.copytree(mine, self.home / "mixed"))
                    shutil.copy(other / name, mixed / name)
                    before = data_of(mixed)
                    result = self.riesel("resume", "mixed", "--set", "run.duration=25 ms")
                    self.assert_refused(result, "it belongs to another run", "restore the file that belongs to it")
                    self.assertEqual(data_of(mixed), before)
                    self.assertEqual((mixed / name).read_bytes(), (other / name).read_bytes())
        self.resume_to_end(mine, "--set", "run.duration=25 ms")

    def test_the_directory_of_a_run_that_goes_on_is_nobody_elses(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1)
        self.wait_until((self.out / "checkpoint.h5").exists, "the first checkpoint")
        self.assert_refused(self.riesel("resume", "out"), "out", "in use", str(process.pid))
        self.assert_refused(self.riesel("run", "long.yaml", "--out", "out"), "out", "a run already")
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.assertEqual(process.returncode, 143)
        self.assert_goes_on_as_uninterrupted()
