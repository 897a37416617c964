"""What the soak would complain of: leaks, steps that get dearer and lost work, in looks that are made up. It runs for an
hour by hand only (docs/reliability.md)."""

import argparse
import contextlib
import io
import os
import pathlib
import random
import tempfile
import time
import unittest

import h5py
import numpy as np

import soak

HOURS = 1.0
TIME_STEP = 1e-6
# Of the lives of an hour: short ones, the long one, short ones.
LIVES = [300, 40, 560, 1800, 400, 200, 300]  # s


def yardsticks(busier=0.0):
    """Two a minute, in us per step: `busier` in parts per minute of the hour."""
    dice = random.Random(2)
    return [soak.Yardstick(minute / 60, 70.0 * (1.0 + busier * minute) * dice.gauss(1.0, 0.05))
            for minute in np.arange(0.0, 61.0, 0.5)]


def looks(leak=0.0, dearer=0.0, busier=0.0):
    """One every three seconds, at a checkpoint: `leak` in MB per minute of a life, `dearer` in parts per minute."""
    dice, made, now, step, rows = random.Random(1), [], 0.0, 0, 200
    for life, seconds in enumerate(LIVES, 1):
        processor = 0.0
        for age in range(3, seconds, 3):
            cost = 80.0 * (1.0 + dearer * age / 60) * (1.0 + busier * (now + age) / 60) * dice.gauss(1.0, 0.05)  # us
            processor += 1e-6 * cost * 40_000
            step, rows = step + 40_000, rows + 1
            memory = 38.0 + dice.uniform(0.0, 4.0) + leak * age / 60
            made.append(soak.Look(life, (now + age) / 3600, age, memory, processor, step, rows, True))
        now += seconds
    return made


class Judgements(unittest.TestCase):

    def complaints(self, made, taken=None):
        soaked = soak.Soak(pathlib.Path("nowhere"), 2, 1)
        soaked.looks, soaked.yardsticks = made, taken or yardsticks()
        soaked.long_life = 1 + LIVES.index(max(LIVES))
        with contextlib.redirect_stdout(io.StringIO()):
            soaked.judge_all(HOURS)
        return soaked.complaints

    def test_nothing_is_wrong(self):
        self.assertEqual(self.complaints(looks()), [])

    def test_a_leak_of_a_third_of_a_megabyte_per_minute(self):
        self.assertIn("memory grew over the long life", self.complaints(looks(leak=0.3)))

    def test_steps_that_get_dearer_by_a_hundredth_per_minute(self):
        self.assertTrue(any("dearer over the long life" in c for c in self.complaints(looks(dearer=0.01))))

    def test_a_machine_that_gets_busier_is_not_taken_for_steps_that_get_dearer(self):
        self.assertEqual(self.complaints(looks(busier=0.01), yardsticks(busier=0.01)), [])
        self.assertNotEqual(self.complaints(looks(busier=0.01)), [])


class LostWork(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)
        self.soak = soak.Soak(self.out, 2, 1)

    def write(self, step, rows, written=None):
        with h5py.File(self.out / "checkpoint.h5", "w") as file:
            file.attrs.update({"step": step, "rows": rows, "time_step": TIME_STEP})
        with h5py.File(self.out / "run.h5", "w") as file:
            file["series/time"] = np.arange(rows if written is None else written) * 1000 * TIME_STEP
        self.soak.look_at_rows()

    def test_work_that_goes_on(self):
        self.write(1000, 2)
        self.write(5000, 6, written=7)
        self.assertEqual(self.soak.complaints, [])

    def test_an_older_checkpoint(self):
        self.write(5000, 6)
        self.write(1000, 2)
        self.assertEqual(len(self.soak.complaints), 2)

    def test_an_older_checkpoint_while_a_life_goes_on(self):
        self.write(5000, 6)
        self.soak.saved = {"step": 9000, "rows": 6, "time_step": TIME_STEP}
        self.soak.look(argparse.Namespace(pid=os.getpid()), time.monotonic())
        self.assertEqual(len(self.soak.complaints), 1)

    def test_no_checkpoint(self):
        self.write(5000, 6)
        (self.out / "checkpoint.h5").unlink()
        self.soak.look_at_rows()
        self.assertEqual(len(self.soak.complaints), 1)
        self.soak.yardsticks = yardsticks()
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            self.soak.report(HOURS)
        self.assertIn("the checkpoint of step 5000 is gone", told.getvalue())

    def test_rows_that_are_missing(self):
        self.write(5000, 6, written=5)
        self.assertEqual(len(self.soak.complaints), 1)


if __name__ == "__main__":
    unittest.main()
