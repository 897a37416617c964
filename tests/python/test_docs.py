"""What docs/python.md shows happens as it stands there: its files, its commands, its Python."""

import contextlib
import doctest
import os
import pathlib
import re
import subprocess

from riesel_command import COMMAND, DONE, SHIPPED, CommandTest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/python.md"
# Numbers are those of one machine type; where a line ends in "...", the rest may be anything.
OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


class Page(CommandTest):

    def setUp(self):
        super().setUp()
        self.page = PAGE.read_text(encoding="utf-8")
        (self.home / "scenarios").symlink_to(SHIPPED)
        (self.home / "riesel").symlink_to(COMMAND)
        for text in blocks(self.page, "yaml"):
            name = re.match(r"# (\S+)\n", text)[1]
            self.write(name, text)

    def run_commands(self):
        environment = {**os.environ, "PATH": f"{self.home}:{os.environ['PATH']}"}
        for commands in blocks(self.page, "sh"):
            result = subprocess.run(["bash", "-e", "-c", commands], cwd=self.home, check=False,
                                    env=environment, capture_output=True, text=True)
            self.assertEqual(result.returncode, DONE, result)

    def test_what_it_shows(self):
        self.run_commands()
        examples = "\n".join(blocks(self.page, "python"))
        test = doctest.DocTestParser().get_doctest(examples, {}, "docs/python.md", None, 0)
        self.assertGreater(len(test.examples), 20)
        said = []
        with contextlib.chdir(self.home):
            failed, _ = doctest.DocTestRunner(optionflags=OPTIONS).run(test, out=said.append)
        self.assertEqual(failed, 0, "".join(said))
        self.assertIn("mean_vy (m/s)", (self.home / "flow.svg").read_text(encoding="utf-8"))
