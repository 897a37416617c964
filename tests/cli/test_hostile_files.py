"""Files made to do harm are refused at once: within 2 s of processor time and 1 GB of memory, or the
system ends the command."""

import json
import os
import resource
import shutil
import subprocess

from riesel_command import COMMAND, SMALL_TUBE, CommandTest, bytes_of_files
from seal import changed_behind_seal, seal_again

PROCESSOR_TIME, MEMORY = 2, 1 << 30  # s, bytes
SIZE = 100_000_000


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_TIME, PROCESSOR_TIME))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


class HostileFiles(CommandTest):

    def limited(self, *arguments):
        return subprocess.run([COMMAND, *map(str, arguments)], cwd=self.home, timeout=120,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", preexec_fn=limit, check=False,
                              env={"OMP_NUM_THREADS": "1"})

    def write_bytes(self, name, content):
        path = self.home / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path

    def assert_settings_refused(self, content, *mentions):
        path = self.write_bytes("hostile.yaml", content)
        for command in (["check"], ["run"], ["sweep", "--dry-run"]):
            with self.subTest(command):
                self.assert_refused(self.limited(*command, path), *mentions)
        self.assertEqual([entry.name for entry in self.home.iterdir()], ["hostile.yaml"])

    def test_a_bomb_of_aliases(self):
        levels = b"a: &a [x, x, x, x, x, x, x, x, x, x]\n"
        for above, below in zip(b"abcdefgh", b"bcdefghi"):
            levels += b"%c: &%c [%s]\n" % (below, below, b", ".join([b"*%c" % above] * 10))
        self.assert_settings_refused(levels, "anchors", "write values out")

    def test_deep_nesting(self):
        for opening in (b"[", b"{a: ", b"- ", b"? "):
            with self.subTest(opening):
                self.assert_settings_refused(b"a: " + opening * 200_000 if opening != b"- "
                                             else opening * 200_000, "hostile.yaml")

    def test_a_hundred_megabytes(self):
        for content in (b"a" * SIZE, b"\n" * SIZE, b"#" + b" x" * (SIZE // 2), bytes(SIZE)):
            with self.subTest(content[:2]):
                self.assert_settings_refused(content, "larger than 1000000 bytes")

    def test_a_megabyte_that_is_hard_to_read(self):
        for content in (b"a: [" + b"x, " * 330_000, b"a: '" + b"''" * 499_000, b"? a\n" * 250_000,
                        b"a:\n" + b" b: c\n" * 160_000, b"!" * 999_999, b"&" * 999_999,
                        b"a: |\n" + b" x\n" * 330_000, b"%" * 999_999, b": " * 499_000):
            with self.subTest(content[:8]):
                self.assert_settings_refused(content, "hostile.yaml")

    def test_a_hundred_megabytes_as_files_of_runs(self):
        """Each in the place of one file of a run that is whole otherwise."""
        whole = self.run_small_tube("whole")
        for name, command in (("checkpoint.h5", "resume"), ("run.h5", "report"), ("summary.json", "report"),
                              ("manifest.json", "status"), ("manifest.json", "collect"),
                              ("manifest.json", "report")):
            run = shutil.copytree(whole, self.home / f"{command}-{name}")
            (run / "checkpoint.h5.previous").unlink()
            for content in (bytes(SIZE), b"[" * SIZE, b"riesel checkpoint\n" * (SIZE // 18)):
                with self.subTest(name, command=command, content=content[:2]):
                    (run / name).write_bytes(content)
                    self.assert_refused(self.limited(command, run.name), f"{run.name}/{name}: ")
            shutil.rmtree(run)

    def test_no_file_outside_the_directory_is_touched(self):
        victim = self.write_bytes("elsewhere/checkpoint.h5", b"precious").parent
        before = bytes_of_files(victim)
        for name in ("../../elsewhere", str(victim)):
            point = {"name": name, "parent": "", "branch": "", "leg": "", "settings": {}, "expected_seconds": 1.0,
                     "most_threads": 1, "status": "waiting", "attempts": 0, "reason": ""}
            manifest = {"format": "riesel sweep", "format_version": 1, "varied": [], "points": [point]}
            self.write_bytes("sweep/manifest.json", json.dumps(manifest).encode())
            for command in (["sweep-task", "sweep", 0], ["status", "sweep"], ["collect", "sweep"],
                            ["report", "sweep"]):
                with self.subTest(name, command=command):
                    self.assert_refused(self.limited(*command), "manifest.json", "the name")
        run = self.run_small_tube("run")
        for name in (".lock", "figures"):
            with self.subTest(name):
                (run / name).unlink(missing_ok=True)
                (run / name).symlink_to(victim / "checkpoint.h5" if name == ".lock" else victim)
                result = self.riesel("report", run)
                self.assertEqual(result.returncode, 1)
                self.assert_one_message(result.stderr, str(run))
                (run / name).unlink()
        self.assertEqual(bytes_of_files(victim), before)

    def test_a_sweep_that_varies_nothing(self):
        point = {"name": "0123456789abcdef", "parent": "", "branch": "", "leg": "", "settings": {}, "expected_seconds": 1.0,
                 "most_threads": 1, "status": "failed", "attempts": 1, "reason": "bad luck"}
        manifest = {"format": "riesel sweep", "format_version": 1, "varied": [], "points": [point]}
        self.write_bytes("sweep/manifest.json", json.dumps(manifest).encode())
        self.write_bytes("sweep/points/0123456789abcdef/attempts.json",
                         json.dumps({"attempts": 1, "failure": "bad luck"}).encode())
        result = self.limited("status", "sweep")
        self.assertEqual(result.returncode, 0, result)
        self.assertIn("bad luck", result.stdout)

    def move_elsewhere(self, path):
        """Leaves a link. Returns where it leads."""
        elsewhere = self.home / "elsewhere" / path.name
        elsewhere.parent.mkdir(exist_ok=True)
        path.rename(elsewhere)
        path.symlink_to(elsewhere)
        return elsewhere

    def test_a_run_does_not_go_on_in_a_trajectory_that_is_a_link(self):
        run = self.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        frames = self.move_elsewhere(run / "trajectory.h5")
        before = frames.read_bytes()
        self.assert_refused(self.riesel("resume", run, "--set", "run.duration=6 ms"), "trajectory.h5",
                            "remove the link")
        self.assertEqual(frames.read_bytes(), before)

    def test_a_run_of_a_sweep_does_not_write_into_a_log_that_is_a_link(self):
        self.write("tube.yaml", SMALL_TUBE)
        sweep = self.write("sweep.yaml", "base: tube.yaml\nseeds: [1]\n")
        self.assertEqual(self.riesel("sweep", sweep, "--out", "sweep").returncode, 0)
        log, = (self.home / "sweep").rglob("log.txt")
        elsewhere = self.move_elsewhere(log)
        before = elsewhere.read_bytes()
        for name in ("checkpoint.h5", "summary.json"):
            (log.parent / name).unlink()
        manifest = self.home / "sweep" / "manifest.json"
        manifest.write_text(manifest.read_text(encoding="utf-8").replace('"done"', '"waiting"'), encoding="utf-8")
        result = self.riesel("sweep", sweep, "--out", "sweep")
        self.assertEqual(result.returncode, 1, result)
        self.assertIn("remove the link", result.stderr)
        self.assertEqual(elsewhere.read_bytes(), before)

    def test_pipes_that_nobody_writes_to_are_not_waited_for(self):
        run = self.run_small_tube("run", "--set", "run.duration=0.1 ms")
        sweep = self.write("sweep.yaml",
                           "base: tube.yaml\nset: {run.duration: 0.1 ms}\nseeds: [1]\n")
        self.assertEqual(self.riesel("sweep", sweep, "--out", "sweep").returncode, 0)
        point, = (self.home / "sweep/points").iterdir()
        commands = {run / ".lock": (["report", "run"], ["resume", "run"]),
                    run / "effective.yaml": (["report", "run"],),
                    point / ".lock": (["status", "sweep"], ["collect", "sweep"], ["report", "sweep"],
                                      ["sweep", "sweep"], ["sweep-task", "sweep", 0]),
                    point / "effective.yaml": (["status", "sweep"], ["collect", "sweep"],
                                               ["sweep", "sweep", "--set", "run.duration=0.1 ms"]),
                    point / "point.yaml": (["status", "sweep"], ["sweep", "sweep"],
                                           ["sweep-task", "sweep", 0],
                                           ["sweep", "sweep", "--set", "run.duration=0.2 ms"]),
                    self.home / "sweep/sweep.yaml": (
                        ["collect", "sweep"], ["report", "sweep"], ["sweep", "sweep"],
                        ["sweep", sweep, "--out", "sweep", "--dry-run"])}
        for path, called in commands.items():
            aside = path.with_name("aside")
            path.rename(aside)
            for command in called:
                with self.subTest(path.name, command=command):
                    os.mkfifo(path)
                    result = self.limited(*command)
                    self.assertIn(result.returncode, (0, 1, 2))
                    if result.returncode != 0:
                        self.assertIn(f"{path.name}: is no regular file; remove it",
                                      result.stderr + result.stdout)
                    path.unlink()
            aside.rename(path)
        for name in ("summary.json", "checkpoint.h5", "checkpoint.h5.previous"):
            (point / name).unlink()
        (point / "point.yaml").unlink()
        os.mkfifo(point / "point.yaml")
        result = self.limited("sweep-task", "sweep", 0)
        self.assertEqual(result.returncode, 1, result)
        self.assertIn("point.yaml: is no regular file; remove it", result.stdout)

    def test_a_pipe_may_bring_the_settings(self):
        for command in ("check", "run"):
            script = f'"$1" {command} <(printf "%s" "$2") --set run.duration="0.1 ms"'
            result = subprocess.run(["bash", "-c", script, "-", COMMAND, SMALL_TUBE], cwd=self.home,
                                    timeout=120, capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 0, result)

    def test_deep_nesting_in_json(self):
        for name, command in (("run/summary.json", "report"), ("run/manifest.json", "status")):
            for content in (b"[" * 1_000_000, b'{"a":' * 1_000_000):
                with self.subTest(name, content=content[:2]):
                    self.write_bytes(name, content)
                    self.assert_refused(self.limited(command, "run"), "run")

    def test_a_forged_checkpoint_with_the_profiles_of_another_tube(self):
        checkpoint = self.run_small_tube("run") / "checkpoint.h5"
        whole = checkpoint.read_bytes()
        seal_again(checkpoint)
        self.assertEqual(checkpoint.read_bytes(), whole, "the seal is made as it was")
        with changed_behind_seal(checkpoint) as file:
            profiles = file["profiles"]
            sums = profiles["sums"][:profiles.attrs["samples"]]
            for name, value in (("columns", 1), ("samples_per_block", 1)):
                profiles.attrs.modify(name, value)
            del profiles["sums"]
            profiles.create_dataset("sums", data=sums, chunks=sums.shape, fletcher32=True)
        (checkpoint.parent / "checkpoint.h5.previous").unlink()
        self.assert_refused(self.riesel("resume", "run"), "is damaged", "profiles",
                            "start the run again")
