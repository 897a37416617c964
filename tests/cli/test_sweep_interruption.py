"""A sweep that is stopped at any moment, politely or not, goes on as if it had never been stopped."""

import contextlib
import fcntl
import os
import pathlib
import random
import shutil
import signal
import time

from riesel_command import DONE, FAILED, PATIENCE, saved_step
from sweep_command import SweepTest

# Each run takes a second or so: several times as long as interrupt() waits before it stops the sweep.
LONG = """\
base: tube.yaml
set: {run.duration: 1500 ms, output.checkpoint_interval: 0.02 s}
axes: {contact.restitution: [0.7, 0.8, 0.9]}
"""
LONG_CHAIN = LONG + "continue_along: contact.restitution\n"

# It never ends by itself.
ENDLESS = LONG.replace("1500 ms", "1000 s")


def saved_by_its_end(text):
    """The sweep whose runs have no checkpoint due between the first and the end; frames tell that they get on."""
    return text.replace("interval: 0.02 s", "interval: 1 h, output.trajectory_interval: 1 ms")


def children_of(pid):
    """Of its main thread."""
    try:
        text = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii")
    except FileNotFoundError:
        return []
    return [int(child) for child in text.split()]


def is_alive(pid):
    try:
        stat = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    except FileNotFoundError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


class Interruption(SweepTest):

    def setUp(self):
        super().setUp()
        self.moments = random.Random(1)

    def start_sweep(self, text, *options):
        """Returns the process, which has children that have checkpoints."""
        self.write("sweep.yaml", text)
        process = self.start("sweep", "sweep.yaml", "--out", "out", "--jobs", 2, *options)
        self.wait_until(lambda: children_of(process.pid) or process.poll() is not None,
                        "the start of a run")
        self.wait_until(lambda: list(self.home.glob("out/points/*/checkpoint.h5")),
                        "the first checkpoint")
        return process

    def last_frames(self):
        """{directory of a run with a checkpoint: when its last frame was written}"""
        return {path.parent: (path.parent / "trajectory.h5").stat().st_mtime_ns
                for path in self.home.glob("out/points/*/checkpoint.h5")}

    def wait_until_two_get_on(self):
        """Returns the directories of runs that have made steps since the call: two at least."""
        first = {}

        def getting_on():
            frames = self.last_frames()
            for run, frame in frames.items():
                first.setdefault(run, frame)
            return [run for run, frame in frames.items() if frame > first[run]]

        self.wait_until(lambda: len(getting_on()) >= 2, "a frame of two runs")
        return getting_on()

    def stop(self, process, number):
        """Sends the signal and waits for the end of the sweep; its runs may take a little longer."""
        children = children_of(process.pid)
        process.send_signal(number)
        process.communicate(timeout=PATIENCE)
        if process.returncode > 0:
            self.assertFalse(any(map(is_alive, children)), "a run outlives its sweep")
        return process.returncode

    def result_of(self, out):
        """All of the table that must not depend on what happened on the way."""
        rows = self.rows(out)
        for row in rows:
            del row["attempts"]
            for column in list(row):
                if column.startswith("performance."):
                    del row[column]
        return rows

    def assert_goes_on_as_uninterrupted(self, text):
        self.sweep_to_end(text, "out")
        self.sweep_to_end(text, "whole")
        self.assertEqual(self.result_of("out"), self.result_of("whole"))
        for row in self.rows("out"):
            self.assert_same_result(self.home / "out/points" / row["point"],
                                    self.home / "whole/points" / row["point"])

    def interrupt(self, text, signals):
        """Returns how many of the signals met the sweep at work: it may have come to its end before."""
        met = 0
        for number, status in signals:
            process = self.start_sweep(text)
            time.sleep(self.moments.uniform(0.0, 0.2))
            ended_with = self.stop(process, number)
            self.assertIn(ended_with, (status, DONE))
            met += ended_with == status
        return met

    def test_by_polite_signals(self):
        text = saved_by_its_end(LONG)
        self.interrupt(text, [(signal.SIGTERM, 143)])
        self.assertIn("interrupted", {point["status"] for point in self.points()})
        # The runs have come further now: nothing says that the next signal finds one at work.
        self.interrupt(text, [(signal.SIGINT, 130)])
        self.assertEqual({point["status"] for point in self.points()}
                         - {"interrupted", "waiting", "done"}, set())
        self.assert_goes_on_as_uninterrupted(text)

    def test_a_polite_signal_lets_each_run_save_what_it_has_reached(self):
        steps = {}
        for number in (signal.SIGTERM, signal.SIGINT):
            process = self.start_sweep(saved_by_its_end(ENDLESS))
            running = self.wait_until_two_get_on()
            self.assertEqual(self.stop(process, number), 128 + number)
            for run in running:
                self.assertGreater(saved_step(run), steps.get(run, 0))
            steps = {run: saved_step(run) for run in running}

    def test_a_signal_to_all_processes_lets_each_run_save_too(self):
        """As batch systems and shutdowns send it: a run gets it from them and from its sweep."""
        process = self.start_sweep(saved_by_its_end(ENDLESS))
        running = self.wait_until_two_get_on()
        for child in children_of(process.pid):
            os.kill(child, signal.SIGTERM)
        self.assertEqual(self.stop(process, signal.SIGTERM), 128 + signal.SIGTERM)
        for run in running:
            self.assertGreater(saved_step(run), 0)

    def test_runs_do_not_outlive_a_killed_sweep(self):
        process = self.start_sweep(ENDLESS)
        children = children_of(process.pid)
        self.assertEqual(len(children), 2)
        self.stop(process, signal.SIGKILL)
        self.wait_until(lambda: not any(map(is_alive, children)), "the end of the runs")
        self.assertIn("2 interrupted, 1 waiting", self.riesel("status", "out").stdout)

    def test_runs_of_a_killed_sweep_save_what_they_have_reached(self):
        process = self.start_sweep(saved_by_its_end(ENDLESS))
        children, running = children_of(process.pid), self.wait_until_two_get_on()
        self.stop(process, signal.SIGKILL)
        self.wait_until(lambda: not any(map(is_alive, children)), "the end of the runs")
        for run in running:
            self.assertGreater(saved_step(run), 0)

    def test_a_second_wish_to_end_does_not_wait_for_the_runs(self):
        process = self.start_sweep(ENDLESS)
        slow, other = children_of(process.pid)
        os.kill(slow, signal.SIGSTOP)
        try:
            process.send_signal(signal.SIGINT)
            self.wait_until(lambda: not is_alive(other), "the end of the other run")
            self.assertIsNone(process.poll())
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(PATIENCE), 128 + signal.SIGINT)
        finally:
            os.kill(slow, signal.SIGCONT)
        self.wait_until(lambda: not is_alive(slow), "the end of the run that slept")

    def test_a_run_that_is_stopped_again_and_again_is_started_three_times(self):
        self.write("sweep.yaml", ENDLESS.replace("[0.7, 0.8, 0.9]", "[0.7]"))
        process = self.start("sweep", "sweep.yaml", "--out", "out", "--jobs", 1)
        stopped = set()
        for _ in range(3):
            self.wait_until(lambda: set(children_of(process.pid)) - stopped, "a start of the run")
            run, = set(children_of(process.pid)) - stopped
            os.kill(run, signal.SIGKILL)
            stopped.add(run)
        _, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, FAILED)
        self.assertIn("was stopped 3 times", stderr)
        point, = self.points()
        self.assertEqual((point["attempts"], point["status"]), (3, "interrupted"))

    def test_a_run_killed_before_its_first_checkpoint_begins_again(self):
        self.write("sweep.yaml", """\
base: tube.yaml
set: {run.duration: 20 ms, output.trajectory_interval: 1 ms}
axes: {contact.restitution: [0.8]}
""")
        arguments = ("sweep", "sweep.yaml", "--out", "out", "--jobs", 1)
        self.assertEqual(self.riesel(*arguments).returncode, DONE)
        point, = self.home.glob("out/points/*")
        whole = self.state_hash(point)
        for left_behind in ("checkpoint.h5", "checkpoint.h5.previous", "summary.json"):
            (point / left_behind).unlink(missing_ok=True)
        self.assertTrue((point / "trajectory.h5").exists())
        again = self.riesel(*arguments)
        self.assertEqual(again.returncode, DONE, again)
        self.assertEqual(self.state_hash(point), whole)

    def test_by_kills(self):
        """Where the machine is so fast or the test is held up so long that the sweep ends before all of them, it is
        tried anew."""
        met = tries = 0
        while met == 0 and tries < 5:
            tries += 1
            shutil.rmtree(self.home / "out", ignore_errors=True)
            met = self.interrupt(LONG_CHAIN, [(signal.SIGKILL, -signal.SIGKILL)] * 3)
            self.assert_goes_on_as_uninterrupted(LONG_CHAIN)
        self.assertGreater(met, 0, "no kill met the sweep at work")

    def test_a_killed_run_is_gone_on_with_in_the_same_sweep(self):
        for number in (signal.SIGKILL, signal.SIGXCPU, signal.SIGUSR1):
            with self.subTest(number):
                shutil.rmtree(self.home / "out", ignore_errors=True)
                process = self.start_sweep(LONG)
                os.kill(children_of(process.pid)[0], number)
                _, stderr = process.communicate(timeout=PATIENCE)
                self.assertEqual(process.returncode, DONE, stderr)
                self.assertEqual(sorted(point["attempts"] for point in self.points()), [1, 1, 2])

    def test_a_crash_is_a_failure_and_does_not_stop_the_others(self):
        process = self.start_sweep(LONG)
        os.kill(children_of(process.pid)[0], signal.SIGSEGV)
        _, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, FAILED)
        self.assertIn("crashed (Segmentation fault)", stderr)
        self.assertEqual(sorted(point["status"] for point in self.points()),
                         ["done", "done", "failed"])
        self.sweep_to_end(LONG, "out", "--retry-failed")
        self.assertEqual(sorted(point["attempts"] for point in self.points()), [1, 1, 2])

    def test_no_two_sweeps_in_one_directory(self):
        process = self.start_sweep(ENDLESS)
        second = self.sweep(ENDLESS)
        self.assert_refused(second, "out", "in use", str(process.pid))
        status = self.riesel("status", "out")
        self.assertIn("3 points: 2 running, 1 waiting", status.stdout)
        self.assertEqual(self.stop(process, signal.SIGTERM), 143)
        self.assertIn("2 interrupted, 1 waiting", self.riesel("status", "out").stdout)

    def test_a_sweep_that_lost_its_lock_ends_and_can_be_gone_on_with(self):
        process = self.start_sweep(LONG)
        (self.home / "out/.lock").unlink()
        _, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, FAILED, stderr)
        self.assertIn("out/.lock: has been removed or replaced", stderr)
        self.assert_goes_on_as_uninterrupted(LONG)

    def test_a_point_that_another_process_runs_is_left_to_it(self):
        self.write("sweep.yaml", LONG)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out", "--prepare"))
        task = self.start("sweep-task", "out", 0, "--threads", 1)
        self.wait_until(lambda: list(self.home.glob("out/points/*/checkpoint.h5")), "the start")
        self.sweep_to_end(LONG)
        task.communicate(timeout=PATIENCE)
        self.assertEqual(task.returncode, DONE)
        self.assertEqual({point["attempts"] for point in self.points()}, {1})

    def test_a_sweep_that_ends_stops_all_its_runs_at_once(self):
        """Also if one of them takes its time."""
        process = self.start_sweep(ENDLESS)
        names = [point["name"] for point in self.points()]
        slow, other = sorted(children_of(process.pid), key=lambda child: next(
            i for i, name in enumerate(names) if name in pathlib.Path(f"/proc/{child}/cmdline").read_text("ascii")))
        os.kill(slow, signal.SIGSTOP)
        try:
            (self.home / "out/.lock").unlink()
            self.wait_until(lambda: not is_alive(other), "the end of the other run")
        finally:
            os.kill(slow, signal.SIGCONT)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, FAILED)

    def test_a_sweep_that_has_begun_is_not_put_aside_by_another(self):
        process = self.start_sweep(ENDLESS)
        self.assertEqual(self.stop(process, signal.SIGTERM), 143)
        plan = [(self.home / "out" / name).read_bytes() for name in ("sweep.yaml", "manifest.json")]
        other = ENDLESS.replace("[0.7, 0.8, 0.9]", "[0.6]")
        for options in ([], ["--dry-run"], ["--prepare"]):
            self.assert_refused(self.sweep(other, "out", *options), "holds another sweep", "--out")
        self.assertEqual([(self.home / "out" / name).read_bytes() for name in ("sweep.yaml", "manifest.json")], plan)

    @contextlib.contextmanager
    def point_of_short_runs_locked(self, how):
        """The directory of one of three points that are done, while its lock is held."""
        self.sweep_to_end(LONG.replace("1500 ms", "2 ms"))
        point = sorted(self.home.glob("out/points/*"))[0]
        with open(point / ".lock", "rb") as lock:
            fcntl.flock(lock, how)
            yield point

    def test_a_point_in_use_for_a_moment_is_no_failure(self):
        """A shared lock, which stands in the way of a run although nobody seems to work on it, is as one that
        is taken between the look of the sweep and the start of the run."""
        with self.point_of_short_runs_locked(fcntl.LOCK_SH) as point:
            log = point / "log.txt"
            process = self.start("sweep", "out", "--jobs", 1, "--set", "run.duration=4 ms")
            self.wait_until(lambda: "is in use by" in log.read_text("utf-8"), "the collision")
        _, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual((process.returncode, {row["status"] for row in self.rows()}), (DONE, {"done"}), stderr)

    def test_a_point_that_another_process_goes_on_with_is_waited_for(self):
        """Its earlier result is still there. It is not started in vain, and has not failed."""
        with self.point_of_short_runs_locked(fcntl.LOCK_EX):
            process = self.start("sweep", "out", "--set", "run.duration=4 ms")
            time.sleep(4.0)  # longer than any number of attempts would take
            self.assertIsNone(process.poll())
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, DONE)
        self.assertEqual({row["attempts"] for row in self.rows()}, {"2"})

    def test_a_point_in_use_for_ever_has_failed(self):
        with self.point_of_short_runs_locked(fcntl.LOCK_SH):
            result = self.riesel("sweep", "out", "--set", "run.duration=4 ms")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("2 done, 1 failed", result.stdout)
        self.assertIn("is in use by", result.stdout)
