"""goals.py on results whose ratios are known by heart, and the tables of the manual that it has made."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(__file__).resolve().parents[1]
ROOT = BENCH.parent


def goals(*arguments):
    return subprocess.run([sys.executable, "-B", BENCH / "goals.py", *map(str, arguments)], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def row(case, size, variant, seconds, **more):
    """Of some repetitions that took so long for the same work."""
    return {"case": case, "size": size, "variant": variant, "work": 100.0,
            "seconds": {"median": sorted(seconds)[len(seconds) // 2], "min": min(seconds), "all": seconds},
            "per_second": {"median": 100.0 / sorted(seconds)[len(seconds) // 2]}} | more


ORIGIN = {"machine": {"name": "this"}, "build": {"changed": False}}


def suite(*rows, date="2026-01-02T00:00:00Z", **more):
    return {"format": "riesel benchmark", "format_version": 1, "date": date, "rows": rows} | ORIGIN | more


def beside_lammps(*rows):
    return {"format": "riesel peers", "format_version": 1, "date": "2026-01-02T00:00:00Z", "cases": [{"rows": rows}]} | ORIGIN


class Goals(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def table(self, *results, arguments=()):
        """{(goal, state): cells by size} of these results."""
        files = []
        for number, one in enumerate(results):
            files.append(self.folder / f"{number}.json")
            files[-1].write_text(json.dumps(one), encoding="utf-8")
        done = goals(*arguments, *files)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()[4:]]
        found, name = {}, ""
        for goal, state, *cells in lines:
            name = goal or name
            found[name, state] = cells
        return found

    def test_the_median_over_results_and_their_range(self):
        def one(windows):
            return suite(row("tube_slow", "1.4k", "plain 1", [2.0, 2.0, 3.0]),
                         row("tube_slow", "1.4k", "windows 1", [windows, windows, 1.5 * windows]))
        # 4, 2.5 and 2 times plain stepping; the goal is 3
        found = self.table(one(0.5), one(0.8), one(1.0))
        self.assertEqual(found, {("windows 3 times plain", "slow tube"): ["2.50 (2.00 to 4.00), 1 of 3", "", "", ""]})

    def test_what_each_result_reaches_is_bold(self):
        def one(slow, ranks):
            return beside_lammps(row("tube_stiff", "10k", "riesel windows 1", [1.0]), row("tube_stiff", "10k", "lammps 1", [slow]),
                                 row("tube_stiff", "10k", "riesel plain 2", [1.0]), row("tube_stiff", "10k", "lammps 2", [ranks]))
        found = self.table(one(60.0, 2.0), one(70.0, 2.9))
        self.assertEqual(found, {("windows 60 times LAMMPS, one core", "stiff tube"): ["", "**65.0 (60.0 to 70.0)**", "", ""],
                                 ("plain 3 times LAMMPS, two cores", "stiff tube"): ["", "2.5 (2.0 to 2.9)", "", ""]})

    def test_limits_from_above(self):
        found = self.table(suite(row("start_up", "1M", "threads 1", [3.1])))
        self.assertEqual(found["start-up in 3 s at most", "start-up"], ["", "", "", "3.1"])
        found = self.table(suite(row("tube_slow", "1.4k", "plain 1", [1.0]), row("tube_slow", "1M", "plain 1", [2.4],
                                 bytes_per_grain=251.0, bandwidth_share=0.7, bytes_per_particle_step=60.0,
                                     grains=2, threads=1),
                                 bandwidth=[{"threads": 1, "working_set": 100, "bytes_per_second": 9999.0},
                                            {"threads": 1, "working_set": 120, "bytes_per_second": 3571.0},
                                            {"threads": 1, "working_set": 900, "bytes_per_second": 4166.0},
                                            {"threads": 2, "working_set": 900, "bytes_per_second": 9999.0}]))
        self.assertEqual(found["cost 2.5 times that of 1.4 k at most, plain", "slow tube"], ["", "", "", "**2.40**"])
        self.assertEqual(found["250 bytes per grain at most, plain", "slow tube"], ["", "", "", "251"])
        self.assertEqual(found["plain takes 60 % of the bandwidth, one thread", "slow tube"], ["", "", "", "**60**"])

    def test_auto_is_beside_the_faster_way_of_one_thread(self):
        rows = [row("tube_fast", "10k", variant, [seconds])
                for variant, seconds in (("plain 1", 1.0), ("windows 1", 0.5), ("automatic", 0.6), ("plain 2", 0.55))]
        found = self.table(suite(*rows))
        self.assertEqual(found["`auto` 0.95 times the better way on one thread", "fast tube"], ["", "0.83", "", ""])
        self.assertEqual(found["two threads 1.8 (1.4 k) and 1.9 times one, plain", "fast tube"], ["", "1.82", "", ""])

    def test_what_the_machine_has_for_two_runs(self):
        rows = [row("tube_slow", "10k", "plain 1", [1.0, 1.0]), row("tube_slow", "10k", "plain 2", [0.6, 0.6]),
                row("tube_slow", "10k", "plain 2 runs", [1.0, 1.05]) | {"work": 2 * row("", "", "", [1.0])["work"]}]
        found = self.table(suite(*rows))
        self.assertEqual(found["two threads 1.8 (1.4 k) and 1.9 times one, plain", "slow tube"], ["", "1.67", "", ""])
        self.assertEqual(found["the same of two runs side by side, plain", "slow tube"], ["", "**1.95**", "", ""])

    def test_only_results_of_that_date_or_younger(self):
        old = suite(row("start_up", "1M", "threads 1", [9.0]), date="2025-12-31T23:59:59Z")
        young = suite(row("start_up", "1M", "threads 1", [2.0]))
        found = self.table(old, young, arguments=["--since", "2026-01"])
        self.assertEqual(found["start-up in 3 s at most", "start-up"], ["", "", "", "**2.0**"])

    def test_what_does_not_count(self):
        good, bad = row("start_up", "1M", "threads 1", [2.0]), row("start_up", "1M", "threads 1", [9.0])
        found = self.table(suite(good), suite(bad, quick=True), suite(bad, build={"changed": True}),
                           suite(bad, disagreements=["plain 1 and windows 1 differ"]))
        self.assertEqual(found["start-up in 3 s at most", "start-up"], ["", "", "", "**2.0**"])

    def test_other_motion_than_lammps_does_not_count(self):
        def one(seconds, **more):
            results = beside_lammps(row("tube_slow", "10k", "riesel plain 1", [1.0]), row("tube_slow", "10k", "lammps 1", [seconds]))
            results["cases"][0] |= more
            return results
        for more in ({"agreements": {"lammps 1": {"agree": True}, "lammps 2": {"agree": False}}}, {"agreement": {"agree": False}}):
            found = self.table(one(5.0), one(50.0, **more))
            self.assertEqual(found["plain 3 times LAMMPS, one core", "slow tube"], ["", "**5.0**", "", ""])

    def test_tables_beside_other_codes_leave_the_same_out(self):
        results = beside_lammps()
        results["cases"] = [{"case": "tube_slow", "size": "10k", "grains": 10, "agreement": {"agree": False},
                             "rows": [row("tube_slow", "10k", variant, [1.0])
                                      for variant in ("lammps 1", "riesel plain 1", "riesel windows 1")]}]
        file = self.folder / "peers.json"
        for agree in (False, True):
            results["cases"][0]["agreement"]["agree"] = agree
            file.write_text(json.dumps(results), encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", BENCH / "peers" / "table.py", file], check=True, text=True,
                                  capture_output=True)
            self.assertEqual((f"{file}: left out" in done.stderr, "| slow tube |" in done.stdout), (not agree, agree))

    def test_what_was_not_finished_is_told(self):
        file = self.folder / "peers.json"
        file.write_text(json.dumps(beside_lammps() | {"complete": False}), encoding="utf-8")
        done = goals(file)
        self.assertIn(f"{file}: was not finished", done.stderr)
        self.assertIn("0 beside LAMMPS", done.stdout)

    def test_each_machine_has_a_table(self):
        files = []
        for name, seconds in (("here", 2.0), ("there", 9.0)):
            files.append(self.folder / f"{name}.json")
            one = suite(row("start_up", "1M", "threads 1", [seconds]), machine={"name": name})
            files[-1].write_text(json.dumps(one), encoding="utf-8")
        blocks = goals(*files).stdout.split("\n\n")
        self.assertEqual([block.split(":")[0] for block in blocks[::2]], ["here", "there"])
        self.assertEqual(["**2.0**" in block for block in blocks[1::2]], [True, False])

    def test_files_that_are_no_results(self):
        other = self.folder / "other.json"
        other.write_text("{}", encoding="utf-8")
        done = goals(other)
        self.assertEqual(done.returncode, 2)
        self.assertIn("other.json: is no result of the benchmark suite nor beside other codes", done.stderr)


class Manual(unittest.TestCase):

    def test_tables_are_what_the_command_above_them_prints(self):
        tables = 0
        for page in sorted((ROOT / "docs").glob("*.md")):
            blocks = page.read_text(encoding="utf-8").split("\n\n")
            for command, text in zip(blocks, blocks[1:]):
                if command.startswith(("    bench/goals.py ", "    bench/peers/table.py ")) and text.startswith("|"):
                    done = subprocess.run(command, shell=True, check=True, text=True, cwd=ROOT, stdout=subprocess.PIPE)
                    self.assertEqual(text.strip(), done.stdout.split("\n\n")[-1].strip(), page.name)
                    tables += 1
        self.assertEqual(tables, 6)  # goals on four machines; other codes on one core and on two


if __name__ == "__main__":
    unittest.main()
