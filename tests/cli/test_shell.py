"""What shells and man are told of the command line is all of it, and shells can do with it."""

import re
import shutil
import subprocess
import unittest

from riesel_command import CommandTest

BASH = """\
source <(printf %s "$script")
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_riesel
printf '%s\\n' "${COMPREPLY[@]}"
"""
# The completion system of zsh works at a keyboard only: these tell how it is called.
ZSH = """\
compdef() { }
_describe() { print -l -- ${(P)2} }
_arguments() { print -l -- "$@" }
source <(print -r -- "$script")
words=("$@")
CURRENT=$#
_riesel
"""


class Shell(CommandTest):

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.scripts = {shell: maker.riesel("completion", shell).stdout for shell in ("bash", "zsh")}
        cls.commands = maker.subcommands()
        cls.options = {name: set(re.findall(r"(?:^  |,)(--?[a-z-]+)", maker.riesel(name, "--help").stdout,
                                            re.MULTILINE)) for name in cls.commands}

    def call(self, shell, program, *words):
        return subprocess.run([shell, "-c", program, shell, "riesel", *words], cwd=self.home, text=True,
                              capture_output=True, timeout=60, check=True,
                              env={"script": self.scripts[shell], "PATH": "/usr/bin:/bin"})

    def offered(self, *words):
        """By bash, for the last word."""
        result = self.call("bash", BASH, *words)
        self.assertEqual(result.stderr, "")
        return result.stdout.split("\n")[:-1]

    def test_bash_offers_subcommands(self):
        self.assertGreater(len(self.commands), 10)
        self.assertEqual(self.offered(""), [*self.commands, "--help", "--version"])
        self.assertEqual(self.offered("res"), ["resume"])

    def test_bash_offers_all_options_of_each_subcommand(self):
        for command in self.commands:
            with self.subTest(command):
                self.assertEqual(set(self.offered(command, "-")), self.options[command])
        self.assertEqual(self.offered("run", "tube.yaml", "--th"), ["--threads"])

    def test_bash_offers_files_keys_and_scenarios(self):
        self.write("my tube.yaml", "")
        (self.home / "runs").mkdir()
        self.assertEqual(set(self.offered("run", "")), {"my tube.yaml", "runs"})
        self.assertEqual(self.offered("run", "x.yaml", "--out", ""), ["runs"])
        self.assertEqual(self.offered("resume", ""), ["runs"])
        self.assertEqual(self.offered("run", "x.yaml", "--set", "run.d"), ["run.duration="])
        self.assertEqual(self.offered("new", "peri"), ["periodic_tube"])
        self.assertEqual(self.offered("completion", ""), ["bash", "zsh"])

    @unittest.skipIf(shutil.which("zsh") is None, "there is no zsh")
    def test_zsh_is_told_the_same(self):
        subcommands = self.call("zsh", ZSH, "").stdout.splitlines()
        self.assertEqual([line.split(":")[0] for line in subcommands], self.commands)
        for command in self.commands:
            with self.subTest(command):
                told = self.call("zsh", ZSH, command, "").stdout.splitlines()
                options = {re.match(r"\*(-[a-z-]+)\[", line).group(1) for line in told if line[0] == "*"}
                self.assertEqual(options, self.options[command])
        self.assertRegex(self.call("zsh", ZSH, "new", "").stdout, r":SCENARIO:\(.*\bperiodic_tube\b.*\)")

    def test_another_shell_is_refused(self):
        result = self.riesel("completion", "fish")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("bash", result.stderr)

    def test_the_manual_page_has_everything(self):
        page = self.riesel("man").stdout
        plain = page.replace("\\-", "-")
        for command in self.commands:
            self.assertIn(f"\\fBriesel {command}\\fR", plain)
            for option in self.options[command]:
                self.assertIn(option, plain)
        self.assertNotRegex(page, r"(?m)^\.(?!TH|SH|SS|TP|PP|B )")

    @unittest.skipIf(shutil.which("groff") is None, "there is no groff")
    def test_the_manual_page_is_roff(self):
        page = self.riesel("man").stdout
        shown = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-P-c"], input=page, text=True,
                               capture_output=True, timeout=60, check=True)
        self.assertEqual(shown.stderr, "")
        self.assertIn("riesel resume DIR", re.sub(".\b", "", shown.stdout))
