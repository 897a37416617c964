"""A start from a file of grains, and sizes from a file, through the command."""

import os
import shutil

import h5py

from riesel_command import CommandTest, plain_number

SETTINGS = """
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 20 mm, length: 20 mm}
start: {kind: file, from: grains.csv}
run: {duration: 5 ms}
"""

GRAINS = "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n" + "".join(
    f"{2 + 1.5 * i}, {0.5 + 1.5 * j}, {(i * 7 + j * 3) % 5 - 2}, {(i + 2 * j) % 3 - 1}, 1\n"
    for i in range(11) for j in range(13))


class GrainFile(CommandTest):

    def setUp(self):
        super().setUp()
        (self.home / "here").mkdir()
        self.write("here/grains.csv", GRAINS)
        self.settings = self.write("here/tube.yaml", SETTINGS)

    def test_a_run_from_a_file_comes_again_from_its_effective_settings(self):
        out = self.run_to_end("here/tube.yaml", "out")
        self.assertEqual(self.summary(out)["grains"], 143)
        self.assert_same_result(out, self.run_to_end(out / "effective.yaml", "again"))

    def test_a_path_is_relative_to_what_gives_it(self):
        """To the settings file; from the command line to where the command is given."""
        self.write("grains.csv", GRAINS.splitlines()[0] + "\n5, 5, 0, 0, 1\n")
        for i, (overrides, grains) in enumerate((((), 143), (("--set", "start.from=grains.csv"), 1),
                                                 (("--set", "start.from=here/grains.csv"), 143))):
            with self.subTest(overrides):
                out = self.run_to_end("here/tube.yaml", f"out{i}", *overrides)
                self.assertEqual(self.summary(out)["grains"], grains)

    def test_it_goes_on_by_resume_and_can_be_continued_by_another_run(self):
        short = self.run_to_end("here/tube.yaml", "short", "--set", "run.duration=2 ms")
        self.assert_done(self.riesel("resume", short, "--set", "run.duration=5 ms"))
        self.assertEqual(self.state_hash(short), self.state_hash(self.run_to_end("here/tube.yaml", "whole")))
        follower = self.run_to_end("here/tube.yaml", "next", "--set", "start.kind=continued",
                                   "--set", f"start.from={short}", "--set", "contact.restitution=0.8")
        self.assertEqual(self.summary(follower)["grains"], 143)

    def test_check_tells_what_the_sizes_of_the_file_mean(self):
        self.write("here/grains.csv", GRAINS.replace(", 1\n", ", 0.5\n", 100))
        text = self.riesel("check", "here/tube.yaml").stdout
        light, heavy = (plain_number(text, rf"{pair} +t_col = (\S+) s")
                        for pair in ("two lightest grains", "two heaviest grains"))
        self.assertAlmostEqual((heavy / light) ** 2, 4.0, delta=0.05)

    def test_a_mistake_in_the_file_is_told_with_its_place_and_nothing_is_written(self):
        self.write("here/grains.csv", GRAINS + "2.1, 0.5, 0, 0, 1\n")
        result = self.riesel("run", "here/tube.yaml", "--out", "out")
        self.assert_refused(result, "grains.csv:145:1: x: overlaps the grain in line 2")
        self.assertFalse((self.home / "out").exists())

    def test_a_path_that_cannot_be_recorded_is_refused(self):
        self.home = self.home / os.fsdecode(b"latin-\xe9")
        self.home.mkdir()
        self.write("grains.csv", GRAINS)
        self.write("tube.yaml", SETTINGS)
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "start.from", "is not UTF-8")
        self.assertFalse((self.home / "out").exists())

    def test_sizes_come_from_a_file(self):
        self.write("sizes.csv", "diameter (mm)\n0.8\n1.2\n")
        self.write("sieved.yaml", SETTINGS.replace("start: {kind: file, from: grains.csv}",
                                                   "grains: {size_distribution: file, sizes_from: sizes.csv}"))
        out = self.run_to_end("sieved.yaml", "out")
        self.assert_same_result(out, self.run_to_end(out / "effective.yaml", "again"))

    def check(self, grains):
        self.write("here/grains.csv", grains)
        return self.riesel("check", "here/tube.yaml")

    def test_small_grains_far_apart_are_as_good_as_others(self):
        self.assert_done(self.check("x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n"
                                    "5, 5, 0, 1, 0.001\n6, 5, 0, 1, 0.001\n"))

    def test_grains_that_positions_cannot_tell_apart_are_refused(self):
        self.assert_refused(self.check("x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n5, 5, 0, 1, 1e-300\n"),
                            "grains.csv:2", "diameter", "at least")

    def test_a_run_from_other_grains_is_another_run(self):
        """With the same settings, letter by letter."""
        def number(out):
            with h5py.File(out / "run.h5") as file:
                return file["provenance/run"][()]
        mine = self.run_to_end("here/tube.yaml", "mine")
        self.assertEqual(number(self.run_to_end("here/tube.yaml", "again")), number(mine))
        self.write("here/grains.csv", GRAINS.replace("2.0, 0.5, -2", "2.0, 0.5, -1"))
        other = self.run_to_end("here/tube.yaml", "other")
        self.assertNotEqual(number(other), number(mine))
        shutil.copy(other / "run.h5", mine / "run.h5")
        self.assert_refused(self.riesel("resume", "mine", "--set", "run.duration=6 ms"), "it belongs to another run")

    def test_walls_of_too_many_grains_are_refused_before_these_are_looked_at(self):
        self.write("here/tube.yaml", SETTINGS + "wall: {spacing: 1e-12 m}\n")
        self.assert_refused(self.check(GRAINS), "wall.spacing", "too close together")

    def test_what_moves_or_turns_too_fast_for_a_step_is_refused(self):
        header = "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm), spin (1/s)\n"
        self.settings = self.write("here/tube.yaml", SETTINGS + "grains: {rotation: disc}\n")
        self.assert_done(self.check(header + "5, 5, 0, 1, 1, 1e5\n"))
        self.assert_refused(self.check(header + "5, 5, 0, 1, 1, 1e7\n"), "start.from:", "spins too fast")
        self.assert_refused(self.check(header + "5, 5, 0, 1e6, 1, 0\n"), "start.from:", "too fast")

    def test_a_run_of_grains_smaller_than_the_usual_ones_can_be_continued(self):
        """In a tube that is too short for the latter."""
        small = SETTINGS.replace("length: 20 mm", "length: 3 mm").replace("width: 20 mm", "width: 3 mm")
        self.write("here/tube.yaml", small)
        self.write("here/grains.csv", "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n"
                                      "1, 1, 0, 1, 0.2\n2, 2, 0, 1, 0.2\n")
        first = self.run_to_end("here/tube.yaml", "first")
        follower = self.run_to_end("here/tube.yaml", "next", "--set", "start.kind=continued",
                                   "--set", f"start.from={first}")
        self.assertEqual(self.summary(follower)["grains"], 2)
