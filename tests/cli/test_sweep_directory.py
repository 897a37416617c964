"""What stands where a sweep is to be: its own earlier work goes on, that of others stays."""

import json
import shutil

from riesel_command import bytes_of_files
from sweep_command import CHAIN, ONE_POINT, SweepTest


class Directory(SweepTest):

    def test_the_directory_of_a_run_is_no_place_for_a_sweep(self):
        self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        before = bytes_of_files(self.home / "out")
        self.assert_refused(self.sweep(CHAIN), "out: holds a run", "--out")
        self.assertEqual(bytes_of_files(self.home / "out"), before)

    def test_a_dry_run_refuses_what_the_sweep_refuses(self):
        self.run_small_tube("run", "--set", "run.duration=0.1 ms")
        self.sweep_to_end(ONE_POINT, "other")
        before = bytes_of_files(self.home)
        for out, mention in (("run", "run: holds a run"), ("other", "other: holds another sweep")):
            for options in ([], ["--dry-run"], ["--slurm", "--dry-run"]):
                with self.subTest(out, options=options):
                    self.assert_refused(self.sweep(CHAIN, out, *options), mention, "--out")
        after = bytes_of_files(self.home)
        del before["sweep.yaml"], after["sweep.yaml"], before["other/.lock"], after["other/.lock"]
        self.assertEqual(after, before)

    def test_files_of_others_are_not_overwritten(self):
        for name in ("manifest.json", "sweep.yaml", "sweep.csv", "sweep.h5"):
            for options in ([], ["--dry-run"]):
                with self.subTest(name, options=options):
                    (self.home / name).mkdir()
                    self.write(f"{name}/{name}", "mine")
                    self.write("one.yaml", ONE_POINT)
                    result = self.riesel("sweep", "one.yaml", "--out", name, *options)
                    self.assert_refused(result, f"{name}/{name}", "--out")
                    self.assertEqual(bytes_of_files(self.home / name), {name: b"mine"})
                    shutil.rmtree(self.home / name)

    def test_a_sweep_that_has_lost_its_manifest_makes_it_anew(self):
        out = self.sweep_to_end(ONE_POINT)
        before = self.manifest()
        (out / "manifest.json").unlink()
        self.sweep_to_end(ONE_POINT)
        for manifest in (before, self.manifest()):
            del manifest["points"][0]["expected_seconds"]
            self.assertEqual(manifest["points"][0]["status"], "done")

    def test_a_sweep_of_which_nothing_has_come_may_be_replaced(self):
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        point = self.home / "out/points" / self.points()[0]["name"]
        (point / "attempts.json").write_text(json.dumps({"attempts": 1, "failure": "bad luck"}), encoding="utf-8")
        other = self.sweep(ONE_POINT.replace("2000", "3000"))
        self.assertEqual((other.returncode, len(self.rows())), (0, 1), other)

    def test_the_copy_of_the_sweep_file_is_kept_when_it_changes(self):
        out = self.sweep_to_end(ONE_POINT)
        notes = ONE_POINT + "# my notes\n"
        self.write("out/sweep.yaml", notes)
        for _ in range(2):
            self.sweep_to_end(ONE_POINT)
            self.assertEqual((out / "sweep.yaml").read_text(encoding="utf-8"), ONE_POINT)
            self.assertEqual((out / "sweep.yaml.previous").read_text(encoding="utf-8"), notes)

    def test_other_files_that_are_asked_for_later_change_no_point(self):
        branches = "base: tube.yaml\nset: {run.duration: 2 ms}\nbranches: {slow: {start.axial_velocity: 1 m/s%s}, fast: {}}\n"
        out = self.sweep_to_end(branches % "")
        before = bytes_of_files(out / "points")
        self.sweep_to_end(branches % ", output.trajectory_interval: 1 ms, output.checkpoint_interval: 3 s")
        self.assertEqual([row["status"] for row in self.rows()], ["done", "done"])
        self.assertEqual(bytes_of_files(out / "points"), before)

    def test_runs_begin_from_the_files_of_the_plan_only(self):
        self.write("grains.csv", "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n2, 2, 1, 0, 1\n")
        self.write("tube.yaml", """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 10 mm, length: 6 mm}
start: {kind: file, from: grains.csv}
""")
        text = "base: tube.yaml\nset: {run.duration: 1 ms}\naxes: {contact.friction: [0.1, 0.2]}\n"
        self.assert_done(self.sweep(text, "out", "--prepare"))
        self.assert_done(self.riesel("sweep-task", "out", 0))
        planned = (self.home / "grains.csv").read_text(encoding="utf-8")
        self.write("grains.csv", planned + "5, 5, 0, 0, 1\n")
        before = bytes_of_files(self.home)
        for command in (["sweep", "out"], ["sweep", "out", "--dry-run"], ["sweep-task", "out", 1]):
            self.assert_refused(self.riesel(*command), "grains.csv: is not as it was when the sweep was planned",
                                "with the sweep file and another --out")
        self.assertEqual(bytes_of_files(self.home), before)
        self.assert_done(self.riesel("sweep-task", "out", 0))  # it has begun, and reads the file no more
        self.write("grains.csv", planned)
        self.assert_done(self.riesel("sweep", "out"))
        self.assertEqual({row["grains"] for row in self.rows()}, {"1"})

    def test_the_directory_of_a_sweep_is_no_place_for_a_run(self):
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        before = bytes_of_files(self.home / "out")
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "out: holds a sweep", "--out")
        self.assertEqual(bytes_of_files(self.home / "out"), before)
