"""Directories that go bad: full, read-only, forbidden, moved or removed while a run goes on. The run ends
with a message and status 1, and goes on from its last checkpoint when the directory is good again."""

import os
import shutil
import subprocess
import unittest

from riesel_command import COMMAND, PATIENCE, CommandTest, SMALL_TUBE, bytes_of_files, final_time

LONG_TUBE = SMALL_TUBE.replace("5 ms", "1000 s") + "output: {checkpoint_interval: 0.02 s}\n"
NOBODY = 65534


class Disks(CommandTest):

    def setUp(self):
        super().setUp()
        self.write("tube.yaml", SMALL_TUBE)
        self.write("long.yaml", LONG_TUBE)
        self.out = self.home / "out"

    def mount(self, options):
        """A small file system of its own at self.out."""
        self.out.mkdir(exist_ok=True)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", self.out],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            raise unittest.SkipTest("skipped: this user may not mount a small disk")
        self.addCleanup(subprocess.run, ["umount", "-l", self.out], check=True)

    def assert_forbidden(self, arguments, *mentions):
        """To another user, who has a command of their own: that in the build directory may be out of reach."""
        command = self.home / "riesel"
        shutil.copy(COMMAND, command)
        result = subprocess.run([command, *arguments], cwd=self.home, user=NOBODY, timeout=60,
                                capture_output=True, text=True, check=False)
        self.assert_failed(result, "Permission denied", *mentions)

    def start_long_run(self):
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1)
        self.wait_until((self.out / "checkpoint.h5.previous").exists, "the second checkpoint")
        return process

    def assert_ends_with_word(self, process, *mentions):
        stdout, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual((process.returncode, stdout), (1, ""), stderr)
        self.assert_one_message(stderr, *mentions)

    def assert_goes_on_as_uninterrupted(self, directory):
        end = f"run.duration={final_time(directory) + 1.3e-3!r}"
        self.resume_to_end(directory, "--set", end)
        whole = self.run_to_end("long.yaml", "whole", "--set", end)
        self.assert_same_result(whole, directory)

    # --- full ---

    def test_a_disk_that_fills_up(self):
        self.mount("size=2m")
        self.run_to_end("tube.yaml", "out")
        checkpoint = (self.out / "checkpoint.h5").read_bytes()
        filler = self.out / "filler"
        free = os.statvfs(self.out).f_bavail * os.statvfs(self.out).f_frsize
        filler.write_bytes(bytes(free - 100_000))
        longer = ["--set", "run.duration=20 ms"]
        self.assert_failed(self.riesel("resume", "out", *longer), "out", "No space left on device",
                           "free some space")
        self.assertEqual((self.out / "checkpoint.h5").read_bytes(), checkpoint)
        filler.unlink()
        self.resume_to_end("out", *longer)
        self.assert_same_result(self.run_small_tube("whole", *longer), self.out)

    def test_a_disk_that_is_full_from_the_beginning(self):
        self.mount("size=64k")
        result = self.riesel("run", "tube.yaml", "--out", "out")
        self.assert_failed(result, "run.h5", "No space left on device", "free some space")
        self.assertNotIn("checkpoint.h5", bytes_of_files(self.out))
        self.assert_refused(self.riesel("resume", "out"), "out", "start the run again")

    # --- read-only and forbidden ---

    def test_a_read_only_disk(self):
        self.mount("size=4m")
        self.run_to_end("tube.yaml", "out")
        before = bytes_of_files(self.out)
        subprocess.run(["mount", "-o", "remount,ro", self.out], check=True)
        for arguments in (["resume", "out", "--set", "run.duration=9 ms"],
                          ["run", "tube.yaml", "--out", "out/new"]):
            self.assert_failed(self.riesel(*arguments), "Read-only file system", "not read-only")
        self.assertEqual(bytes_of_files(self.out), before)

    @unittest.skipUnless(os.geteuid() == 0, "skipped: permissions are tested by turning from root")
    def test_a_forbidden_directory(self):
        self.home.chmod(0o755)
        self.run_to_end("tube.yaml", "out")
        before = bytes_of_files(self.out)
        for arguments in (["resume", "out", "--set", "run.duration=9 ms"],
                          ["run", "tube.yaml", "--out", "new"]):
            self.assert_forbidden(arguments, "permissions")
        self.out.chmod(0o700)  # nobody else can tell what is in it
        for arguments in (["resume", "out"], ["report", "out"], ["run", "tube.yaml", "--out", "out/new"]):
            self.assert_forbidden(arguments, "out", "cannot be", "Permission denied; check the permissions")
        self.assertEqual(bytes_of_files(self.out), before)

    # --- removed and moved ---

    def test_a_directory_that_is_removed_while_running(self):
        process = self.start_long_run()
        moved = self.out.rename(self.home / "moved")  # at once, while removing takes its time
        shutil.rmtree(moved)
        self.assert_ends_with_word(process, "out", "No such file or directory")
        self.assertFalse(self.out.exists())

    def test_a_directory_that_is_moved_while_running(self):
        process = self.start_long_run()
        moved = self.out.rename(self.home / "moved")
        self.assert_ends_with_word(process, "out", "No such file or directory")
        self.assert_goes_on_as_uninterrupted(moved)

    def test_another_directory_in_its_place_is_left_alone(self):
        process = self.start_long_run()
        moved = self.out.rename(self.home / "moved")
        self.out.mkdir()
        self.assert_ends_with_word(process, "out", "no longer the directory", "continue in the original one")
        self.assertEqual(bytes_of_files(self.out), {})
        self.assert_goes_on_as_uninterrupted(moved)
