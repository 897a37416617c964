"""riesel check: what a settings file means, and warnings where they are due."""

import math

from riesel_command import FAILED, SHIPPED, SMALL_TUBE, CommandTest, plain_number

# Stiff enough for its velocities: nothing to warn of.
MILD_TUBE = """\
scenario: periodic_tube
contact: {stiffness: 200 kN/m, restitution: 0.9}
grains: {area_fraction: 0.3, polydispersity: 0}
tube: {width: 10 mm, length: 10 mm}
run: {duration: 2 ms}
"""


def t_col(stiffness, damping, reduced_mass):
    """s, eq. (4) of the paper."""
    return math.pi / math.sqrt(stiffness / reduced_mass - damping ** 2 / 4)


class Check(CommandTest):

    def check(self, text, *options):
        self.write("settings.yaml", text)
        result = self.riesel("check", "settings.yaml", "--threads", 1, *options)
        self.assert_done(result)
        return result.stdout

    def assert_contact(self, text, pair, collision_time, restitution):
        self.assertAlmostEqual(
            plain_number(text, rf"{pair} +t_col = (\S+) s") / collision_time, 1.0, delta=1e-3)
        self.assertAlmostEqual(plain_number(text, rf"{pair} +t_col = .* e_N = (\S+)"), restitution,
                               delta=1e-4)

    def test_a_tube_is_told_in_its_numbers(self):
        text = self.check(MILD_TUBE)
        gamma = -2 * math.log(0.9) * math.sqrt(2e11 / (math.pi ** 2 + math.log(0.9) ** 2))
        wall, pair = t_col(2e5, gamma, 1e-6), t_col(2e5, gamma, 0.5e-6)
        self.assert_contact(text, "grain and wall", wall, 0.9)
        self.assert_contact(text, "grain and grain", pair, math.exp(-gamma * pair / 2))
        self.assertAlmostEqual(plain_number(text, r"time step +(\S+) s") * 50 / pair, 1.0,
                               delta=1e-3)
        self.assertEqual(plain_number(text, r"\n  grains +(\d+),"), 38)
        self.assertEqual(plain_number(text, r"wall grains +(\d+) per wall"), 8)
        steps = plain_number(text, r"steps +(\d+)")
        self.assertAlmostEqual(steps * pair / 50, 2e-3, delta=1e-5)
        self.assertGreater(plain_number(text, r"v_crit +(\S+) m/s"), 1.0)
        self.assertGreater(plain_number(text, r"expected time +(\S+) s on 1 thread \("), 0.0)
        self.assertGreater(plain_number(text, r"memory +about (\d+) MB"), 0)
        self.assertNotIn("warning", text)

    def test_other_laws_have_their_restitution_told_by_an_impact(self):
        hertz = MILD_TUBE.replace("restitution: 0.9", "law: hertz, damping: 3.3, impact_speed: 1 m/s")
        text = self.check(hertz, "--set", "contact.stiffness=5e5")
        fast, slow = (plain_number(text, rf"grain and wall +t_col = .* {words}")
                      for words in (r"e_N = ([\d.]+);", r"e_N = \S+ (\S+) at a tenth of that speed"))
        self.assertTrue(0.5 < fast < slow < 1.0, text)
        text = self.check(hertz, "--set", "contact.stiffness=5e5", "--set", "contact.damping=3000")
        self.assertIn("warning: grain and wall: too much damping, no rebound at", text)

    def test_a_time_step_chosen_for_slower_impacts_is_told(self):
        hertz = MILD_TUBE.replace("restitution: 0.9", "law: hertz, damping: 3.3, impact_speed: SPEED")
        for speed, told in (("1 m/s", False), ("1 mm/s", True)):
            text = self.check(hertz.replace("SPEED", speed), "--set", "contact.stiffness=5e5")
            self.assertEqual("warning: at " in text and "raise contact.impact_speed" in text, told, text)
            t_col = plain_number(text, r"grain and grain +t_col = (\S+) s")
            steps = t_col / plain_number(text, r"time step +(\S+) s")
            if told:
                self.assertAlmostEqual(plain_number(text, r"contacts last only (\S+) steps") / steps, 1.0, delta=0.1)
            self.assertEqual(steps < 20, told)

    def test_the_restitution_is_that_of_contacts_that_may_not_pull(self):
        text = self.check(MILD_TUBE, "--set", "contact.attraction=clip")
        self.assertEqual(plain_number(text, r"grain and wall +t_col = .* e_N = (\S+)"), 0.9)
        # two grains: the same damping, twice the frequency squared; the force vanishes at 2 arctan(omega / beta)
        beta_per_omega = 0.0342853  # at the wall, from 2 q arctan(1/q) = -ln 0.9
        beta, omega = beta_per_omega, 1.0
        pair = math.sqrt(2 * (omega ** 2 + beta ** 2) - beta ** 2)
        self.assertAlmostEqual(plain_number(text, r"grain and grain +t_col = .* e_N = (\S+)"),
                               math.exp(-2 * beta / pair * math.atan2(pair, beta)), delta=1e-4)

    def test_a_tangential_spring_is_told_by_its_half_period(self):
        """Of two discs, whose turning leaves a third of the inertia."""
        text = self.check(MILD_TUBE, "--set", "contact.slip=spring", "--set",
                          "contact.slip_stiffness=2e7 N/m", "--set", "grains.rotation=disc")
        half_period = math.pi * math.sqrt(0.5e-6 / 3 / 2e7)
        told = plain_number(text, r"tangential spring +half a period = (\S+) s")
        self.assertAlmostEqual(told / half_period, 1.0, delta=1e-3)
        self.assertAlmostEqual(plain_number(text, r"time step +(\S+) s") * 50 / told, 1.0, delta=1e-3)
        self.assertNotIn("tangential spring", self.check(MILD_TUBE))

    def test_impacts_are_told_in_their_numbers(self):
        for name, impacts in {"single_wall_grain": 60, "wall_array": 1800}.items():
            with self.subTest(name):
                text = self.check((SHIPPED / f"{name}.yaml").read_text(encoding="utf-8"))
                self.assert_contact(text, "grain and wall", t_col(2000, 1e4, 1e-6), 0.7023)
                self.assertEqual(plain_number(text, r"impacts +(\d+) in"), impacts)
                self.assertAlmostEqual(plain_number(text, r"time step +(\S+) s"), 1.414e-6,
                                       delta=1e-9)
                self.assertGreater(plain_number(text, r"v_crit +(\S+) m/s"), 1.0)

    def test_the_steps_told_are_the_steps_done(self):
        text = self.check(SMALL_TUBE)
        out = self.run_to_end("settings.yaml", "out")
        self.assertEqual(plain_number(text, r"steps +(\d+)"), self.summary(out)["steps"])
        self.assertEqual(plain_number(text, r"\n  grains +(\d+),"), self.summary(out)["grains"])

    def test_every_shipped_file_is_accepted(self):
        for file in SHIPPED.glob("*.yaml"):
            with self.subTest(file.name):
                text = self.check(file.read_text(encoding="utf-8"))
                self.assertIn(f"settings.yaml: {file.stem}\n", text)

    def test_nothing_is_written(self):
        self.check(MILD_TUBE)
        self.assertEqual([path.name for path in self.home.iterdir()], ["settings.yaml"])

    def test_numbers_are_numbers_even_in_odd_cases(self):
        for name, override in {"one grain": "grains.area_fraction=0.001",
                               "at rest": "start.random_velocity=0",
                               "sticky": "contact.restitution=1e-300",
                               "no gravity": "gravity=0"}.items():
            with self.subTest(name):
                self.assertNotRegex(self.check(MILD_TUBE, "--set", override), r"\b(nan|inf)\b")

    # --- warnings ---

    def assert_warned(self, text, *mentions):
        """One of the warnings mentions all of that."""
        warnings = [line for line in text.splitlines() if line.startswith("  warning: ")]
        about_that = [warning for warning in warnings
                      if all(mention in warning for mention in mentions)]
        self.assertEqual(len(about_that), 1, text)

    def test_of_soft_grains_with_the_factor_that_helps(self):
        """From the overlap on at which the verdict on a run says `suspect`."""
        linear = MILD_TUBE.replace("200 kN/m", "200")
        hertz = MILD_TUBE.replace("200 kN/m", "1e4").replace("restitution: 0.9", "law: hertz, damping: 0")
        for tube, stiffness in ((linear, "200"), (hertz, "1e4")):
            with self.subTest(stiffness):
                text = self.check(tube)
                self.assert_warned(text, "overlaps over 0.2 of the radius", "contact.stiffness")
                factor = plain_number(text, r"by a factor (\S+)")
                self.assertGreater(factor, 3.0)
                for part, is_enough in ((0.9, False), (1.0, True)):
                    text = self.check(tube.replace(f"stiffness: {stiffness}",
                                                   f"stiffness: {part * factor * float(stiffness)}"))
                    self.assertEqual("overlaps over" not in text, is_enough)

    def test_overlaps_are_relative_to_the_smallest_grain(self):
        settings = MILD_TUBE.replace("{area_fraction: 0.3, polydispersity: 0}", "{mass: 1 mg}") + (
            "start: {kind: file, from: grains.csv}\nwall: {surface: smooth}\n")
        ratios = []
        for diameters in ((1.0, 1.0), (0.5, 1.5)):
            self.write("grains.csv", "x (mm),y (mm),vx (m/s),vy (m/s),diameter (mm),mass (mg)\n"
                                     "3,3,1,0,%g,1\n7,7,-1,0,%g,1\n" % diameters)
            ratios.append(plain_number(self.check(settings), r"overlap +up to (\S+) of the radius of the smallest body"))
        self.assertAlmostEqual(ratios[1] / ratios[0], 2.0, delta=0.05)

    def test_of_more_rows_than_anybody_reads(self):
        """And with the interval that the warning tells there is none."""
        many = ["--set", "run.duration=10 s", "--set", "output.interval=2 us"]
        text = self.check(MILD_TUBE, *many)
        self.assert_warned(text, "output.interval")
        self.assertAlmostEqual(plain_number(text, r"series +(\S+) rows"), 5e6, delta=1e6)
        interval = plain_number(text, r"longer, (\S+) s for")
        self.assertNotIn("output.interval", self.check(MILD_TUBE, *many, "--set", f"output.interval={interval} s"))

    def test_of_few_steps_per_collision(self):
        self.assert_warned(self.check(MILD_TUBE, "--set", "run.steps_per_collision=10"),
                           "10 steps per collision", "50")

    def test_of_damping_of_the_slip_that_the_step_does_not_follow(self):
        """gamma_t dt above 1, or 1/3 of discs; more steps mend it as the warning says."""
        dt = plain_number(self.check(MILD_TUBE), r"time step +(\S+) s")
        for rotation, limit in (("none", 1.0), ("disc", 1.0 / 3.0)):
            options = ["--set", "contact.slip=viscous", "--set", f"grains.rotation={rotation}"]
            for factor, is_due in ((0.95, False), (1.05, True)):
                damping = f"contact.slip_damping={factor * limit / dt} 1/s"
                text = self.check(MILD_TUBE, *options, "--set", damping)
                self.assertEqual("slip_damping is too strong" in text, is_due, text)
            needed = plain_number(text, r"steps_per_collision above (\S+)")
            self.assertAlmostEqual(needed, 50 * 1.05, delta=0.1)

    def test_sliding_walls_do_not_change_the_velocities_across(self):
        text = (SHIPPED / "shear_cell.yaml").read_text(encoding="utf-8")
        slow, fast = (plain_number(self.check(text, "--set", "start.random_velocity=0.1 m/s", "--set",
                                              f"cell.velocity={velocity} m/s"), r"v_crit +(\S+) m/s")
                      for velocity in (0, 30))
        self.assertEqual(slow, fast)

    def test_of_velocities_above_the_critical_one(self):
        critical = plain_number(self.check(MILD_TUBE), r"v_crit +(\S+) m/s")
        for factor, is_due in ((0.9, False), (1.1, True)):
            text = self.check(MILD_TUBE, "--set", f"start.axial_velocity={factor * critical}")
            self.assertEqual("brake failure" in text, is_due, text)
        self.assert_warned(text, "v_crit", "brake failure")

    def test_grains_in_lockstep_are_above_any_critical_velocity(self):
        text = self.check(MILD_TUBE, "--set", "start.random_velocity=0", "--set", "start.axial_velocity=20")
        self.assert_warned(text, "the same velocity", "start.random_velocity")

    def test_what_moves_across_together_meets_a_wall(self):
        self.write("grains.csv", "x (mm),y (mm),vx (m/s),vy (m/s),diameter (mm)\n3,3,4,5,1\n6,6,4,5,1\n")
        text = self.check(MILD_TUBE, "--set", "start.kind=file", "--set", "start.from=grains.csv",
                          "--set", "grains.area_fraction=", "--set", "grains.polydispersity=", "--set", "contact.stiffness=2000")
        self.assert_warned(text, "overlaps over", "raise contact.stiffness")
        self.assertNotIn("the same velocity", text)

    def test_of_grains_that_fly_out_of_a_chute(self):
        chute = "{scenario: inclined_chute, contact: {stiffness: 20 kN/m, restitution: 0.8}, run: {duration: 0.2 s}}\n"
        self.assertNotIn("warning", self.check(chute))
        self.assert_warned(self.check(chute, "--set", "start.random_velocity=2 m/s"), "may rise to", "chute.height")

    def test_of_limits_that_the_run_would_be_beyond_at_once(self):
        for limit, is_due in (("limits.speed=0.1 m/s", True), ("limits.speed=100 m/s", False),
                              ("limits.steps_per_contact=51", True), ("limits.steps_per_contact=49", False)):
            text = self.check(MILD_TUBE, "--set", limit)
            self.assertEqual(f"warning: {limit.partition('=')[0]} is " in text, is_due, text)

    def test_of_grains_that_fit_between_the_wall_grains(self):
        """Eight of 0.66 mm in 10 mm leave 0.59 mm."""
        for diameter, is_due in (("0.62 mm", False), ("0.56 mm", True)):
            text = self.check(MILD_TUBE, "--set", f"grains.diameter={diameter}",
                              "--set", "grains.polydispersity=0", "--set", "wall.spacing=1.2 mm")
            self.assertEqual("fit between the wall grains" in text, is_due, text)
        self.assert_warned(text, "wall.spacing")

    def test_a_run_that_loses_grains_between_wall_grains_tells_so(self):
        self.write("open.yaml", MILD_TUBE)
        result = self.riesel("run", "open.yaml", "--out", "out", "--set", "wall.spacing=5 mm",
                             "--set", "run.duration=1 s")
        self.assertEqual(result.returncode, FAILED, result)
        self.assertIn("fit between the wall grains", result.stderr)
        self.assertIn("choose wall.spacing below", result.stderr)

    def test_of_a_series_of_few_rows(self):
        self.assert_warned(self.check(MILD_TUBE, "--set", "output.interval=1 s"), "in the series", "output.interval")

    def test_at_rest_no_velocity_is_critical(self):
        text = self.check(MILD_TUBE, "--set", "start.axial_velocity=1 mm/s", "--set", "start.random_velocity=0")
        self.assertNotIn("v_crit", text)

    def test_of_a_file_it_tells_of_its_grains(self):
        """400 times the mass: contacts last 20 times as long."""
        heavy = "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm), mass (mg)\n3, 3, 1, 0, 1, 400\n5, 5, -1, 0, 1, 400\n"
        self.write("heavy.csv", heavy)
        elastic = MILD_TUBE.replace("restitution: 0.9", "damping: 0 1/s")
        of_heavy = elastic.replace("grains: {area_fraction: 0.3, polydispersity: 0}",
                                   "start: {kind: file, from: heavy.csv}")
        light, of_file = (plain_number(self.check(text), r"grain and grain +t_col = (\S+) s")
                          for text in (elastic, of_heavy))
        self.assertAlmostEqual(of_file / light, 20.0, delta=0.5)

    def test_of_grains_so_soft_that_they_are_lost_at_once(self):
        """A run of them fails; the check tells so and does not."""
        text = self.check(SMALL_TUBE.replace("2000 N/m", "2 N/m"))
        self.assert_warned(text, "overlaps over 0.2", "contact.stiffness")
        self.assertGreater(plain_number(text, r"expected time +(\S+) s on 1 thread \("), 0.0)
        failed = self.riesel("run", "settings.yaml", "--out", "out")
        self.assertEqual(failed.returncode, FAILED, failed)
