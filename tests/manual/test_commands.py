"""The commands in the indented lines of the README and of the manual are run: as they stand, or in a shorter form."""

import re

from manual import HOME, ManualTest, commands

OWN_TESTS = {"first_run.md"}
KEPT = "bench/results/intel-xeon-2-cores-4bc4f3a.json"

# (what stands in the manual, what is run instead): hours are made seconds, and what would install packages is asked
# for its help. The first one that fits. What is left of a command is as it stands, so that its options are tried:
# `speed` looks at them, and at a case and a size, before it lists its cases or shows its help.
SHORTER = [
    (r"\./setup\.sh (\w+)(?: .*)?", r"./setup.sh help | grep '^  \1 '"),
    (r"docs/paper/reproduce\.sh (\w+)", r"docs/paper/reproduce.sh --help 2>&1 | grep '^  \1 '"),
    (r"(riesel run (?:scenarios/)?periodic_tube\.yaml.*)", r"\1 --set tube.length='10 mm' --set run.duration='0.1 s'"),
    (r"(riesel resume .*)'4 s'", r"\1'0.2 s'"),
    (r"(riesel resume .*)'20 s'", r"\1'0.3 s'"),
    (r"(riesel sweep (?:scenarios/paper|docs/flows)/.*)", r"\1 --dry-run"),
    (r"(docs/flows/\w+\.py)", r"/usr/bin/python3 -B \1 --help"),
    (r"(riesel sweep \S+) --slurm --max-walltime .*", r"\1 --prepare"),
    (r"seq 0 15 \| parallel (.*)", r"seq 0 15 | parallel --will-cite \1"),
    (r"cmake --install build/release --prefix DIR", "test -f build/ci/cmake_install.cmake"),
    (r"tests/package/clean_debian\.sh .*", "bash -n tests/package/clean_debian.sh"),
    (r"cmake -S (examples/\w+) .*|cmake --build build/cooling|build/cooling/cooling run .*", "test -f tests/package/test_example.py"),
    (r"cmake --preset (\w+) && cmake --build --preset .*", r"cmake --list-presets | grep '\"\1\"'"),
    (r"(build/bench/bench/speed(?: --.*)?)", r"\1 list"),
    (r"(build/bench/bench/speed state \w+ \w+)", r"\1 --help"),
    (r"build/bench/bench/rigid/rigid speed STATE\.h5", "test -x build/bench/bench/rigid/rigid"),
    (r"build/bench/bench/simd/simd STATE\.h5", "test -x build/bench/bench/simd/simd"),
    (r"bench/compare\.py \w+\.json", f"bench/compare.py {KEPT}"),
    (r"bench/compare\.py A\.json B\.json (.*)", rf"bench/compare.py {KEPT} {KEPT} \1"),
    (r"bench/goals\.py FILE\.json\.\.\.", f"bench/goals.py {KEPT}"),
    (r"bench/peers/run\.py", "/usr/bin/python3 bench/peers/run.py --help"),
    (r"RIESEL_KILLS=\w+ /usr/bin/python3 -m unittest -v test_faults", "test -f tests/reliability/test_faults.py"),
    (r"RIESEL_JOURNEYS=.* /usr/bin/python3 -m unittest test_journeys", "test -f tests/cli/test_journeys.py"),
    (r"(build/ci/tests/reliability/every_bit).*", r"\1 9973"),
    (r"mkdir .* build/fuzz/tests/fuzz/fuzz_yaml -dict=(\S+) .* (tests/fuzz/corpus/yaml)", r"test -f \1 -a -d \2"),
    (r"(build/ci/tests/properties set-ups) .*", r"\1 1001 2"),
    (r"tests/mutation/mutate\.py.*", "tests/mutation/mutate.py --help"),
    (r"valgrind .* (build/ci/app/riesel) run .*", r"test -x \1"),
    (r"OMP_WAIT_POLICY=passive (/usr/bin/python3 tests/reliability/soak\.py) .*", r"\1 --help"),
    (r"cd build/ci && RIESEL_SLURM=1 ctest -V -R cli/(\w+)", r"test -f tests/cli/\1.py"),
    (r"\(cd build/release && cpack\)", "test -f build/release/CPackConfig.cmake"),
    (r"source <\((riesel completion zsh)\)", r"\1"),  # of another shell
]


def short_form(command):
    """And the rule that makes it; None for a command as it stands."""
    for rule in SHORTER:
        if match := re.fullmatch(rule[0], command):
            return match.expand(rule[1]), rule
    return command, None


def pages():
    return [page for page in sorted((HOME / "docs").glob("*.md")) if page.name not in OWN_TESTS]


class Commands(ManualTest):
    def check(self, page):
        text = page.read_text()
        self.put_files(text)
        return len([self.execute(short_form(command)[0]) for command, _ in commands(text)])

    def test_readme(self):
        self.assertGreater(self.check(HOME / "README.md"), 5)

    def test_the_pages_of_the_manual(self):
        self.assertGreater(sum(self.check(page) for page in pages()), 30)

    def test_each_shorter_form_is_that_of_a_command(self):
        used = [short_form(command)[1] for page in [HOME / "README.md", *pages()]
                for command, _ in commands(page.read_text())]
        self.assertEqual([rule for rule in SHORTER if rule not in used], [])
