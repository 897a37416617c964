"""The loops that carry the speed are vector loops, of vectors as wide as there are: GCC says so when it
compiles them.

A loop that GCC gives up on computes the same bits, at 0.7 of the speed of a whole run: no other test
notices.
"""

import collections
import itertools
import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

BUILD = pathlib.Path(os.environ["RIESEL_BUILD"])
SIMD = "#pragma omp simd"
REDUCTION = "reduction("
BYTES = {"x86-64-v3": 32, "x86-64-v4": 64}  # of a vector

# How many instances of the loops of a file become vector loops, at least, with AVX2 and with AVX-512,
# whose instructions make doubles of integers. Those over contacts: two partners, turning or not, four
# slip laws, two linear laws and Hertz's, few contacts and many; pow() and laws from outside cannot be
# vectorised.
EXPECTED = {
    "close_watch.cpp": [1],
    "deflected_grains.cpp": [1, 1],
    "free_flight.cpp": [1, 1],
    "contact_kernel.cpp": [2 * 2 * 4 * 3 * 2],
    "pair_search.cpp": [1, 1, 1, 1],
    "plain_steps.cpp": [1],
    "strips.cpp": [1],
}


def compile_commands():
    entries = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    return {pathlib.Path(e["file"]).name: e for e in entries if "/engine/" in e["file"]
            and "/tests/" not in e["file"]}


def vectorised_lines(entry, machine, width):
    """The lines of the file at which a loop was made of vectors of so many bytes, once for each instance."""
    words = shlex.split(entry["command"])
    words = words[next(i for i, w in enumerate(words) if re.search(r"(\+\+|g\+\+-\d+)$", w)):]
    words[words.index("-o") + 1] = os.devnull
    words = [w for w in words if not re.fullmatch(r"-g\d?", w)]
    words += [f"-march={machine}", "-DRIESEL_VECTOR_KERNEL=", "-fopt-info-vec-optimized", "-S"]
    told = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True, check=True)
    at = re.escape(entry["file"]) + rf":(\d+):\d+: optimized: loop vectorized using {width} byte vectors"
    return collections.Counter(int(n) for n in re.findall(at, told.stdout + told.stderr))


def loop_of(line, pragmas):
    """The loop to which a line belongs that GCC names: of its head or body, or of what is inlined there,
    which stands above it. None if there is none."""
    inside = (pragma for pragma in pragmas if pragma <= line <= pragma + 10)
    below = (pragma for pragma in pragmas if pragma > line)
    return next(inside, next(below, None))


class Vectorised(unittest.TestCase):
    def test_every_file_with_such_a_loop_is_here(self):
        sources = pathlib.Path(__file__).parents[2] / "engine"
        found = {p.name for p in sources.glob("*.cpp") if SIMD in p.read_text(encoding="utf-8")}
        self.assertEqual(found, set(EXPECTED))

    def test_loops(self):
        commands = compile_commands()
        for (name, expected), machine in itertools.product(EXPECTED.items(), BYTES):
            with self.subTest(file=name, machine=machine):
                entry = commands[name]
                lines = pathlib.Path(entry["file"]).read_text(encoding="utf-8").splitlines()
                pragmas = [n for n, line in enumerate(lines, 1) if SIMD in line]
                self.assertEqual(len(pragmas), len(expected))
                told = vectorised_lines(entry, machine, BYTES[machine])
                found = collections.Counter()
                for line, n in told.items():
                    # What a reduction begins and ends with are loops of their own, in the line of the pragma.
                    if line not in pragmas or REDUCTION not in lines[line - 1]:
                        found[loop_of(line, pragmas)] += n
                for pragma, number in zip(pragmas, expected):
                    self.assertGreaterEqual(found[pragma], number, f"{name}:{pragma}, of {dict(told)}")


if __name__ == "__main__":
    unittest.main()
