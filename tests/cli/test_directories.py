"""Where results go: never over another run, and with a clear word where there is no room."""

import shutil
import subprocess
import unittest

from riesel_command import BAD_INPUT, COMMAND, FAILED, PATIENCE, SMALL_TUBE, CommandTest, bytes_of_files


def mounts_are_permitted():
    attempt = subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False)
    return attempt.returncode == 0


class Directories(CommandTest):

    def test_an_existing_run_is_left_untouched_byte_by_byte(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        before = bytes_of_files(self.home)
        for options in ([], ["--set", "seed=2"]):
            result = self.riesel("run", "tube.yaml", "--out", "out", *options)
            self.assert_refused(result, "out: ", "a run already", "--out", "riesel resume")
        self.assertEqual(bytes_of_files(self.home), before)
        self.assertTrue((out / "summary.json").exists())

    def test_directories_on_the_way_are_made(self):
        self.run_small_tube("a/b/c", "--set", "run.duration=0.1 ms")
        self.assertTrue((self.home / "a/b/c/summary.json").exists())

    def test_an_empty_directory_and_other_files_in_it_are_no_obstacle(self):
        out = self.home / "out"
        out.mkdir()
        (out / "notes.txt").write_text("mine", encoding="utf-8")
        self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        self.assertEqual((out / "notes.txt").read_text(encoding="utf-8"), "mine")

    def test_a_lock_of_others_is_not_overwritten(self):
        (self.home / "out").mkdir()
        self.write("out/.lock", "precious")
        self.write("tube.yaml", SMALL_TUBE)
        before = bytes_of_files(self.home)
        self.assert_failed(self.riesel("run", "tube.yaml", "--out", "out"), "out/.lock", "riesel has not written it")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_settings_of_the_user_are_not_overwritten(self):
        self.write("tube.yaml", SMALL_TUBE)
        (self.home / "out").mkdir()
        self.write("out/effective.yaml", SMALL_TUBE)
        before = bytes_of_files(self.home)
        for settings in ("tube.yaml", "out/effective.yaml"):
            self.assert_refused(self.riesel("run", settings, "--out", "out"), "out/effective.yaml",
                                "would be overwritten", "--out")
        self.assert_refused(self.riesel("resume", "out"), "holds no run")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_what_a_run_reads_it_does_not_overwrite(self):
        """Not even if riesel has written it, for another run."""
        run = self.run_small_tube("run", "--set", "run.duration=0.1 ms")
        (self.home / "out").mkdir()
        shutil.copy(run / "effective.yaml", self.home / "out")
        before = bytes_of_files(self.home)
        result = self.riesel("run", "out/effective.yaml", "--out", "out")
        self.assert_refused(result, "out/effective.yaml", "rename it")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_what_a_run_left_that_had_hardly_begun_is_no_obstacle(self):
        run = self.run_small_tube("run", "--set", "run.duration=0.1 ms")
        (self.home / "out").mkdir()
        shutil.copy(run / "effective.yaml", self.home / "out")
        self.run_small_tube("out", "--set", "run.duration=0.2 ms")

    def test_names_that_lead_out_of_their_directory(self):
        self.write("tube.yaml", SMALL_TUBE)
        for name in ("..yaml", "...yaml"):
            with self.subTest(name):
                self.write(name, SMALL_TUBE)
                self.assert_refused(self.riesel("run", name), f"{name}: ", "--out")
                self.run_to_end(name, f"out{name}", "--set", "run.duration=0.1 ms")
                self.write(name, "base: tube.yaml\nseeds: [1]\n")
                self.assert_refused(self.riesel("sweep", name), f"{name}: ", "--out")
        for directory in ("runs", "sweeps"):
            self.assertFalse((self.home / directory).exists())

    def test_a_file_in_the_way_is_named(self):
        self.write("tube.yaml", SMALL_TUBE)
        before = bytes_of_files(self.home)
        for out, status in (("tube.yaml", BAD_INPUT), ("tube.yaml/out", FAILED)):
            with self.subTest(out):
                result = self.riesel("run", "tube.yaml", "--out", out)
                self.assertEqual((result.returncode, result.stdout), (status, ""), result)
                self.assert_one_message(result.stderr, f"{out}: ", "directory")
                self.assert_nothing_written(before)


@unittest.skipUnless(mounts_are_permitted(), "mounting a small disk is not permitted here")
class SmallDisk(CommandTest):
    """A disk that is there while a shell runs, mounted on `disk`."""

    def setUp(self):
        super().setUp()
        (self.home / "disk").mkdir()
        self.write("tube.yaml", SMALL_TUBE)

    def on_disk(self, options, script):
        return subprocess.run(
            ["unshare", "-rm", "sh", "-c",
             f"mount -t tmpfs -o {options} tmpfs disk && {script}", "sh", COMMAND],
            cwd=self.home, capture_output=True, text=True, timeout=PATIENCE, check=False)

    def test_a_full_disk_is_a_failure_that_says_so(self):
        for size in ("8k", "64k", "200k"):
            with self.subTest(size):
                result = self.on_disk(
                    f"size={size}", '"$1" run tube.yaml --out disk/out --threads 1')
                self.assert_failed(result, "disk/out", "No space left on device",
                                   "free some space on its disk")

    def test_a_run_that_met_a_full_disk_goes_on_when_there_is_room(self):
        result = self.on_disk("size=4000k", """
            "$1" run tube.yaml --out disk/out --threads 1 >&2 || exit 99
            head -c 6000000 /dev/zero > disk/ballast 2> /dev/null
            "$1" resume disk/out --set "run.duration=20 ms" > /dev/null
            [ $? = 1 ] || exit 98
            rm disk/ballast
            "$1" resume disk/out --set "run.duration=20 ms" >&2 || exit 97
            cp -r disk/out .
            """)
        self.assertEqual(result.returncode, 0, result)
        self.assertIn("No space left on device", result.stderr)
        whole = self.run_small_tube("whole", "--set", "run.duration=20 ms")
        self.assert_same_result(whole, self.home / "out")

    def test_a_disk_that_cannot_be_written_is_named(self):
        for out in ("disk", "disk/out"):
            with self.subTest(out):
                result = self.on_disk("ro", f'"$1" run tube.yaml --out {out}')
                self.assert_failed(result, f"{out}: ", "Read-only file system",
                                   "choose a directory on a disk that is not read-only")
