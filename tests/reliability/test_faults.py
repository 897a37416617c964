"""Faults on order, by a library that is preloaded (fault_shim.c): a run is killed inside any of the calls
that change its files, or the call fails. Nothing that was saved is lost, and nothing stands half-written.

The variable RIESEL_KILLS tells how many kills inside calls are tried, 24 unless it is set, and half as many
at any moment; `all` tries each call, before and after it is done, and 200 moments. The same seed gives the same
kills inside calls.
"""

import errno
import os
import random
import shutil
import signal
import time

import h5py
import numpy as np

from riesel_command import PATIENCE, CommandTest, SMALL_TUBE, bytes_of_files, saved_step

SHIM = os.environ["RIESEL_SHIM"]
KILLS = os.environ.get("RIESEL_KILLS", "24")
# Saves with each row: about 20 rows, and at each some 18 calls.
OUTPUT = "output: {interval: 0.3 ms, checkpoint_interval: 1e-6 s}\n"
TUBE = SMALL_TUBE.replace("5 ms", "6 ms") + OUTPUT
# Saved nearly as often, in an eighth of the steps: threads that wait for each other take longer on a busy machine.
WINDOWS = SMALL_TUBE.replace("5 ms", "0.8 ms, stepping: windows") + OUTPUT.replace("0.3 ms", "0.05 ms")
# A frame with each row, and 17 calls more.
FRAMES = SMALL_TUBE.replace("5 ms", "3 ms") + OUTPUT.replace("}", ", trajectory_interval: 0.3 ms}")
# It neither ends nor saves by itself.
ENDLESS = ["--set", "run.duration=1000 s", "--set", "output.checkpoint_interval=1 h"]
AS_IN_TUBE = ["--set", "run.duration=6 ms", "--set", "output.checkpoint_interval=1e-6 s"]
BEGINNING = "mkdir open fsync close open ftruncate pwrite"  # the directory and its lock
KINDS = ["open", "write", "fsync", "close", "link", "rename"]
ERRORS = {28: "No space left", 5: "Input/output error", 13: "Permission denied", 30: "Read-only",
          122: "Disk quota exceeded"}


def frames_of(run_directory):
    """The grains' places and velocities in all frames of the trajectory; nothing if there is none."""
    if not (run_directory / "trajectory.h5").exists():
        return None
    with h5py.File(run_directory / "trajectory.h5", "r") as file:
        grains = file["particles/grains"]
        return np.stack([grains["position/value"][:], grains["velocity/value"][:]], axis=1)


class FaultTest(CommandTest):
    TUBE = TUBE
    threads = 1

    @classmethod
    def setUpClass(cls):
        cls.maker = cls.maker()
        cls.maker.write("tube.yaml", cls.TUBE)
        cls.maker.faulty("run", "tube.yaml", "--out", "out", log=True)
        cls.whole = cls.maker.home / "out"
        cls.maker.assert_same_result(cls.whole, cls.maker.run_to_end("tube.yaml", "alone"))
        cls.calls = (cls.maker.home / "log").read_text(encoding="ascii").split()

    def setUp(self):
        super().setUp()
        self.write("tube.yaml", self.TUBE)
        self.out = self.home / "out"
        self.random = random.Random(1)

    def environment(self, fault=None, log=False):
        """Names of files must be relative then, as the shim wants them."""
        # A thread that waits leaves its core to that which it waits for.
        environment = {"LD_PRELOAD": SHIM, "OMP_WAIT_POLICY": "passive"}
        if fault is not None:
            environment["RIESEL_FAULT"] = fault
        if log:
            environment["RIESEL_FAULT_LOG"] = str(self.home / "log")
        return environment

    def faulty(self, *arguments, **how):
        """Calls the command with a fault."""
        return self.riesel(*arguments, "--threads", self.threads, **self.environment(**how))

    def start_faulty(self, *arguments, **how):
        return self.start(*arguments, "--threads", self.threads, env={**os.environ, **self.environment(**how)})

    def wait_for_calls(self, name, count):
        """Until the log tells so many of them: each is told before it is made."""
        log = self.home / "log"
        self.wait_until(lambda: log.exists() and log.read_text(encoding="ascii").split().count(name) >= count,
                        f"call {count} of {name}")

    def start_again(self):
        if self.out.exists():
            shutil.rmtree(self.out)

    def go_on(self, **how):
        """As a user would: resumes, or starts again where nothing had been saved yet."""
        if not (self.out / "checkpoint.h5").exists() and not (
                self.out / "checkpoint.h5.previous").exists():
            self.start_again()
            return self.faulty("run", "tube.yaml", "--out", "out", **how)
        return self.faulty("resume", "out", **how)

    def assert_goes_on_as_uninterrupted(self):
        self.assert_done(self.go_on())
        self.assert_came_to_the_same()

    def assert_came_to_the_same(self):
        self.assert_same_result(self.whole, self.out)
        left = [path.name for path in self.out.iterdir() if path.suffix in (".tmp", ".replaced")]
        self.assertEqual(left, [])

    def kill_at(self, call, how):
        result = self.faulty("run", "tube.yaml", "--out", "out", fault=f"any:{call}:{how}")
        self.assertEqual(result.returncode, -signal.SIGKILL, result)

    def kill_at_moment(self, moment):
        """Returns whether the kill met a run that went on, and had a checkpoint."""
        self.start_again()
        process = self.start_faulty("run", "tube.yaml", "--out", "out")
        time.sleep(moment)
        has_checkpoint = (self.out / "checkpoint.h5").exists()
        process.kill()
        process.communicate()
        return has_checkpoint and process.returncode == -signal.SIGKILL

    def assert_survives_kills_at_any_moment(self, kills):
        """So many kills at least, and then as many as it takes until half of `kills` have met a run that had a
        checkpoint: how long a run takes is known from the one before them only, and it varies on a busy machine."""
        begin = time.monotonic()
        self.assert_goes_on_as_uninterrupted()
        duration = time.monotonic() - begin
        tried = met = 0
        while tried < kills or (2 * met < kills and tried < 5 * kills):
            moment = self.random.uniform(0.0, duration)
            with self.subTest(moment=moment):
                tried += 1
                met += self.kill_at_moment(moment)
                self.assert_goes_on_as_uninterrupted()
        self.assertGreaterEqual(2 * met, kills, f"of {tried} kills only {met} met a run with a checkpoint")
        print(f"{tried} kills at any moment, {met} of them of a run with a checkpoint")

    def kills(self):
        """(number of the call, kill or killed_after)"""
        every = [(call, how) for call in range(1, len(self.calls) + 1)
                 for how in ("kill", "killed_after")]
        return every if KILLS == "all" else self.random.sample(every, min(len(every), int(KILLS)))

    def calls_but_whole_files(self):
        """The calls, with a star for each file that is written as a whole, in the right order."""
        file, name, directory = "open open write fsync close", "rename", "fsync close"  # the directory first
        rest = " ".join(self.calls)
        # The generation before is kept, but not by the first.
        for naming in ("link rename rename", "link rename", name):
            rest = rest.replace(f"{file} {naming} {directory}", "*")
        return rest

    def assert_goes_on_as_if_nothing_had_been(self, kind):
        """What a signal does to a write: it has done nothing, or a part. Riesel writes the rest."""
        for what in (errno.EINTR, "short"):
            for call in self.random.sample(range(1, self.calls.count(kind) + 1), 4):
                with self.subTest(kind=kind, what=what, call=call):
                    self.start_again()
                    self.assert_done(self.faulty("run", "tube.yaml", "--out", "out",
                                                 fault=f"{kind}:{call}:{what}"))
                    self.assert_same_result(self.whole, self.out)

    def assert_fails_with_word(self, result, error):
        self.assertEqual(result.returncode, 1, result)
        self.assert_one_message(result.stderr, "out", ERRORS[error])


class Faults(FaultTest):

    # --- the order in which a file is written ---

    def test_a_file_is_on_the_disk_before_it_gets_its_name_and_the_name_before_anything_else(self):
        self.assertRegex(self.calls_but_whole_files(), rf"\A{BEGINNING}( \*)+( close)?\Z")

    # --- kills ---

    def test_killed_inside_a_call(self):
        kills = self.kills()
        for call, how in kills:
            with self.subTest(call=call, name=self.calls[call - 1], how=how):
                self.start_again()
                self.kill_at(call, how)
                self.assert_goes_on_as_uninterrupted()
        print(f"{len(kills)} kills inside calls, of {len(self.calls)} calls")

    def test_killed_again_and_again(self):
        for _ in range(3):
            self.start_again()
            kills = 0
            while kills < 8:
                result = self.go_on(fault=f"any:{self.random.randrange(25, 60)}:kill")
                if result.returncode == 0:
                    break
                self.assertEqual(result.returncode, -signal.SIGKILL, result)
                kills += 1
            self.assertGreater(kills, 2)
            self.assert_goes_on_as_uninterrupted()

    def test_killed_at_any_moment(self):
        self.assert_survives_kills_at_any_moment(200 if KILLS == "all" else int(KILLS) // 2)

    # --- signals ---

    def test_a_second_signal_ends_a_run_that_is_held_while_it_saves(self):
        """It is held where run.h5 has the new rows already, and the new checkpoint has not got its name. By itself it
        would not go on before the test is over: what ends it is the second signal. SIGTERM soon after the first may
        be the same wish."""
        same_wish = 5.0  # s
        for first, second in ((signal.SIGTERM, signal.SIGTERM), (signal.SIGINT, signal.SIGINT),
                              (signal.SIGTERM, signal.SIGINT)):
            self.start_again()
            self.assert_done(self.faulty("run", "tube.yaml", "--out", "out", "--set", "run.duration=3 ms"))
            saved = saved_step(self.out)
            (self.home / "log").unlink(missing_ok=True)
            # It saves twice that its settings are others now; each time the checkpoint before gets a second name.
            process = self.start_faulty("resume", "out", *ENDLESS, fault="link:3:held", log=True)
            self.wait_for_calls("link", 2)
            time.sleep(self.random.uniform(0.0, 0.1))
            process.send_signal(first)
            self.wait_for_calls("link", 3)
            if second == signal.SIGTERM:
                process.send_signal(second)
                time.sleep(same_wish + 1.0)
                self.assertIsNone(process.poll())
            process.send_signal(second)
            _, stderr = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 128 + second, stderr)
            self.assertEqual(saved_step(self.out), saved)
            self.assertTrue((self.out / "checkpoint.h5.tmp").exists())
            self.assert_done(self.faulty("resume", "out", *AS_IN_TUBE))
            self.assert_came_to_the_same()

    # --- calls that fail ---

    def run_with_failure(self, kind, error, lasting):
        """A run of which one call of the kind fails, or all from one on, after the first checkpoint."""
        first = 2 if kind == "link" else 8
        call = self.random.randrange(first, self.calls.count(kind) // 2)
        self.start_again()
        return self.faulty("run", "tube.yaml", "--out", "out", fault=f"{kind}:{call}:{error}{lasting}")

    def test_a_call_that_fails_ends_the_run_with_a_message_and_loses_nothing(self):
        for kind in KINDS:
            for error, lasting in [(error, "") for error in ERRORS] + [(28, "+")]:
                with self.subTest(kind=kind, error=ERRORS[error], lasting=lasting):
                    result = self.run_with_failure(kind, error, lasting)
                    # Nothing depends on how a directory that has been synchronised is closed.
                    if kind != "close" or result.returncode != 0:
                        self.assert_fails_with_word(result, error)
                    self.assert_goes_on_as_uninterrupted()

    def test_a_call_that_fails_at_the_very_end_is_told_too(self):
        """When the last rows, the last checkpoint and the summary are saved."""
        for kind in KINDS:
            for before_the_last in range(4):
                call = self.calls.count(kind) - before_the_last
                with self.subTest(kind=kind, call=call):
                    self.start_again()
                    result = self.faulty("run", "tube.yaml", "--out", "out", fault=f"{kind}:{call}:28")
                    if kind != "close" or result.returncode != 0:
                        self.assert_fails_with_word(result, 28)
                    self.assert_goes_on_as_uninterrupted()

    def test_a_write_that_is_interrupted_by_a_signal_is_made_to_its_end(self):
        self.assert_goes_on_as_if_nothing_had_been("write")

    def test_where_a_file_can_have_one_name_only_the_generation_before_is_kept_all_the_same(self):
        for error in (errno.EPERM, errno.EOPNOTSUPP):
            with self.subTest(error=error):
                self.start_again()
                self.assert_done(self.faulty("run", "tube.yaml", "--out", "out", fault=f"link:1:{error}+"))
                self.assert_came_to_the_same()
                with h5py.File(self.out / "checkpoint.h5.previous", "r") as before:
                    self.assertGreater(before.attrs["step"], 0)

    def test_a_resume_that_fails_loses_nothing(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                self.start_again()
                self.kill_at(len(self.calls) // 2, "kill")
                before = bytes_of_files(self.out)
                result = self.faulty("resume", "out", fault=f"{kind}:1:28+")
                self.assert_fails_with_word(result, 28)
                after = bytes_of_files(self.out)
                for name in ("checkpoint.h5", "checkpoint.h5.previous"):
                    self.assertEqual(after[name], before[name], name)
                self.assert_goes_on_as_uninterrupted()

    def test_what_was_left_half_written_is_removed_or_told(self):
        for what in ("kill", "killed_after", errno.EIO):
            with self.subTest(what=what):
                self.start_again()
                self.kill_at(self.calls.index("rename", len(self.calls) // 2) + 1, "kill")
                result = self.faulty("resume", "out", fault=f"unlink:1:{what}")
                if what == errno.EIO:
                    self.assert_failed(result, "out", "File exists")
                else:
                    self.assertEqual(result.returncode, -signal.SIGKILL, result)
                self.assert_goes_on_as_uninterrupted()

    def test_the_summary_of_a_shorter_run_cannot_be_set_aside(self):
        self.assert_done(self.faulty("run", "tube.yaml", "--out", "out", "--set", "run.duration=3 ms"))
        result = self.faulty("resume", "out", *AS_IN_TUBE, fault=f"rename:1:{errno.EIO}")
        self.assert_fails_with_word(result, errno.EIO)
        self.assertIn("out/summary.json: cannot be set aside", result.stderr)
        self.assert_done(self.faulty("resume", "out", *AS_IN_TUBE))
        self.assert_came_to_the_same()

    def test_directories_are_on_the_disk_before_anything_is_put_in_them(self):
        (self.home / "log").unlink(missing_ok=True)
        self.assert_done(self.faulty("run", "tube.yaml", "--out", "out/of/some", log=True))
        calls = (self.home / "log").read_text(encoding="ascii")
        self.assertRegex(" ".join(calls.split()), r"\A(mkdir open fsync close ){3}open ftruncate")

    def test_the_directory_cannot_be_made(self):
        result = self.faulty("run", "tube.yaml", "--out", "out", fault=f"mkdir:1:{errno.EACCES}")
        self.assert_fails_with_word(result, errno.EACCES)
        self.assertFalse(self.out.exists())

    def test_nothing_can_be_written_at_all(self):
        result = self.faulty("run", "tube.yaml", "--out", "out", fault="open:1:13+")
        self.assert_fails_with_word(result, 13)
        self.assertEqual(bytes_of_files(self.out), {})


class FaultsOfWindows(FaultTest):
    """Runs on two threads, which come to the bits of one."""

    TUBE = WINDOWS
    threads = 2

    def test_killed_at_any_moment(self):
        self.assert_survives_kills_at_any_moment(100 if KILLS == "all" else int(KILLS) // 4)


class FaultsOfTrajectories(FaultTest):
    """trajectory.h5 is the only file that grows."""

    TUBE = FRAMES

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.frames = frames_of(cls.whole)

    def assert_frames_are_whole(self):
        """If there is a trajectory, it opens, and holds the first frames of the uninterrupted run."""
        frames = frames_of(self.out)
        if frames is not None:
            self.assertTrue(np.array_equal(frames, self.frames[:len(frames)]), len(frames))

    def calls_named(self, *names):
        return [number for number, name in enumerate(self.calls, 1) if name in names]

    def test_an_outline_is_on_the_disk_before_the_head_points_to_it(self):
        frame, commit = "( pwrite){5}", "( ftruncate)? fsync pwrite fsync pwrite fsync"
        self.assertRegex(self.calls_but_whole_files(),
                         rf"\A{BEGINNING}( \*)+ open((( \*)*{frame})?( \*)+{commit})+( \*)+( close)+\Z")

    def test_killed_inside_a_call(self):
        calls = self.calls_named("pwrite", "ftruncate")
        calls = sorted({call + more for call in calls for more in (0, 1)})  # and a call behind
        every = [(call, how) for call in calls for how in ("kill", "killed_after")]
        for call, how in every if KILLS == "all" else self.random.sample(every, int(KILLS) // 2):
            with self.subTest(call=call, name=self.calls[call - 1], how=how):
                self.start_again()
                self.kill_at(call, how)
                self.assert_frames_are_whole()
                self.assert_goes_on_as_uninterrupted()
                self.assertTrue(np.array_equal(frames_of(self.out), self.frames))

    def test_a_write_that_is_interrupted_by_a_signal_is_made_to_its_end(self):
        self.assert_goes_on_as_if_nothing_had_been("pwrite")
        self.assertTrue(np.array_equal(frames_of(self.out), self.frames))

    def test_a_call_that_fails_ends_the_run_with_a_message_and_loses_nothing(self):
        for error in (28, 5):
            with self.subTest(error=ERRORS[error]):
                self.start_again()
                call = self.random.randrange(10, len(self.calls_named("pwrite")))
                result = self.faulty("run", "tube.yaml", "--out", "out", fault=f"pwrite:{call}:{error}")
                self.assert_fails_with_word(result, error)
                self.assert_frames_are_whole()
                self.assert_goes_on_as_uninterrupted()
                self.assertTrue(np.array_equal(frames_of(self.out), self.frames))
