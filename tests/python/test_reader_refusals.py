"""The Python package says what is not there, or cannot be read, and what to do about it."""

import json
import os
import re

import h5py
import riesel

from riesel_command import SMALL_TUBE, CommandTest, saved_step
from seal import changed_behind_seal

SWEEP = "base: tube.yaml\naxes: {contact.restitution: [0.7, 0.9]}\n"


class NotThere(CommandTest):

    def test_what_is_no_run(self):
        with self.assertRaisesRegex(riesel.NotThere, "nowhere: is not a directory; "):
            riesel.Run(self.home / "nowhere")
        empty = riesel.Run(self.home)
        self.assertFalse(empty.is_done)
        for part in ("summary", "settings", "series", "provenance"):
            with self.assertRaisesRegex(riesel.NotThere, "is not there; "):
                getattr(empty, part)
        with self.assertRaisesRegex(riesel.NotThere, "manifest.json: is not there; "):
            riesel.Sweep(self.home)

    def unfinished_run(self):
        self.write("tube.yaml", SMALL_TUBE.replace("5 ms", "1000 s"))
        result = self.riesel("run", "tube.yaml", "--out", "run", "--max-walltime", "1 s")
        self.assertEqual(result.returncode, 3, result)
        return riesel.Run(self.home / "run")

    def test_a_run_that_is_not_over(self):
        run = self.unfinished_run()
        self.assertFalse(run.is_done)
        self.assertGreater(len(run.series["time"]), 1)
        with self.assertRaisesRegex(riesel.NotThere, "summary.json.*riesel resume"):
            run.summary
        with self.assertRaisesRegex(riesel.NotThere, "come to their end"):
            run.profiles
        with self.assertRaisesRegex(riesel.NotThere, "only impact scenarios and bead_column"):
            run.curve

    def test_the_state_of_a_run_that_is_not_over_is_that_of_its_checkpoint(self):
        run = self.unfinished_run()
        self.assertEqual(run.final.step, saved_step(run.directory))
        self.assertGreater(run.final.step, 0)
        self.assertGreaterEqual(run.final.time, run.series["time"][-1])


class Unreadable(CommandTest):
    """What is damaged is told with the path and a remedy."""

    def assert_unreadable(self, path, read, remedy):
        with self.assertRaisesRegex(riesel.Unreadable, rf"{path}: .*; {remedy}"):
            read()

    @staticmethod
    def cut_in_half(path):
        path.write_bytes(path.read_bytes()[:path.stat().st_size // 2])

    def test_files_of_a_run(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        frames = riesel.Run(directory).trajectory
        for name in ("run.h5", "trajectory.h5", "summary.json"):
            self.cut_in_half(directory / name)
        (directory / "effective.yaml").write_text("contact: {", encoding="utf-8")
        run = riesel.Run(directory)
        for name, parts in (("run.h5", ("series", "profiles", "histograms", "final", "provenance")),
                            ("trajectory.h5", ("trajectory",)), ("summary.json", ("summary",)),
                            ("effective.yaml", ("settings",))):
            of_summary = name == "summary.json"
            anew = "make it anew by 'riesel resume" if of_summary else "make the run again"
            for part in parts:
                self.assert_unreadable(directory / name, lambda: getattr(run, part),
                                       f"restore the file, or {anew}")
        self.assert_unreadable(directory / "trajectory.h5", lambda: list(frames), "restore")

    def test_files_that_hold_something_else(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=1 ms")
        for name in ("summary.json", "effective.yaml"):
            (directory / name).write_text("[1, 2]", encoding="utf-8")
        with changed_behind_seal(directory / "run.h5") as file:
            del file["final"].attrs["time"]
        with h5py.File(directory / "trajectory.h5", "w"):
            pass
        run = riesel.Run(directory)
        for name, part in (("summary.json", "summary"), ("effective.yaml", "settings"),
                           ("run.h5", "final"), ("trajectory.h5", "trajectory")):
            self.assert_unreadable(directory / name, lambda: getattr(run, part), "restore")

    def test_what_is_nested_without_end(self):
        directory = self.run_small_tube("run")
        for name, part in (("summary.json", "summary"), ("effective.yaml", "settings")):
            (directory / name).write_text("[" * 100_000, encoding="utf-8")
            self.assert_unreadable(directory / name, lambda: getattr(riesel.Run(directory), part), "restore")

    def test_a_directory_in_the_place_of_a_file(self):
        directory = self.run_small_tube("run")
        (directory / "summary.json").unlink()
        (directory / "summary.json").mkdir()
        self.assert_unreadable(directory / "summary.json", lambda: riesel.Run(directory).summary, "restore")

    def test_findings_that_are_none(self):
        directory = self.run_small_tube("run")
        summary = self.summary(directory)
        for findings in (None, [None], [{"value": 1.0}], [1]):
            summary["validity"]["findings"] = findings
            (directory / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
            self.assert_unreadable(directory / "summary.json", lambda: riesel.Run(directory).validity, "restore")

    def test_numbers_in_the_place_of_groups(self):
        directory = self.run_small_tube("run")
        for part in ("series", "profiles", "histograms", "provenance", "final"):
            with changed_behind_seal(directory / "run.h5") as file:
                del file[part]
                file[part] = 1.0
            self.assert_unreadable(directory / "run.h5", lambda: getattr(riesel.Run(directory), part), "restore")
        with changed_behind_seal(directory / "run.h5") as file:
            del file["series"]
            file["series"] = [1.0, 2.0]
        self.assert_unreadable(directory / "run.h5", lambda: riesel.Run(directory).series, "restore")

    def test_a_changed_bit_behind_the_seal(self):
        path = self.run_small_tube("run") / "run.h5"
        good = path.read_bytes()
        for place in (512, 512 + 97, len(good) // 2, len(good) - 1):
            bad = bytearray(good)
            bad[place] ^= 1
            path.write_bytes(bad)
            self.assert_unreadable(path, lambda: riesel.Run(path.parent).provenance, "restore")

    def test_a_pipe_in_the_place_of_a_file(self):
        directory = self.run_small_tube("run")
        for name, read in (("run.h5", lambda run: run.provenance), ("summary.json", lambda run: run.summary)):
            (directory / name).unlink()
            os.mkfifo(directory / name)
            self.assert_unreadable(directory / name, lambda read=read: read(riesel.Run(directory)), "remove it")

    def test_a_changed_bit_of_the_seal(self):
        path = self.run_small_tube("run") / "run.h5"
        good = path.read_bytes()
        for text in (b"riesel run", b"in all: ", b"CRC-32", b"behind the block: "):
            bad = bytearray(good)
            bad[good.index(text) + len(text) - 1] ^= 1
            path.write_bytes(bad)
            self.assert_unreadable(path, lambda: riesel.Run(path.parent).provenance, "restore")

    def test_seals_of_riesel_0_10_say_nothing_to_python(self):
        path = self.run_small_tube("run") / "run.h5"
        good = path.read_bytes()
        time = riesel.Run(path.parent).final.time
        line = re.compile(rb"CRC-32 .*\n")
        self.assertRegex(good[:512], line)
        path.write_bytes(line.sub(b"", good[:512]).ljust(512, b"\0") + good[512:])
        self.assertEqual(riesel.Run(path.parent).final.time, time)

    def test_a_summary_of_another_format(self):
        directory = self.run_small_tube("run")
        summary = self.summary(directory) | {"version": "0.3.9"}
        later = json.dumps(summary | {"format": 3})
        del summary["format"]
        for number, text in ((1, json.dumps(summary)), (3, later)):
            (directory / "summary.json").write_text(text, encoding="utf-8")
            self.assert_unreadable(
                directory / "summary.json", lambda: riesel.Run(directory).summary,
                "use the package of that riesel, or make the run again")
            with self.assertRaisesRegex(riesel.Unreadable,
                                        rf"format {number} of riesel 0\.3\.9, .* reads 2;"):
                riesel.Run(directory).estimate("mean_axial_velocity")

    def test_files_of_a_sweep(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        out = self.home / "out"
        sweep = riesel.Sweep(out)
        self.write("out/sweep.h5", "no HDF5")
        self.assert_unreadable(out / "sweep.h5", lambda: sweep.table, "make it with 'riesel collect")
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
        unset = json.loads(json.dumps(manifest).replace('"settings": {', '"settings": null, "x": {'))
        del manifest["points"][1]["branch"]
        for text in (json.dumps(manifest), "{}", "[]", '{"varied": 1}', '{"varied', json.dumps(unset),
                     "[" * 100_000):
            self.write("out/manifest.json", text)
            self.assert_unreadable(out / "manifest.json", lambda: riesel.Sweep(out),
                                   "run 'riesel sweep' with its sweep file")
