"""compare.py on two small results whose ratios are known by heart: B is a copy of A in which windows take half the time."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
A, B = HERE / "small_a.json", HERE / "small_b.json"


def compare(*arguments):
    return subprocess.run([sys.executable, "-B", HERE.parent / "compare.py", *map(str, arguments)], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def lines_of(text, *words):
    return [" ".join(line.split()) for line in text.splitlines() if all(word in line for word in words)]


class Compare(unittest.TestCase):

    def test_ratios_within_one_result(self):
        done = compare(A)
        self.assertEqual(done.returncode, 0, done.stderr)
        # plain: 0.5, 0.4, 0.5 s, scalar: 1.0, 1.2, 1.0 s; windows: 0.2, 0.2, 0.1 s: repetition by repetition
        self.assertEqual(lines_of(done.stdout, "plain / scalar"), ["tube 1.4k plain / scalar 2.00 [2.00 3.00]"])
        self.assertEqual(lines_of(done.stdout, "windows / plain"), ["tube 1.4k windows / plain 2.50 [2.00 5.00]"])
        self.assertEqual(lines_of(done.stdout, "2 threads / 1"), [])  # not measured
        self.assertIn("tube 1.4k plain 1: 100 bytes per particle-step if each step went through all grains, "
                      "50 % of the bandwidth", done.stdout)

    def test_one_result_against_the_other(self):
        done = compare(A, B)
        self.assertEqual(done.returncode, 0, done.stderr)
        between = done.stdout[done.stdout.index("B against A"):]
        self.assertEqual(lines_of(between, "windows 1"), ["tube 1.4k windows 1 2.00 [1.00 4.00]"])
        self.assertEqual(lines_of(between, "scalar"), ["tube 1.4k scalar 1.00 [0.83 1.20]"])
        self.assertEqual(lines_of(between, "plain 1"), ["tube 1.4k plain 1 1.00 [0.80 1.25] other bits"])
        self.assertEqual(lines_of(between, "only in B"), ["start_up 1M threads 1 only in B"])

    def test_hashes_that_do_not_agree_are_told(self):
        self.assertNotIn("NOT THE SAME BITS", compare(A).stdout)
        self.assertIn("NOT THE SAME BITS: tube 1.4k: plain 1 and windows 1 differ", compare(B).stdout)

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            for ending, begin in (("svg", b"<?xml"), ("png", b"\x89PNG")):
                done = compare(A, B, "--plots", folder, "--format", ending)
                self.assertEqual(done.returncode, 0, done.stderr)
                for name in ("speed", "ratios"):
                    self.assertTrue((pathlib.Path(folder) / f"{name}.{ending}").read_bytes().startswith(begin))

    def test_files_that_are_no_results(self):
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder) / "other.json"
            for content in ("", "[]", "{}", '{"format": "riesel benchmark", "format_version": 99}',
                            '{"format": "riesel benchmark"}', '{"format": "riesel benchmark", "format_version": 1}',
                            '{"format": "riesel benchmark", "format_version": 1, "rows": [{"case": "tube"}]}'):
                other.write_text(content, encoding="utf-8")
                done = compare(other)
                self.assertEqual(done.returncode, 2)
                self.assertIn("other.json", done.stderr)
                self.assertNotIn("Traceback", done.stderr)
            self.assertEqual(compare(pathlib.Path(folder) / "missing.json").returncode, 2)


if __name__ == "__main__":
    unittest.main()
