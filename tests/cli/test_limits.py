"""Limits beyond which a run is stopped, or its user warned."""

import shutil

from riesel_command import DONE, FAILED, CommandTest

TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 10 mm, length: 12 mm}
start: {axial_velocity: 3 m/s}
run: {duration: 60 ms}
output: {interval: 0.2 ms}
"""


class Limits(CommandTest):

    def tube(self, out, *options):
        path = self.write("tube.yaml", TUBE)
        return self.riesel("run", path, "--out", out, "--threads", 1,
                           *(part for option in options for part in ("--set", option)))

    def assert_stopped(self, out, result, *words):
        self.assertEqual(result.returncode, FAILED, result)
        for word in (*words, "t = ", "(step ", "post_mortem.h5"):
            self.assertIn(word, result.stderr)
        self.assertFalse((self.home / out / "summary.json").exists())

    def test_within_its_limits_a_run_goes_on(self):
        result = self.tube("within", "limits.overlap=0.9", "limits.speed=50 m/s",
                           "limits.energy_error=10 %")
        self.assertEqual(result.returncode, DONE, result)

    def test_a_grain_too_fast_stops_it(self):
        result = self.tube("speed", "limits.speed=3.5 m/s")
        self.assert_stopped("speed", result, "limits.speed", "grain ", "m/s")

    def test_grains_too_fast_for_the_numbers_of_the_state_stop_it(self):
        """An eighth of the tube in a step; a few more, and they would seem slow again."""
        result = self.tube("fast", "gravity=8e6 m/s^2", "wall.spacing=4 mm")
        self.assert_stopped("fast", result, "too fast for this tube and time step")

    def test_a_run_that_was_stopped_goes_on_with_another_limit_to_the_same_end(self):
        result = self.tube("again", "limits.overlap=0.02", "output.checkpoint_interval=1e-6 s")
        self.assert_stopped("again", result, "limits.overlap")
        whole = self.unlimited()
        shutil.copytree(self.home / "again", self.home / "later")
        for checkpoint in ("again", "later/post_mortem.h5"):
            with self.subTest(checkpoint):
                result = self.riesel("resume", checkpoint, "--set", "limits=", "--threads", 1)
                self.assertEqual(result.returncode, DONE, result)
                self.assert_same_result(whole, self.home / checkpoint.split("/")[0])

    def test_an_overlap_too_deep_stops_it(self):
        result = self.tube("overlap", "limits.overlap=0.02")
        self.assert_stopped("overlap", result, "limits.overlap", "contact.stiffness")

    def test_energy_from_nowhere_stops_it(self):
        # A damping so strong that a step overshoots.
        result = self.tube("energy", "limits.energy_error=1 %", "contact.restitution=",
                           "contact.law=power", "contact.stiffness=3e5", "contact.damping=1",
                           "contact.exponent_overlap=0")
        self.assert_stopped("energy", result, "limits.energy_error", "run.steps_per_collision")

    def test_a_warning_is_given_once_and_the_run_goes_on(self):
        result = self.tube("warned", "limits.speed=3.5 m/s", "limits.action=warn")
        self.assertEqual(result.returncode, DONE, result)
        self.assertEqual(result.stderr.count("limits.speed is exceeded"), 1)
        self.assertEqual(self.summary(self.home / "warned")["state_hash"],
                         self.summary(self.unlimited())["state_hash"])

    def unlimited(self):
        self.assertEqual(self.tube("unlimited").returncode, DONE)
        return self.home / "unlimited"

    def test_another_run_can_start_from_the_post_mortem(self):
        self.tube("speed", "limits.speed=3.5 m/s")
        later = self.tube("later", "start.axial_velocity=", "start.kind=continued",
                          f"start.from={self.home / 'speed' / 'post_mortem.h5'}",
                          "run.duration=1 ms")
        self.assertEqual(later.returncode, DONE, later)


del CommandTest
