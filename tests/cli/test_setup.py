"""./setup.sh run: from packages to a result, and what it does if it is called again. The package manager and the build
are stand-ins, the program is the one under test."""

import os
import pathlib
import shutil
import subprocess

from riesel_command import BAD_INPUT, COMMAND, DONE, FAILED, PATIENCE, SMALL_TUBE, CommandTest

SETUP = pathlib.Path(__file__).resolve().parents[2] / "setup.sh"
INSTALLED = "echo installed"


class Setup(CommandTest):

    def setUp(self):
        super().setUp()
        shutil.copy(SETUP, self.home / "setup.sh")
        (self.home / "scenarios").mkdir()
        self.write("scenarios/periodic_tube.yaml", SMALL_TUBE)
        (self.home / "build/release/app").mkdir(parents=True)
        (self.home / "build/release/app/riesel").symlink_to(COMMAND)
        (self.home / "stand-ins").mkdir()
        for name, action in {"cmake": "true", "sudo": '"$@"', "apt-get": "exit 1", "dpkg-query": INSTALLED}.items():
            self.stand_in(name, action)

    def stand_in(self, name, action):
        """For a program, which notes how it was called."""
        path = self.home / "stand-ins" / name
        path.write_text(f'#!/bin/sh\necho {name} "$@" >>"{self.home}/calls"\n{action}\n', encoding="utf-8")
        path.chmod(0o755)

    def calls(self):
        return (self.home / "calls").read_text(encoding="utf-8")

    def setup_run(self, *arguments):
        path = f"{self.home / 'stand-ins'}:{os.environ['PATH']}"
        return subprocess.run(["bash", "setup.sh", "run", *arguments], cwd=self.home, env={**os.environ, "PATH": path}, check=False,
                              capture_output=True, text=True, timeout=PATIENCE)

    def assert_says(self, *words):
        result = self.setup_run()
        self.assertEqual(result.returncode, DONE, result)
        for word in words:
            self.assertIn(word, result.stdout)

    def test_it_builds_and_runs_and_ends_with_the_result(self):
        self.assert_says("Building build/release", "Running scenarios/periodic_tube.yaml into runs/setup", "== Summary",
                         self.summary(self.run_to_end("scenarios/periodic_tube.yaml", "same"))["state_hash"])
        self.assertIn("cmake --build --preset release --target riesel", self.calls())
        self.assertNotIn("apt-get", self.calls())

    def test_a_result_that_is_there_is_shown(self):
        self.setup_run()
        summary = self.home / "runs/setup/summary.json"
        before = summary.stat()
        self.assert_says("Nothing to do: runs/setup is the result", "== Summary")
        after = summary.stat()  # but for the time of the last look
        self.assertEqual((after.st_ino, after.st_mtime_ns), (before.st_ino, before.st_mtime_ns))

    def test_an_interrupted_run_is_continued(self):
        self.setup_run()
        result = self.summary(self.home / "runs/setup")["state_hash"]
        (self.home / "runs/setup/summary.json").unlink()
        self.assert_says("Continuing the interrupted run in runs/setup", result)

    def test_the_result_of_another_input_stays(self):
        self.setup_run()
        self.write("scenarios/periodic_tube.yaml", SMALL_TUBE + "seed: 2\n")
        for begins in ("Running", "Nothing to do"):
            self.assert_says(begins, "runs/setup-2")
        self.assertEqual(sorted(path.name for path in (self.home / "runs").iterdir() if path.is_dir()),
                         ["setup", "setup-2"])

    def test_a_result_that_was_resumed_since_is_not_taken_for_that_of_the_input(self):
        self.setup_run()
        self.assert_done(self.riesel("resume", "runs/setup", "--set", "run.duration=6 ms"))
        self.assert_says("runs/setup was resumed since: its result is in runs/setup/summary.json")

    def test_a_result_whose_text_was_lost(self):
        self.setup_run()
        (self.home / "runs/setup.txt").write_text("", encoding="utf-8")
        self.assert_says("what it printed at its end was lost", "runs/setup/summary.json")

    def test_it_runs_no_other_input(self):
        result = self.setup_run("scenarios/inclined_chute.yaml")
        self.assertEqual(result.returncode, BAD_INPUT, result)
        self.assertIn("'run' takes no arguments, as scenarios/inclined_chute.yaml", result.stderr)
        self.assertFalse((self.home / "calls").exists())

    def test_packages_that_are_missing_are_installed_or_named(self):
        self.stand_in("dpkg-query", f'case "$3" in cmake | libhdf5-dev) ;; *) {INSTALLED} ;; esac')
        result = self.setup_run()
        self.assertEqual(result.returncode, FAILED, result)
        self.assertIn("apt-get update failed; missing: cmake libhdf5-dev", result.stderr)
        self.stand_in("apt-get", "true")
        self.assert_says("Installing cmake libhdf5-dev")
        self.assertIn("apt-get install -q -y --no-install-recommends cmake libhdf5-dev\n", self.calls())
