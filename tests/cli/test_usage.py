"""The command line itself: what is asked for in the wrong way, and what tells how to ask."""

import re
import subprocess

from riesel_command import BAD_INPUT, COMMAND, SHIPPED, CommandTest

# Of each subcommand what its help must tell.
WORDS = {
    "run": ["FILE", "--out", "--set", "--threads", "--profile", "--max-walltime", "--quiet", "--verbose"],
    "resume": ["DIR", "--set", "--threads", "--profile", "--max-walltime", "--quiet", "--verbose"],
    "check": ["FILE", "--set", "--threads"],
    "report": ["DIR"],
    "sweep": ["FILE", "--out", "--set", "--jobs", "--threads", "--dry-run", "--prepare", "--retry-failed",
              "--max-walltime", "--slurm", "--tasks", "--sbatch"],
    "sweep-task": ["DIR", "INDEX", "--of", "--set", "--threads", "--max-walltime", "--retry-failed"],
    "status": ["DIR"],
    "collect": ["DIR"],
    "new": ["SCENARIO", "FILE"],
    "scenarios": [],
    "settings": [],
    "schema": ["--sweep"],
    "completion": ["SHELL"],
    "man": [],
}


class Usage(CommandTest):

    def assert_usage_error(self, *arguments, mentions):
        result = self.riesel(*arguments)
        self.assertEqual(result.returncode, BAD_INPUT, result)
        self.assertEqual(result.stdout, "")
        self.assert_one_message(result.stderr, mentions, "--help")
        self.assert_nothing_written({})

    def test_without_a_subcommand(self):
        self.assert_usage_error(mentions="subcommand")

    def test_an_unknown_subcommand_is_named(self):
        self.assert_usage_error("simulate", mentions="'simulate'")
        self.assert_usage_error("help", "simulate", mentions="'simulate'")
        self.assert_usage_error("rum", "tube.yaml", mentions="did you mean 'run'?")

    def test_help_is_a_command_too(self):
        for words in ([], ["run"], ["sweep"]):
            with self.subTest(words):
                result = self.riesel("help", *words)
                self.assert_done(result)
                self.assertEqual(result.stdout, self.riesel(*words, "--help").stdout)
        self.assertEqual(self.riesel("help", "help").stdout, self.riesel("--help").stdout)

    def test_the_fuzzer_knows_every_key_of_the_settings(self):
        keys = re.findall(r"^\| `([a-z_.]+)` \|", self.riesel("settings").stdout, re.MULTILINE)
        self.assertGreater(len(keys), 50)
        words = (SHIPPED.parent / "tests/fuzz/yaml.dict").read_text(encoding="utf-8").splitlines()
        self.assertEqual({word for key in keys for word in key.split(".") if f'"{word}"' not in words}, set())

    def test_an_unknown_option_is_named(self):
        for arguments in (["--fast"], ["run", "--fast"], ["run", "--fast", "tube.yaml"]):
            with self.subTest(arguments):
                self.assert_usage_error(*arguments, mentions="--fast")

    def test_a_missing_argument_is_named(self):
        self.assert_usage_error("run", mentions="FILE")
        self.assert_usage_error("check", mentions="FILE")
        self.assert_usage_error("resume", mentions="DIR")
        self.assert_usage_error("report", mentions="DIR")

    def test_an_option_without_its_value_is_named(self):
        for option in ("--out", "--set", "--threads"):
            with self.subTest(option):
                self.assert_usage_error("run", "tube.yaml", option, mentions=option)

    def test_an_empty_name_is_refused(self):
        for arguments in (["run", "tube.yaml", "--out", ""], ["sweep", "tube.yaml", "--out", ""],
                          ["new", "periodic_tube", ""]):
            with self.subTest(arguments):
                self.assert_usage_error(*arguments, mentions="is empty")

    def test_two_files_are_one_too_many(self):
        self.assert_usage_error("run", "one.yaml", "two.yaml", mentions="two.yaml")

    def test_help_names_every_subcommand_and_its_options(self):
        self.assertEqual(set(self.subcommands()), set(WORDS))
        for subcommand, words in WORDS.items():
            with self.subTest(subcommand):
                result = self.riesel(subcommand, "--help")
                self.assert_done(result)
                self.assertIn(f" {subcommand} [OPTIONS]", result.stdout)
                for word in words:
                    self.assertRegex(result.stdout, rf"(?m)^  (-\w,)?{word}\b")

    def test_what_is_to_be_called_next_is_called_as_this_program_is(self):
        (self.home / "grains").symlink_to(COMMAND)
        result = subprocess.run(["./grains", "report", "nowhere"], cwd=self.home, capture_output=True, text=True,
                                check=False)
        self.assertIn("see 'grains run' and 'grains sweep'", result.stderr)

    def test_version_is_told(self):
        result = self.riesel("--version")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"\Ariesel \d+\.\d+\.\d+ \(.*\)\n\Z")

    def test_the_settings_reference_knows_every_scenario_and_its_keys(self):
        result = self.riesel("settings")
        self.assert_done(result)
        for name in ("single_wall_grain", "wall_array", "periodic_tube", "contact.stiffness",
                     "impact.height", "grains.area_fraction", "run.duration"):
            self.assertIn(f"`{name}`", result.stdout)

    def test_every_scenario_is_listed_on_a_line_with_what_it_is(self):
        result = self.riesel("scenarios")
        self.assert_done(result)
        lines = result.stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines],
                         ["single_wall_grain", "wall_array", "bead_column", "periodic_tube", "inclined_chute",
                          "shear_cell"])
        for line in lines:
            self.assertRegex(line, r"\((Figs?\. \d|[A-Z].*\d{4})")
        self.assertEqual({line.split()[0] for line in lines},
                         {path.stem for path in SHIPPED.glob("*.yaml")})
