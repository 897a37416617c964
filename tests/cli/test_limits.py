"""Limits beyond which a run is stopped, or its user warned."""

import re
import shutil

import h5py

from riesel_command import BAD_INPUT, DONE, FAILED, CommandTest

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

    def post_mortem(self, out):
        file = h5py.File(self.home / out / "post_mortem.h5", "r")
        self.addCleanup(file.close)
        return file

    def assert_stopped(self, out, result, *words):
        """With the state of the moment that is told."""
        self.assertEqual(result.returncode, FAILED, result)
        for word in (*words, "t = ", f"(step {self.post_mortem(out).attrs['step']})", f"{out}/post_mortem.h5"):
            self.assertIn(word, result.stderr)
        self.assertFalse((self.home / out / "summary.json").exists())

    def test_within_its_limits_a_run_goes_on(self):
        result = self.tube("within", "limits.overlap=0.9", "limits.speed=50 m/s",
                           "limits.energy_error=10 %")
        self.assertEqual(result.returncode, DONE, result)

    def test_a_grain_too_fast_stops_it(self):
        result = self.tube("speed", "limits.speed=3.5 m/s")
        self.assert_stopped("speed", result, "limits.speed", "grain ", "m/s")

    def test_why_it_failed_is_told_even_if_its_state_cannot_be_kept(self):
        path = self.write("tube.yaml", TUBE)
        result = self.riesel_with_files_of_at_most(20_000, "run", path, "--set", "limits.speed=3.5 m/s")
        self.assertEqual(result.returncode, FAILED, result)
        (complaint,) = [line for line in result.stderr.splitlines() if line.startswith("riesel: ")]
        self.assertIn("the run failed: ", complaint)
        self.assertIn("the state of that moment could not be kept: ", result.stderr)

    def test_grains_too_fast_for_the_numbers_of_the_state_stop_it(self):
        """An eighth of the tube in a step; a few more, and they would seem slow again."""
        result = self.tube("fast", "gravity=1e5 m/s^2", "wall.surface=smooth", "start.random_velocity=0", "run.duration=0.1 s")
        self.assert_stopped("fast", result, "too fast for this tube and time step", "may help")
        self.assertRegex(result.stderr, r"grain \d+ moves at \S+ m/s at")

    def test_grains_too_heavy_for_exact_sums_stop_it(self):
        """Sums hold 7e10 J; beyond twice that they would wrap, and energies be negative."""
        heavy = ("grains.mass=1e8 kg", "contact.stiffness=2e17", "wall.surface=smooth", "gravity=200 m/s^2")
        self.assert_stopped("heavy", self.tube("heavy", *heavy), "energies or impulses add up to", "lighter grains help")

    def test_grains_too_heavy_from_the_start_are_refused(self):
        result = self.tube("heavier", "grains.mass=1e9 kg", "contact.stiffness=2e18")
        self.assertEqual(result.returncode, BAD_INPUT, result)
        self.assertIn("grains.mass: grains so heavy that their masses or energies", result.stderr)
        self.assertFalse((self.home / "heavier").exists())

    def test_a_grain_that_goes_through_a_wall_stops_it(self):
        result = self.tube("through", "contact.stiffness=20", "start.random_velocity=3 m/s")
        self.assert_stopped("through", result, "through a wall", "raise contact.stiffness")
        grain = int(re.search(r"grain (\d+)", result.stderr)[1])
        with h5py.File(self.home / "through" / "run.h5", "r") as file:
            x = dict(zip(file["final/id"][:], file["final/position"][:, 0]))[grain]
        self.assertFalse(0.0 <= x <= 10e-3, x)

    def test_limits_are_looked_at_between_rows_and_at_the_end(self):
        """Every 10,000 steps, as the only row before the end is the first; and at the end of a shorter run."""
        self.tube("whole", "run.duration=5 ms")
        whole = self.summary(self.home / "whole")["steps"]
        self.assertLess(whole, 10_000)
        for duration, step in (("60 ms", 10_000), ("5 ms", whole)):
            with self.subTest(duration=duration):
                result = self.tube(duration, "limits.overlap=0.02", "output.interval=1 s", f"run.duration={duration}")
                self.assert_stopped(duration, result, "limits.overlap is exceeded")
                self.assertEqual(self.post_mortem(duration).attrs["step"], step)
        result = self.tube("through", "contact.stiffness=20", "start.random_velocity=3 m/s", "output.interval=1 s",
                           "run.duration=1.4 ms")
        self.assert_stopped("through", result, "through a wall")

    def test_a_run_that_was_stopped_is_stopped_again_by_the_same_limit(self):
        self.tube("same", "limits.overlap=0.02", "run.duration=5 ms", "output.interval=5 ms")
        result = self.riesel("resume", "same/post_mortem.h5", "--threads", 1)
        self.assert_stopped("same", result, "limits.overlap is exceeded")

    def test_a_limit_that_is_given_in_a_resume_is_kept_though_it_stops_the_run_at_once(self):
        self.tube("given", "run.duration=5 ms")
        for options in (["--set", "run.duration=10 ms", "--set", "limits.overlap=0.02"], []):
            result = self.riesel("resume", "given", *options, "--threads", 1)
            self.assert_stopped("given", result, "limits.overlap is exceeded")

    def test_a_start_beyond_a_limit_is_told_and_can_go_on_without_it(self):
        result = self.tube("start", "limits.speed=2.5 m/s", "run.duration=1 ms")
        self.assert_stopped("start", result, "limits.speed", "t = 0 s",
                            "'riesel resume start/post_mortem.h5 --set limits.speed='")
        self.assert_refused(self.riesel("resume", "start"), "go on from start/post_mortem.h5")
        result = self.riesel("resume", "start/post_mortem.h5", "--set", "limits.speed=", "--threads", 1)
        self.assertEqual(result.returncode, DONE, result)

    def test_contacts_that_are_not_resolved_stop_it(self):
        """Grains that run through the wall grains, so fast that they touch them for a step or two."""
        result = self.tube("steps", "start.axial_velocity=30 m/s", "limits.steps_per_contact=5")
        self.assert_stopped("steps", result, "limits.steps_per_contact", "run.steps_per_collision")
        told = float(re.search(r"lasts about (\S+) steps", result.stderr)[1])
        self.assertLess(told, 5.0)

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

    def overlap_told(self, interval):
        """(m, part of a radius, where), as a run says that is stopped by its limit after this interval"""
        shutil.rmtree(self.home / "overlap", ignore_errors=True)
        result = self.tube("overlap", "limits.overlap=0.02", f"output.interval={interval}")
        self.assert_stopped("overlap", result, "limits.overlap", "contact.stiffness")
        told = re.search(r"an overlap of (\S+) m, (\S+) of the radius of the smallest body, ([^;]+) (since|from) t = ([^;]+) s;",
                         result.stderr)
        self.when = told[5]
        return float(told[1]), float(told[2]), told[3]

    def deepest_contact(self):
        """{name: value}, of those that last in the end"""
        contacts = self.post_mortem("overlap")["contacts"]
        deepest = contacts["max_overlap"][:].argmax()
        return {name: values[deepest].item() for name, values in contacts.items()}

    def test_an_overlap_too_deep_stops_it_and_the_contact_with_a_wall_is_named(self):
        overlap, ratio, where = self.overlap_told("0.2 ms")
        contact = self.deepest_contact()
        self.assertEqual(where, "between grain {grain} and grain {partner} of wall {wall}".format(**contact))
        self.assertAlmostEqual(overlap / contact["max_overlap"], 1.0, delta=0.005)
        radius = self.post_mortem("overlap")["walls/radius"][contact["wall"]]
        self.assertAlmostEqual(ratio * radius / overlap, 1.0, delta=0.01)

    def test_an_overlap_too_deep_stops_it_and_the_two_grains_are_named(self):
        overlap, ratio, where = self.overlap_told("0.12 ms")
        contact = self.deepest_contact()
        self.assertEqual(contact["wall"], -1)
        self.assertEqual(where, "between grain {grain} and grain {partner}".format(**contact))
        self.assertAlmostEqual(overlap / contact["max_overlap"], 1.0, delta=0.005)
        smallest = self.post_mortem("overlap")["grains/radius"][:].min()
        self.assertAlmostEqual(ratio * smallest / overlap, 1.0, delta=0.01)

    def test_an_overlap_in_a_contact_that_has_ended_is_told_with_its_grains_and_its_time(self):
        overlap, _, where = self.overlap_told("2 ms")
        self.assertGreater(overlap, 1.5 * self.deepest_contact()["max_overlap"])
        begin, end = map(float, self.when.split(" s to "))
        # Of rows so close that one falls into that contact, the same is told.
        self.assertEqual(self.overlap_told(f"{0.5 * (begin + end)} s")[2], where)

    def test_energy_from_nowhere_stops_it(self):
        # A damping so strong that a step overshoots.
        result = self.tube("energy", "limits.energy_error=1 %", "contact.restitution=",
                           "contact.law=power", "contact.stiffness=3e5", "contact.damping=1",
                           "contact.exponent_overlap=0")
        self.assert_stopped("energy", result, "limits.energy_error", "run.steps_per_collision")

    def test_a_force_that_is_not_finite_stops_it(self):
        """A damping by which the first touch kicks grains out of what velocities can be, or makes infinities."""
        for damping in ("1e30", "1e308"):
            with self.subTest(damping=damping):
                out = f"damping-{damping}"
                result = self.tube(out, "contact.restitution=", "contact.law=power", "contact.stiffness=3e5",
                                   f"contact.damping={damping}", "contact.exponent_overlap=0")
                self.assert_stopped(out, result, "is not finite", "a shorter time step may help")
                named = re.search(r"the force between grain (\d+) and grain (\d+) ", result.stderr)
                contacts = self.post_mortem(out)["contacts"]
                self.assertIn((int(named[1]), int(named[2]), -1),
                              zip(contacts["grain"], contacts["partner"], contacts["wall"]))

    def test_a_warning_is_given_once_and_the_run_goes_on(self):
        result = self.tube("warned", "limits.speed=3.5 m/s", "limits.action=warn")
        self.assertEqual(result.returncode, DONE, result)
        self.assertEqual(result.stderr.count("limits.speed is exceeded"), 1)
        unlimited = self.summary(self.unlimited())
        self.assertEqual(self.summary(self.home / "warned")["state_hash"], unlimited["state_hash"])
        self.assertEqual(unlimited["validity"]["findings"][-1]["verdict"], "valid")
        self.assertEqual(unlimited["validity"]["warnings"], [])

    def test_a_warning_stands_in_the_result_after_a_resume_too(self):
        self.tube("warned", "limits.speed=3.5 m/s", "limits.overlap=0.02", "limits.action=warn")
        before = self.summary(self.home / "warned")["validity"]
        self.assertEqual({warning.split()[0] for warning in before["warnings"]}, {"limits.overlap", "limits.speed"})
        result = self.riesel("resume", "warned", "--set", "run.duration=62 ms", "--threads", 1)
        self.assertEqual(result.returncode, DONE, result)
        self.assertNotIn("is exceeded", result.stderr)
        after = self.summary(self.home / "warned")["validity"]
        self.assertEqual(after["warnings"], before["warnings"])
        [exceeded] = [finding for finding in after["findings"] if finding["name"] == "limits_exceeded"]
        self.assertEqual((exceeded["value"], exceeded["verdict"]), (2, "suspect"))
        self.assert_done(self.riesel("report", "warned"))
        page = (self.home / "warned/report.html").read_text(encoding="utf-8")
        for warning in before["warnings"]:
            self.assertIn(f"<li>{warning}</li>", page)
        self.assertNotEqual(after["verdict"], "valid")
        self.assertIn("limits_exceeded", result.stdout)

    def unlimited(self):
        self.assertEqual(self.tube("unlimited").returncode, DONE)
        return self.home / "unlimited"

    def test_another_run_can_start_from_the_post_mortem(self):
        self.tube("speed", "limits.speed=3.5 m/s")
        later = self.tube("later", "start.axial_velocity=", "start.kind=continued",
                          f"start.from={self.home / 'speed' / 'post_mortem.h5'}",
                          "run.duration=1 ms")
        self.assertEqual(later.returncode, DONE, later)
