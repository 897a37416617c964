"""A start from a file of grains, and sizes from a file, through the command."""

from riesel_command import CommandTest

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

    def test_it_goes_on_by_resume_and_can_be_continued_by_another_run(self):
        short = self.run_to_end("here/tube.yaml", "short", "--set", "run.duration=2 ms")
        self.assert_done(self.riesel("resume", short, "--set", "run.duration=5 ms"))
        self.assertEqual(self.state_hash(short), self.state_hash(self.run_to_end("here/tube.yaml", "whole")))
        follower = self.run_to_end("here/tube.yaml", "next", "--set", "start.kind=continued",
                                   "--set", f"start.from={short}", "--set", "contact.restitution=0.8")
        self.assertEqual(self.summary(follower)["grains"], 143)

    def test_a_mistake_in_the_file_is_told_with_its_place_and_nothing_is_written(self):
        self.write("here/grains.csv", GRAINS + "2.1, 0.5, 0, 0, 1\n")
        result = self.riesel("run", "here/tube.yaml", "--out", "out")
        self.assert_refused(result, "grains.csv:145:1: x: overlaps the grain in line 2")
        self.assertFalse((self.home / "out").exists())

    def test_sizes_come_from_a_file(self):
        self.write("sizes.csv", "diameter (mm)\n0.8\n1.2\n")
        self.write("sieved.yaml", SETTINGS.replace("start: {kind: file, from: grains.csv}",
                                                   "grains: {size_distribution: file, sizes_from: sizes.csv}"))
        out = self.run_to_end("sieved.yaml", "out")
        self.assert_same_result(out, self.run_to_end(out / "effective.yaml", "again"))
