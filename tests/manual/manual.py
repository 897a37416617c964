"""The manual as a script: the files that it shows, and the commands with what they print."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

HOME = pathlib.Path(__file__).resolve().parents[2]
COMMAND = pathlib.Path(os.environ["RIESEL"]).resolve()
BUILD = COMMAND.parents[1]
PATIENCE = 250.0  # s

PROGRAM = re.compile(r"(\w+=\S+ )*(riesel|cmake|cpack|ctest|\(?cd|eval|export|for (?=\w+ in )\w+|mkdir|python3|seq|source|"
                     r"timeout|valgrind|(/usr/bin/|\./|build/|docs/|tests/|bench/)\S+) ")


def shown_files(text):
    """{name: content} of the blocks that begin with a comment of their name."""
    return dict(re.findall(r"^```\w+\n# ([\w.]+\.\w+)(?::[^\n]*)?\n(.*?)^```", text, re.M | re.S))


def commands(text):
    """(command, lines that it prints) of the indented blocks; after "$ " what follows is output."""
    found, continued = [], ""
    for line in re.sub(r"^```.*?^```", "", text, flags=re.M | re.S).splitlines():
        if not line.startswith("    "):
            continue
        is_prompted = line.startswith("    $ ")
        code = continued + line.removeprefix("    $ ").strip()
        continued = ""
        if is_prompted or PROGRAM.match(code + " "):
            if code.endswith("\\"):
                continued = code[:-1]
            else:
                found.append((re.sub(r"\s+# .*", "", code), []))
        elif found and line.startswith("      "):
            found[-1][1].append(line.strip())
    return found


class ManualTest(unittest.TestCase):
    """Works in an empty directory in which the paths of the manual lead to the sources and to this build."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="riesel-manual-")
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        for name in ("setup.sh", "CMakePresets.json", "docs", "scenarios", "tests", "bench"):
            (self.directory / name).symlink_to(HOME / name)
        (self.directory / "build").mkdir()
        for preset in ("ci", "bench", "release"):
            (self.directory / "build" / preset).symlink_to(BUILD)

    def put_files(self, text):
        for name, content in shown_files(text).items():
            (self.directory / name).write_text(content)

    def execute(self, command):
        """Its output, of both kinds. It must succeed."""
        path = f"{COMMAND.parent}:/usr/bin:{os.environ['PATH']}"  # Debian's Python before others
        done = subprocess.run(["bash", "-c", command], cwd=self.directory, env=os.environ | {"PATH": path},
                              capture_output=True, text=True, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr
