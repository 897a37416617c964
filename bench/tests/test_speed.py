"""The suite's program: what its results hold, and what it says to a wrong command line. Nothing here depends on how fast
anything is. The program is the one that the environment variable SPEED names."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

SPEED = os.path.abspath(os.environ["SPEED"])
TUBE = pathlib.Path(__file__).resolve().parents[2] / "scenarios/periodic_tube.yaml"

TOP = {"format", "format_version", "date", "quick", "part", "machine", "build", "bandwidth", "hashes_agree", "disagreements",
       "rows"}
MACHINE = {"name", "cpu", "cores", "caches", "memory", "load_average"}
BUILD = {"version", "commit", "changed", "compiler", "flags", "build_type"}
ROW = {"case", "size", "variant", "grains", "threads", "unit", "work", "seconds", "per_second", "contacts_per_grain",
       "ns_per_contact", "bytes_per_grain", "peak_bytes_per_grain", "bytes_per_particle_step", "bandwidth_share",
       "steps_before", "state_hash"}


def speed(*arguments, cwd=None):
    return subprocess.run([SPEED, *map(str, arguments)], check=False, cwd=cwd, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE)


class Suite(unittest.TestCase):
    """One run of the suite, of its smallest cases, looked at from several sides."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        (folder / "states/sweep").mkdir(parents=True)  # as somebody may have one
        (folder / "states/sweep/notes").touch()
        cls.done = speed("--quick", "--case", "single_wall_grain", "--case", "tube_start", "--case", "checkpoint",
                         "--case", "start_up", "--case", "ensemble", "--size", "1.4k", "--states", folder / "states", "--out",
                         folder / "results.json")
        if cls.done.returncode != 0:
            raise AssertionError(cls.done.stderr)
        cls.results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
        cls.rows = {(row["case"], row["variant"]): row for row in cls.results["rows"]}
        cls.states = sorted(path.name for path in (folder / "states").iterdir())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_all_keys_are_there(self):
        self.assertEqual(set(self.results), TOP)
        self.assertEqual(set(self.results["machine"]), MACHINE)
        self.assertEqual(set(self.results["build"]), BUILD)
        for row in self.results["rows"]:
            self.assertEqual(set(row), ROW)

    def test_all_variants_are_there(self):
        flow = [variant for case, variant in self.rows if case == "tube_start"]
        self.assertEqual(flow, ["scalar", "plain 1", "plain 2", "plain 2 apart", "plain 2 runs", "windows 1", "windows 2", "windows 2 apart",
                                "windows 2 runs", "automatic"])
        self.assertEqual({case for case, _ in self.rows}, {"single_wall_grain", "tube_start", "checkpoint", "start_up",
                                                        "ensemble"})

    def test_the_same_bits_whatever_the_stepping(self):
        self.assertTrue(self.results["hashes_agree"])
        hashes = {row["state_hash"] for (case, _), row in self.rows.items() if case == "tube_start"} - {None}
        self.assertEqual(len(hashes), 1)

    def test_two_runs_side_by_side_do_twice_the_work(self):
        for stepping in ("plain", "windows"):
            one, two = self.rows["tube_start", f"{stepping} 1"], self.rows["tube_start", f"{stepping} 2 runs"]
            self.assertEqual((two["threads"], two["work"]), (2, 2 * one["work"]))

    def test_runs_of_an_ensemble_do_not_depend_on_what_runs_beside_them(self):
        one, two = self.rows["ensemble", "jobs 1"], self.rows["ensemble", "jobs 2"]
        self.assertEqual(one["state_hash"], two["state_hash"])
        self.assertEqual(one["work"], two["work"])
        # Six tubes of some 1,400 grains, 0.05 s of 0.944 microseconds.
        self.assertAlmostEqual(one["grains"] / (6 * 1400), 1.0, delta=0.05)
        self.assertAlmostEqual(one["work"] / 4.44e8, 1.0, delta=0.05)

    def test_numbers_follow_from_the_repetitions(self):
        for row in self.results["rows"]:
            seconds = row["seconds"]
            self.assertEqual(len(seconds["all"]), 3)
            self.assertEqual(seconds["median"], sorted(seconds["all"])[1])
            self.assertEqual(seconds["min"], min(seconds["all"]))
            self.assertAlmostEqual(row["per_second"]["median"] * seconds["median"] / row["work"], 1.0)
            self.assertAlmostEqual(row["per_second"]["max"] * seconds["min"] / row["work"], 1.0)

    def test_contacts_are_counted(self):
        row = self.rows["tube_start", "windows 1"]
        steps = row["work"] / row["grains"]
        per_contact = 1e9 * row["seconds"]["median"] / steps / (row["contacts_per_grain"] * row["grains"])
        self.assertAlmostEqual(row["ns_per_contact"] / per_contact, 1.0)

    def test_bandwidth_of_one_and_two_threads(self):
        self.assertEqual([b["threads"] for b in self.results["bandwidth"]], [1, 2])
        for b in self.results["bandwidth"]:
            # The arrays a, b and c; a is read before it is written.
            self.assertAlmostEqual(b["bytes_per_second"] * b["seconds"]["min"], b["working_set"] * 4 / 3, delta=64)

    def test_states_are_kept_and_nothing_else(self):
        self.assertEqual(len(self.states), 2)
        self.assertEqual(self.states[0], "sweep")  # that was there before
        self.assertTrue((pathlib.Path(self.folder.name) / "states/sweep/notes").exists())
        self.assertRegex(self.states[1], r"^tube_start-1\.4k-[0-9a-f]{16}\.h5$")

    def test_results_of_some_cases_say_so(self):
        self.assertTrue(self.results["part"])


@unittest.skipUnless("SIMD" in os.environ, "not built here")
class LibrariesOfVectorTypes(unittest.TestCase):

    def test_all_come_to_the_bits_of_the_engine(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [os.path.abspath(os.environ["RIESEL"]), "run", TUBE, "--set", "run.duration=20 ms", "--out", "tube"]
            subprocess.run(command, check=True, cwd=folder, capture_output=True)
            done = subprocess.run([os.environ["SIMD"], f"{folder}/tube/checkpoint.h5"], check=False, text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("std::experimental::simd", done.stdout)


class Subcommands(unittest.TestCase):
    """What the comparison with other codes calls, and what tells how long threads wait."""

    def test_what_waiting_takes(self):
        done = speed("barrier", "--threads", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        took = json.loads(done.stdout)["ns_per_barrier"]
        self.assertTrue(0 < took["least"] <= took["median"] <= took["most"])

    def test_a_state_is_made_once_and_stepped_to_the_same_bits(self):
        with tempfile.TemporaryDirectory() as folder:
            def state():
                return json.loads(speed("--states", folder, "state", "tube_start", "1.4k", "--set", "contact.slip=viscous",
                                        "--set", "contact.slip_damping=2e5").stdout)

            first = state()
            made = pathlib.Path(first["checkpoint"]).stat().st_mtime_ns
            self.assertEqual(state(), first)
            self.assertEqual(pathlib.Path(first["checkpoint"]).stat().st_mtime_ns, made)
            self.assertEqual(first["gamma_t"], 2e5)
            self.assertEqual(first["k_n"], 2000)

            hashes = set()
            for stepping, threads in (("plain", 1), ("plain", 2), ("windows", 1)):
                answer = json.loads(speed("advance", first["checkpoint"], "--stepping", stepping, "--threads", threads,
                                          "--warm-up", 30, "--steps", 70).stdout)
                self.assertEqual(answer["steps"], 70)
                hashes.add(answer["state"]["state_hash"])
            self.assertEqual(len(hashes), 1)
            self.assertNotEqual(hashes, {first["state"]["state_hash"]})


    def test_a_kept_state_that_cannot_be_read_is_made_anew(self):
        with tempfile.TemporaryDirectory() as folder:
            def state():
                return speed("--states", folder, "state", "tube_start", "1.4k")

            first = state()
            kept = pathlib.Path(json.loads(first.stdout)["checkpoint"])
            content = kept.read_bytes()
            kept.write_bytes(content[:-1000])
            second = state()
            self.assertEqual(second.returncode, 0, second.stderr)
            self.assertIn("made anew", second.stderr)
            self.assertNotIn("made anew", first.stderr)
            self.assertEqual(kept.read_bytes(), content)
            self.assertEqual(os.listdir(folder), [kept.name])


class Mistakes(unittest.TestCase):

    def check(self, status, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            done = speed("--states", "states", *arguments, cwd=folder)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertNotEqual(done.stderr, "")
            self.assertEqual(os.listdir(folder), [])

    def test_unknown_names(self):
        self.check(2, "--case", "no_such_case")
        self.check(2, "--size", "2k")
        self.check(2, "state", "tube_start", "2k")
        self.check(2, "state", "single_wall_grain", "1.4k")
        self.check(2, "advance", "nothing.h5", "--stepping", "backwards")
        self.check(2, "advance", "nothing.h5", "--warm-up", "-5")

    def test_settings_that_there_are_not(self):
        self.check(2, "state", "tube_start", "1.4k", "--set", "nonsense=1")

    def test_a_size_that_the_case_does_not_have(self):
        self.check(2, "--case", "tube_stiff", "--size", "1M")

    def test_a_place_that_cannot_be_written(self):
        for out in ("/dev/null/results.json", "."):
            self.check(2, "--case", "tube_start", "--size", "1.4k", "--out", out)

    def test_a_checkpoint_that_is_not_there(self):
        self.check(1, "advance", "nothing.h5")


if __name__ == "__main__":
    unittest.main()
