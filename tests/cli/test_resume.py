"""Going on with a run: to a longer duration, from whatever checkpoint is whole, and only as the run
that it was."""

import shutil
import subprocess

import h5py
import numpy as np

from riesel_command import SMALL_TUBE, CommandTest, bytes_of_files, saved_step
from seal import changed_behind_seal


def settings_of(checkpoint):
    """As they stand in it, and nothing while it is being replaced."""
    try:
        with h5py.File(checkpoint, "r") as file:
            return file["settings"][()].decode()
    except OSError:
        return ""


class Resume(CommandTest):

    def copy(self, directory, name):
        return shutil.copytree(directory, self.home / name)

    def test_a_longer_duration_extends_a_finished_run(self):
        long = self.run_small_tube("long", "--set", "run.duration=20 ms")
        # The first ends between two rows of the series, the second soon after a row.
        for name, durations in {"once": ["2.3 ms"], "twice": ["0.5 us", "7.001 ms"]}.items():
            with self.subTest(name):
                short = self.run_small_tube(name, "--set", f"run.duration={durations[0]}")
                for duration in [*durations[1:], "20 ms"]:
                    self.resume_to_end(short, "--set", f"run.duration={duration}")
                self.assert_same_result(long, short)

    def test_runs_of_riesel_0_12_to_0_14_can_be_started_from_but_not_gone_on_with(self):
        """Their checkpoints have 15, 21 and 25 sums per strip for the profiles, and no impulses across."""
        new = self.run_small_tube("new", "--set", "run.duration=1 ms")
        for version, format_version, kept in (("0.12.2", 10, 15), ("0.13.0", 11, 21), ("0.14.0", 12, 25)):
            with self.subTest(version):
                old = self.copy(new, f"old_{version}")
                for checkpoint in (old / "checkpoint.h5", old / "checkpoint.h5.previous"):
                    with changed_behind_seal(checkpoint) as file:
                        file.attrs.modify("format_version", format_version)
                        file.attrs.modify("riesel_version", np.bytes_(version))
                        for name in ("left_x_high", "left_x_low", "right_x_high", "right_x_low"):
                            del file["tally/impulses"].attrs[name]
                        profiles = file["profiles"]
                        strips = profiles.attrs["columns"] // 25
                        profiles.attrs.modify("columns", kept * strips)
                        sums = profiles["sums"][()].reshape(-1, 25 * strips)[:, :kept * strips].ravel()
                        del profiles["sums"]
                        profiles.create_dataset("sums", data=sums, chunks=sums.shape, fletcher32=True)
                before = bytes_of_files(old)
                self.assert_refused(self.riesel("resume", old.name, "--set", "run.duration=2 ms"),
                                    f"{old.name}/checkpoint.h5: has records of other quantities", f"use riesel {version}", "start.kind")
                self.assertEqual(bytes_of_files(old), before)
                self.write("next.yaml", SMALL_TUBE.replace("start: {random_velocity: 2 m/s}",
                                                           f"start: {{kind: continued, from: {old.name}}}"))
                later = self.run_to_end("next.yaml", f"next_{version}", "--set", "run.duration=1 ms")
                with h5py.File(old / "run.h5") as first, h5py.File(later / "run.h5") as second:
                    self.assertNotIn("continues", first["provenance"])
                    told = second["provenance/continues"][()].decode()
                    self.assertIn(f"run {first['provenance/run'][()].decode()} at t = 0.00100", told)
                    self.assertIn(f"(step {saved_step(old)}), state hash {self.state_hash(old)}", told)

    def test_the_time_of_all_lives_of_a_run_counts(self):
        run = self.run_small_tube("run", "--set", "run.duration=100 ms")
        first = self.summary(run)["performance"]["wall_seconds"]
        self.resume_to_end(run, "--set", "run.duration=100.1 ms")
        summary = self.summary(run)
        seconds = summary["performance"]["wall_seconds"]
        self.assertGreaterEqual(seconds, first)
        work = summary["performance"]["particle_steps_per_second"] * seconds
        self.assertAlmostEqual(work / (summary["grains"] * summary["steps"]), 1.0, delta=1e-6)

    def test_grains_that_rotate_on_springs_go_on_by_other_ways(self):
        spinning = [option for setting in ("grains.rotation=disc", "contact.slip=spring", "contact.slip_stiffness=500 N/m",
                                           "contact.rolling_friction=0.1", "output.interval=0.5 ms")
                    for option in ("--set", setting)]
        long = self.run_small_tube("long", *spinning, "--set", "run.duration=5 ms")
        short = self.run_small_tube("short", *spinning, "--set", "run.duration=2.3 ms", "--set",
                                    "run.stepping=plain")
        self.resume_to_end(short, "--threads", 2, "--set", "run.duration=5 ms", "--set", "run.stepping=windows")
        self.assertEqual(self.state_hash(short), self.state_hash(long))
        energy = self.summary(long)["energy"]
        self.assertGreater(energy["rotational"], 0.0)
        self.assertLess(abs(energy["residual"]), 1e-2 * energy["initial"])
        with h5py.File(long / "run.h5", "r") as file:
            final = file["final"]
            spin, mass, radius = (final[name][()] for name in ("spin", "mass", "radius"))
            self.assertAlmostEqual((0.25 * mass * (radius * spin) ** 2).sum() / energy["rotational"], 1.0, delta=1e-9)

    def test_the_longer_duration_is_kept_from_the_start_on(self):
        """In both generations of the checkpoint, so that it is not lost by a kill before the next."""
        short = self.run_small_tube("short", "--set", "run.duration=1 ms")
        checkpoints = [short / "checkpoint.h5", short / "checkpoint.h5.previous"]
        process = self.start("resume", short, "--set", "run.duration=1000 s", "--set",
                             "output.checkpoint_interval=1 h")
        self.wait_until(lambda: all("duration: 1000" in settings_of(checkpoint) for checkpoint in checkpoints),
                        "the longer duration in both checkpoints")
        process.kill()
        process.communicate()
        _, _, effective = (short / "effective.yaml").read_text(encoding="utf-8").partition("\n")
        self.assertEqual([settings_of(checkpoint) for checkpoint in checkpoints], [effective] * 2)
        self.resume_to_end(short, "--set", "run.duration=5 ms", "--set",
                           "output.checkpoint_interval=60 s")
        self.assert_same_result(self.run_small_tube("long"), short)

    def test_what_cannot_go_on_is_left_as_it_is(self):
        run = self.run_small_tube("run")
        with open(run / "run.h5", "r+b") as file:
            file.truncate(2000)
        before = bytes_of_files(run)
        result = self.riesel("resume", run, "--set", "run.duration=20 ms")
        self.assert_refused(result, "run.h5", "restore the file")
        self.assertEqual(bytes_of_files(run), before)

    def test_the_result_does_not_depend_on_the_threads_before_and_after(self):
        rows = ["--set", "output.interval=0.1 ms"]
        long = self.run_small_tube("long", *rows, "--set", "run.duration=0.4 ms")
        for stepping in ("plain", "windows"):
            short = self.run_small_tube(stepping, *rows, "--set", "run.duration=0.2 ms",
                                        "--set", f"run.stepping={stepping}", threads=2)
            self.resume_to_end(short, "--threads", 3, "--set", "run.duration=0.4 ms")
            self.assert_same_result(long, short)
            self.assertEqual(self.summary(short)["performance"]["threads"], 3)

    def test_the_effective_settings_are_those_of_the_longer_run(self):
        long = self.run_small_tube("long")
        short = self.run_small_tube("short", "--set", "run.duration=1 ms")
        self.resume_to_end(short, "--set", "run.duration=5 ms")
        self.assertEqual((long / "effective.yaml").read_bytes(),
                         (short / "effective.yaml").read_bytes())

    def test_a_finished_run_stays_as_it_is(self):
        out = self.run_small_tube("out")
        self.riesel("report", out)
        as_it_was = self.copy(out, "copy")
        self.resume_to_end(out)
        self.assert_same_result(as_it_was, out)
        self.assertTrue((out / "report.html").exists())

    def test_a_result_outlives_a_resume_that_cannot_save(self):
        out = self.run_small_tube("out")
        self.assert_done(self.riesel("report", out))
        (out / "checkpoint.h5.previous").unlink()
        (out / "checkpoint.h5.previous").mkdir()
        before = bytes_of_files(out)
        self.assert_failed(self.riesel("resume", out, "--set", "run.duration=6 ms"), "checkpoint.h5")
        after = bytes_of_files(out)
        for name in (".lock", "checkpoint.h5"):  # whole, with the longer duration
            del before[name], after[name]
        self.assertEqual(after, before)

    def test_settings_of_an_interrupted_run_outlive_a_resume_that_cannot_write(self):
        out = self.run_small_tube("out")
        (out / "summary.json").unlink()
        before = bytes_of_files(out)
        result = self.riesel_with_files_of_at_most(8000, "resume", "out", "--set", "run.duration=6 ms")
        self.assert_failed(result, "raise the limit on the size of files")
        self.assertEqual(bytes_of_files(out) | {".lock": before[".lock"]}, before)

    def test_a_result_outlives_a_resume_that_cannot_write(self):
        out = self.run_small_tube("out")
        before = bytes_of_files(out)
        # The second limit lets the settings through, but neither run.h5 nor a checkpoint.
        longer = ["--set", "run.duration=6 ms"]
        for change, size in ([], 0), (longer, 0), (longer, 8000):
            with self.subTest(change, size=size):
                result = self.riesel_with_files_of_at_most(size, "resume", "out", *change)
                self.assert_failed(result, "raise the limit on the size of files")
                self.assertEqual(bytes_of_files(out) | {".lock": before[".lock"]}, before)
                self.assert_done(self.riesel("report", out))
                for path in [out / "report.html", *out.glob("figures/*")]:
                    path.unlink()
        self.assertEqual(self.resume_to_end(out).returncode, 0)

    def test_an_older_checkpoint_does_not_put_a_later_result_out_of_the_way(self):
        out = self.run_small_tube("out", "--set", "run.duration=2 ms")
        shutil.copy(out / "checkpoint.h5", out / "keep.h5")
        self.resume_to_end(out, "--set", "run.duration=5 ms")
        before = bytes_of_files(out)
        self.assert_refused(self.riesel("resume", "out/keep.h5"), "out/keep.h5", "has come to 0.005",
                            "copy the directory")
        self.assertEqual(bytes_of_files(out), before)
        again = self.copy(out, "again")
        shutil.copy(again / "keep.h5", again / "checkpoint.h5")
        self.resume_to_end(again, "--set", "run.duration=3 ms")
        self.assertAlmostEqual(self.summary(again)["time"], 3e-3, delta=1e-6)
        (out / "checkpoint.h5").write_bytes(b"")  # nothing but the copy is left to go on from
        (out / "checkpoint.h5.previous").unlink()
        self.resume_to_end(out / "keep.h5", "--set", "run.duration=5 ms")
        self.assert_same_result(self.run_small_tube("whole"), out)

    def test_frames_do_not_go_into_a_copy_made_of_hard_links(self):
        frames = ["--set", "output.trajectory_interval=1 ms"]
        out = self.run_small_tube("out", *frames)
        subprocess.run(["cp", "-al", "out", "copy"], cwd=self.home, check=True)
        before = bytes_of_files(out)
        self.resume_to_end(self.home / "copy", "--set", "run.duration=8 ms")
        del before[".lock"]  # tells who was the last to write
        after = bytes_of_files(out)
        self.assertEqual({name: after[name] for name in before}, before)
        whole = self.run_small_tube("whole", *frames, "--set", "run.duration=8 ms")
        copied = self.home / "copy/trajectory.h5"
        with h5py.File(whole / "trajectory.h5") as one, h5py.File(copied) as other:
            self.assertEqual(one["coordinates"][()].tobytes(), other["coordinates"][()].tobytes())

    def test_a_report_does_not_outlive_its_result(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        self.assert_done(self.riesel("report", out))
        (out / "figures/mine.svg").write_text("mine", encoding="utf-8")
        self.resume_to_end(out, "--set", "run.duration=0.2 ms")
        self.assertFalse((out / "report.html").exists())
        self.assertEqual([path.name for path in (out / "figures").iterdir()], ["mine.svg"])

    def test_the_checkpoint_file_stands_for_its_directory(self):
        long = self.run_small_tube("long")
        short = self.run_small_tube("short", "--set", "run.duration=1 ms")
        self.resume_to_end(short / "checkpoint.h5", "--set", "run.duration=5 ms")
        self.assert_same_result(long, short)

    def test_what_is_taken_out_need_not_be_there(self):
        out = self.run_small_tube("out")
        until = ["--set", "run.duration=", "--set", "run.until.relative_error=0.1 %", "--set", "run.until.at_most=6 ms"]
        for _ in range(2):
            self.resume_to_end(out, *until)
        self.assertEqual(self.summary(out)["ended_by"], "at_most")


class ResumeRefuses(CommandTest):

    def assert_refused_untouched(self, out, *options, mentions):
        before = bytes_of_files(out)
        self.assert_refused(self.riesel("resume", out, *options), *mentions)
        self.assertEqual(bytes_of_files(out), before)

    def test_to_change_the_physics_or_the_rows(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        for override in ("gravity=5", "seed=2", "contact.stiffness=1 kN/m", "tube.width=20 mm",
                         "run.steps_per_collision=60", "output.interval=2 ms",
                         "scenario=wall_array"):
            with self.subTest(override):
                key = override.split("=", maxsplit=1)[0]
                self.assert_refused_untouched(
                    out, "--set", override,
                    mentions=[f"--set {override}: {key}: cannot change", "start a new run"])

    def test_what_is_no_setting(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        for override, mentions in {"nonsense": ["--set nonsense:", "key=value"],
                                   "output.intervall=1": ["output.intervall: unknown key", "'output.interval'"],
                                   "run.duration=5 kg": ["run.duration:", "a time", "'5 kg'"],
                                   "run.threads=x": ["run.threads:", "'x'"]}.items():
            with self.subTest(override):
                self.assert_refused_untouched(out, "--set", override, mentions=mentions)

    def test_a_duration_that_is_over_already(self):
        out = self.run_small_tube("out")
        self.assert_refused_untouched(out, "--set", "run.duration=1 ms", mentions=["run.duration"])

    def test_a_duration_of_more_steps_than_can_be_counted(self):
        out = self.run_small_tube("out")
        for duration in ("1e300", "1e12 s"):
            self.assert_refused_untouched(out, "--set", f"run.duration={duration}",
                                          mentions=["run.duration", "more time steps than can be counted"])

    def test_a_result_without_its_run_is_kept(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        for path in (*out.glob("*.h5"), *out.glob("*.previous")):
            path.unlink()
        before = bytes_of_files(out)
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "out: holds a run already")
        self.assertEqual(bytes_of_files(out), before)

    def test_a_post_mortem_without_its_run_is_kept(self):
        self.write("tube.yaml", SMALL_TUBE)
        (self.home / "out").mkdir()
        self.write("out/post_mortem.h5", "of another run")
        before = bytes_of_files(self.home)
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "out: holds a run already")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_what_is_not_there(self):
        self.assert_refused(self.riesel("resume", "nowhere"), "nowhere", "check the path")
        self.assert_nothing_written({})

    def test_a_directory_without_a_checkpoint(self):
        result = self.riesel("resume", ".")
        self.assert_refused(result, "holds no run", "the directory of one")
        self.assert_nothing_written({})

    def test_another_file(self):
        tube = self.write("tube.yaml", "scenario: periodic_tube\n")
        result = self.riesel("resume", tube)
        self.assert_refused(result, "tube.yaml", "is no checkpoint", "directory of a run")
        self.assertEqual([path.name for path in self.home.iterdir()], ["tube.yaml"])
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        for name in ("run.h5", "summary.json", "effective.yaml", ".lock"):
            self.assert_refused(self.riesel("resume", out / name), name, "is no checkpoint")

    def test_a_missing_run_file(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        (out / "run.h5").unlink()
        before = bytes_of_files(out)
        self.assert_refused(self.riesel("resume", out, "--set", "run.duration=0.2 ms"),
                            "out/run.h5", "restore the file")
        self.assertEqual(bytes_of_files(out), before)


class DamagedCheckpoint(CommandTest):
    """Of a run that has two generations: at 2.3 ms, and at 5 ms."""

    def setUp(self):
        super().setUp()
        self.out = self.run_small_tube("out", "--set", "run.duration=2.3 ms")
        self.resume_to_end(self.out, "--set", "run.duration=5 ms")
        self.newest = self.out / "checkpoint.h5"
        self.previous = self.out / "checkpoint.h5.previous"

    def damages(self):
        """{name: content} of a damaged checkpoint."""
        whole = self.newest.read_bytes()
        middle = len(whole) // 2
        flipped = bytes([whole[middle] ^ 1])
        return {"cut short": whole[:middle],
                "empty": b"",
                "a bit flipped": whole[:middle] + flipped + whole[middle + 1:],
                "too long": whole + b"\0"}

    def test_the_generation_before_is_used_and_gives_the_same_result(self):
        as_it_was = shutil.copytree(self.out, self.home / "copy")
        for name, content in self.damages().items():
            with self.subTest(name):
                directory = shutil.copytree(as_it_was, self.home / name.replace(" ", "-"))
                (directory / "checkpoint.h5").write_bytes(content)
                result = self.riesel("resume", directory, "--set", "run.duration=5 ms")
                self.assertEqual(result.returncode, 0, result)
                self.assertIn("checkpoint.h5: is damaged", result.stderr)
                self.assertIn("checkpoint.h5.previous", result.stderr)
                self.assert_same_result(as_it_was, directory)

    def test_the_generation_before_is_used_where_the_newest_is_gone(self):
        """It knows of the longer duration that the run was resumed with."""
        as_it_was = shutil.copytree(self.out, self.home / "copy")
        self.newest.unlink()
        result = self.riesel("resume", self.out)
        self.assertEqual(result.returncode, 0, result)
        self.assertIn("checkpoint.h5.previous", result.stderr)
        self.assert_same_result(as_it_was, self.out)

    def test_without_a_generation_before_the_file_and_the_remedy_are_told(self):
        self.previous.unlink()
        for name, content in self.damages().items():
            with self.subTest(name):
                self.newest.write_bytes(content)
                before = bytes_of_files(self.out)
                self.assert_refused(self.riesel("resume", self.out),
                                    "out/checkpoint.h5: is damaged", "start the run again")
                self.assertEqual(bytes_of_files(self.out), before)

    def test_two_damaged_generations_are_both_named(self):
        self.newest.write_bytes(b"")
        self.previous.write_bytes(b"")
        self.assert_refused(self.riesel("resume", self.out), "out/checkpoint.h5: is damaged",
                            "out/checkpoint.h5.previous: is damaged", "start the run again")

    def test_the_generation_before_can_be_resumed_by_its_name(self):
        as_it_was = shutil.copytree(self.out, self.home / "copy")
        self.resume_to_end(self.previous)
        self.assert_same_result(as_it_was, self.out)
