"""What all tests of the command share: calling it in a directory of its own, and reading what it
leaves there. The command is the one that the environment variable RIESEL names."""

import functools
import itertools
import json
import math
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import time
import unittest
from decimal import Decimal

import h5py

COMMAND = os.path.abspath(os.environ["RIESEL"])
PATIENCE = 200.0  # s: what takes longer hangs, on the slowest machine and the busiest
SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "scenarios"

# About 40 grains in a square of 10 mm: a millisecond is 1054 steps.
SMALL_TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
grains: {area_fraction: 0.3}
tube: {width: 10 mm, length: 10 mm}
start: {random_velocity: 2 m/s}
run: {duration: 5 ms}
"""

# Of one grain, which is over at once.
IMPACT = """\
scenario: single_wall_grain
contact: {stiffness: 2000 N/m, restitution: 0.9}
impact: {axial_velocity: [1 m/s]}
"""

DONE, FAILED, BAD_INPUT, OUT_OF_TIME = 0, 1, 2, 3
# A line of it comes every ten seconds: never here, but on a busy machine.
PROGRESS = re.compile(r" *[0-9.]+ %  .*  [-0-9:]+ left|.*: goes on from t = \S+ s, step \d+ of \d+")


def bytes_of_files(directory):
    """{path: content} of all files below."""
    return {str(path.relative_to(directory)): path.read_bytes()
            for path in pathlib.Path(directory).rglob("*") if path.is_file()}


def data_of(run_directory, part="/"):
    """{name: (type, shape, bytes)} of all data sets of run.h5 below `part`, but the provenance."""
    data = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset) and not item.name.startswith("/provenance"):
            data[item.name] = (str(item.dtype), item.shape, item[()].tobytes())

    with h5py.File(run_directory / "run.h5", "r") as file:
        file[part].visititems(add)
    return data


def series_of(run_directory):
    """{name: values} of the time series."""
    with h5py.File(run_directory / "run.h5", "r") as file:
        return {name: column[()] for name, column in file["series"].items()}


def saved_step(run_directory):
    """Up to which a run is in its last checkpoint."""
    with h5py.File(run_directory / "checkpoint.h5", "r") as file:
        return file.attrs["step"].item()


def with_error(mean):
    """"1.534 ± 0.050", of a value and its error: two digits of the error, and the value as far."""
    decimals = max(0, 1 - Decimal(f"{mean['error']:.1e}").adjusted())
    return f"{mean['value']:.{decimals}f} ± {mean['error']:.{decimals}f}"


def final_time(run_directory):
    """s, of the state that run.h5 holds."""
    with h5py.File(run_directory / "run.h5", "r") as file:
        return float(file["final"].attrs["time"])


def numbers_in(value):
    """All numbers of a value read from JSON."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for part in value for number in numbers_in(part)]
    return [value] if isinstance(value, (int, float)) else []


class CommandTest(unittest.TestCase):
    """Each test has an empty directory, self.home, in which the command runs."""

    maxDiff = None

    def setUp(self):
        self.move_to_an_empty_home()

    @classmethod
    def maker(cls):
        """For setUpClass: makes, in a home of its own, what all tests of the class only look at."""
        maker = cls()
        maker.setUp()
        cls.addClassCleanup(maker.doCleanups)
        return maker

    def move_to_an_empty_home(self):
        directory = tempfile.TemporaryDirectory(prefix="riesel-test-")
        self.addCleanup(directory.cleanup)
        self.home = pathlib.Path(directory.name)

    # --- calling the command ---

    def riesel(self, *arguments, **environment):
        """Runs the command to its end."""
        return subprocess.run([COMMAND, *map(str, arguments)], cwd=self.home, timeout=PATIENCE,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", env={**os.environ, **environment}, check=False)

    def riesel_with_files_of_at_most(self, size, *arguments):
        """The same where no file may have more bytes: its disk is full, as it were."""
        limit = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (size, size))
        return subprocess.run([COMMAND, *map(str, arguments)], cwd=self.home, timeout=PATIENCE,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, preexec_fn=limit)

    def start(self, *arguments, **streams):
        """Starts the command, which ends with the test at the latest."""
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, **streams}
        process = subprocess.Popen([COMMAND, *map(str, arguments)], cwd=self.home,
                                   stdin=subprocess.DEVNULL, **streams)
        self.addCleanup(self._end, process)
        return process

    def wait_until(self, happened, what):
        """Looks again and again; that `what` never happens is a failure."""
        deadline = time.monotonic() + PATIENCE
        while not happened():
            self.assertLess(time.monotonic(), deadline, f"{what} has not happened")
            time.sleep(0.002)

    @staticmethod
    def _end(process):
        process.kill()
        process.communicate()

    def subcommands(self):
        """Their names, as the command lists them."""
        result = self.riesel("--help")
        self.assert_done(result)
        return re.findall(r"^  ([a-z-]+) ", result.stdout.split("Subcommands:")[1], re.MULTILINE)

    def write(self, name, text):
        path = self.home / name
        path.write_text(text, encoding="utf-8")
        return path

    def run_to_end(self, settings, out, *options, threads=1):
        """Runs a settings file, which must succeed. Returns the directory of the run."""
        result = self.riesel("run", settings, "--out", out, "--threads", threads, *options)
        self.assert_done(result)
        return self.home / out

    def run_small_tube(self, out, *options, threads=1):
        return self.run_to_end(self.write("tube.yaml", SMALL_TUBE), out, *options, threads=threads)

    def resume_to_end(self, directory, *options):
        result = self.riesel("resume", directory, *options)
        self.assert_done(result)
        return result

    # --- what it left ---

    def summary(self, run_directory):
        return json.loads((run_directory / "summary.json").read_text(encoding="utf-8"))

    def state_hash(self, run_directory):
        state_hash = self.summary(run_directory)["state_hash"]
        self.assertRegex(state_hash, r"\A[0-9a-f]{16}\Z")
        return state_hash

    # --- promises ---

    def assert_done(self, result):
        complaints = [line for line in result.stderr.splitlines() if not PROGRESS.fullmatch(line)]
        self.assertEqual((result.returncode, complaints), (DONE, []), result)

    def assert_refused(self, result, *mentions):
        """Bad input: exit status 2, and one message, which mentions all of that."""
        self.assertEqual(result.returncode, BAD_INPUT, result)
        self.assertEqual(result.stdout, "")
        self.assert_one_message(result.stderr, *mentions)

    def assert_sweep_refuses(self, *options):
        """Options of `riesel sweep` that cannot stand beside each other: nothing is done."""
        with self.subTest(options):
            result = self.riesel("sweep", "sweep.yaml", *itertools.chain(*options))
            self.assertEqual((result.returncode, result.stdout), (BAD_INPUT, ""), result)
            for option, *_ in options:
                self.assertIn(option, result.stderr)
            self.assertFalse((self.home / "sweeps").exists())

    def assert_failed(self, result, *mentions):
        self.assertEqual(result.returncode, FAILED, result)
        self.assertEqual(result.stdout, "")
        self.assert_one_message(result.stderr, *mentions)

    def assert_one_message(self, text, *mentions):
        """Says who speaks, what is wrong, and, after a semicolon, what to do about it."""
        text = "".join(line for line in text.splitlines(keepends=True)
                       if not PROGRESS.fullmatch(line.rstrip("\n")))
        self.assertRegex(text, r"\Ariesel: [^\n]+; [^\n]+\n\Z")
        for mention in mentions:
            self.assertIn(mention, text)
        self.assertNotRegex(text, r"std::|what\(\)|0x[0-9a-f]{6}|terminate")

    def assert_nothing_written(self, before):
        """`before`: bytes_of_files(self.home) of then. Directories do not appear either."""
        after = bytes_of_files(self.home)
        self.assertEqual(sorted(after), sorted(before))
        self.assertEqual(after, before)
        self.assertEqual([path for path in self.home.rglob("*") if path.is_dir()], [])

    def assert_same_result(self, one, other):
        """The same state, bit by bit, the same series, and the same summary but for the speed."""
        self.assertEqual(self.state_hash(one), self.state_hash(other))
        first, second = data_of(one), data_of(other)
        self.assertEqual(sorted(first), sorted(second))
        for name, data in first.items():
            self.assertEqual(data, second[name], name)
        summaries = [self.summary(one), self.summary(other)]
        for summary in summaries:
            del summary["performance"]
        self.assertEqual(*summaries)

    def assert_finite(self, summary):
        for number in numbers_in(summary):
            self.assertTrue(math.isfinite(number), summary)


def plain_number(text, pattern):
    """The number that the first group of `pattern` finds in the text."""
    found = re.search(pattern, text)
    if found is None:
        raise AssertionError(f"no {pattern!r} in:\n{text}")
    return float(found.group(1))
