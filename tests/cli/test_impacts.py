"""The shipped impact scenarios from end to end."""

import json
import math

import h5py

from riesel_command import SHIPPED, CommandTest

COMMON_NAMES = {"format", "scenario", "version", "commit", "grains", "steps", "state_hash", "performance"}
PERFORMANCE_NAMES = {"wall_seconds", "particle_steps_per_second", "threads"}
POINT_NAMES = {"v_x", "v_y", "dv_x", "dv_y", "contacts", "contact_time", "max_overlap", "passed",
               "stuck", "cut_short", "brake_failure_fraction", "verdict", "cause"}
VERDICTS = ["valid", "suspect", "unphysical"]


class Impacts:
    """Of one scenario: the classes below say which."""

    def run_shipped(self, out, threads=1):
        return self.run_to_end(SHIPPED / f"{self.scenario}.yaml", out, threads=threads)

    def test_the_summary_has_the_names_of_the_contract_and_finite_values(self):
        summary = self.summary(self.run_shipped("out"))
        self.assertEqual(set(summary), COMMON_NAMES | {"curve", "lines"})
        self.assertEqual(set(summary["performance"]), PERFORMANCE_NAMES)
        for point in summary["curve"]:
            self.assertEqual(set(point), POINT_NAMES)
        self.assert_finite(summary)
        self.assertEqual(summary["scenario"], self.scenario)
        self.assertGreater(summary["steps"], 0)

    def test_a_line_is_what_its_points_come_to(self):
        summary = self.summary(self.run_shipped("out"))
        self.assertEqual([line["v_x"] for line in summary["lines"]], self.normal_velocities)
        for line in summary["lines"]:
            points = [point for point in summary["curve"] if point["v_x"] == line["v_x"]]
            braking = [point for point in points if not (point["brake_failure_fraction"] or 0) >= 0.5]
            best = max(braking, key=lambda point: point["dv_y"])
            self.assertEqual((line["largest_dv_y"], line["largest_at"]), (best["dv_y"], best["v_y"]))
            for column, level, name in (("brake_failure_fraction", 0.5, "brake_fails"), ("contacts", 2.0, "two_contacts")):
                crossing, within = line[f"{name}_at"], line[f"{name}_within"]
                above = [point[column] is not None and point[column] >= level for point in points]
                if not above[-1]:
                    self.assertEqual((crossing, within), (None, None), column)
                    continue
                first = len(above) - above[::-1].index(False)  # of those that are above for good
                low, high = points[first - 1], points[first]
                self.assertEqual(within, high["v_y"] - low["v_y"])
                part = (crossing - low["v_y"]) / (high["v_y"] - low["v_y"])
                self.assertAlmostEqual(low[column] + part * (high[column] - low[column]), level, places=9)

    def test_the_curve_is_in_the_order_of_the_velocities(self):
        curve = self.summary(self.run_shipped("out"))["curve"]
        velocities = [(point["v_x"], point["v_y"]) for point in curve]
        self.assertEqual(velocities, sorted(velocities))
        self.assertEqual(sorted({v_x for v_x, _ in velocities}), self.normal_velocities)
        self.assertEqual(len(velocities), 60 * len(self.normal_velocities))
        for v_x in self.normal_velocities:
            of_this = [v_y for x, v_y in velocities if x == v_x]
            self.assertEqual((of_this[0], of_this[-1]), (0.1, 40.0))

    def test_the_run_file_holds_the_same_curve_with_units(self):
        out = self.run_shipped("out")
        curve = self.summary(out)["curve"]
        with h5py.File(out / "run.h5", "r") as file:
            self.assertEqual(set(file["curve"]), POINT_NAMES - {"cause"})
            for name, column in file["curve"].items():
                of_curve = [point[name] for point in curve]
                if name == "verdict":
                    of_curve = [VERDICTS.index(verdict) for verdict in of_curve]
                self.assertEqual(list(column), of_curve, name)
                self.assertIn("unit", column.attrs)

    def test_the_result_depends_neither_on_threads_nor_on_the_way_the_settings_came(self):
        one = self.run_shipped("one")
        for threads in (2, 3, 4):
            self.assert_same_result(one, self.run_shipped(f"threads-{threads}", threads))
        again = self.run_to_end(one / "effective.yaml", "again")
        self.assert_same_result(one, again)
        self.assertEqual((one / "effective.yaml").read_bytes(),
                         (again / "effective.yaml").read_bytes())


class Lines(CommandTest):

    def lines(self, velocities):
        out = self.run_to_end(SHIPPED / "wall_array.yaml", f"from-{velocities[0]}", "--set", "impact.normal_velocity=0.1",
                              "--set", f"impact.axial_velocity={velocities}")
        line, = self.summary(out)["lines"]
        return line

    def test_what_the_curve_does_not_show_is_null(self):
        """Where the brake has failed from the beginning, and where it never does."""
        failed = self.lines([10, 20, 30])
        self.assertEqual([failed[name] for name in ("largest_dv_y", "largest_at", "brake_fails_at")], [None] * 3)
        works = self.lines([0.5, 1, 2])
        self.assertEqual((works["brake_fails_at"], works["two_contacts_at"]), (None, None))
        self.assertIn(works["largest_at"], (0.5, 1, 2))


class SingleWallGrain(Impacts, CommandTest):
    scenario = "single_wall_grain"
    normal_velocities = [0.0]

    def test_the_brake_fails_above_v_crit(self):
        """chord / t_col in closed form; the border was found within 3 % of it at this e_N
        (docs/validity.md)."""
        chord = 2.0 * math.sqrt(0.83e-3**2 - 0.82e-3**2)
        t_col = math.pi / math.sqrt(2000.0 / 1e-6 - 1e4**2 / 4.0)
        for point in self.summary(self.run_shipped("out"))["curve"]:
            fails = point["v_y"] > 0.97 * chord / t_col
            if abs(point["v_y"] * t_col / chord - 0.97) > 0.03:
                self.assertEqual(point["verdict"], "unphysical" if fails else "valid", point)
                self.assertEqual(point["brake_failure_fraction"], 1.0 if fails else 0.0, point)
                self.assertEqual(point["cut_short"], 1.0 if fails else 0.0, point)

    def test_stiff_contacts_do_not_fail_and_deep_ones_are_told(self):
        one_speed = ("--set", "impact.axial_velocity=[10]")
        for stiffness, verdict in ((2e7, "valid"), (2000.0, "unphysical")):
            out = self.run_to_end(SHIPPED / "single_wall_grain.yaml", f"k{stiffness:g}",
                                  "--set", f"contact.stiffness={stiffness}", *one_speed)
            self.assertEqual([p["verdict"] for p in self.summary(out)["curve"]], [verdict])

    def test_a_damping_that_the_time_step_does_not_resolve_is_told(self):
        """Of the power law: it does not vanish where a contact begins. The loss of the brake is off, by a half or so, long before
        its energy gets more."""
        losses = {}
        for damping, steps, verdict in ((0.2, 20, "suspect"), (0.2, 50, "valid"), (0.2, 200, "valid"), (1, 50, "unphysical")):
            with self.subTest(damping=damping, steps=steps):
                self.write("power.yaml", "scenario: single_wall_grain\n"
                                         f"contact: {{law: power, stiffness: 3e5, damping: {damping}, exponent_overlap: 0}}\n"
                                         f"impact: {{axial_velocity: [0.3]}}\nrun: {{steps_per_collision: {steps}}}\n")
                point, = self.summary(self.run_to_end("power.yaml", f"{damping}-{steps}"))["curve"]
                self.assertEqual(point["verdict"], verdict)
                self.assertEqual(point["cause"], "" if verdict == "valid" else "energy_error_ratio")
                losses[damping, steps] = point["dv_y"]
        self.assertAlmostEqual(losses[0.2, 50] / losses[0.2, 200], 1.0, delta=0.01)
        self.assertGreater(abs(losses[0.2, 20] / losses[0.2, 200] - 1.0), 0.3)

    def test_the_screen_tells_where_it_fails(self):
        result = self.riesel("run", SHIPPED / "single_wall_grain.yaml", "--out", "out")
        curve = self.summary(self.home / "out")["curve"]
        for verdict in ("suspect", "unphysical"):
            bad = [point["v_y"] for point in curve if point["verdict"] == verdict]
            if verdict == "suspect" and not bad:
                continue
            self.assertRegex(result.stdout, rf"(?m)^  validity  .*\b{len(bad)} {verdict}\b")
            self.assertRegex(result.stdout,
                             rf"(?m)^  {verdict} +brake_failure_fraction above [^;\n]*; raise contact.stiffness\n"
                             rf" +at v_x = 0 m/s {len(bad)} of 60 points, the first at v_y = {min(bad):.4g} m/s$")

    def test_where_nothing_brakes_is_told(self):
        """Grains so soft that all go through the wall."""
        self.write("soft.yaml", "scenario: wall_array\nwall: {spacing: 3 mm}\n"
                                "contact: {stiffness: 0.1 N/m, restitution: 0.9}\n"
                                "impact: {normal_velocity: [0.5], axial_velocity: [0.001, 0.01], starts: 2}\n")
        result = self.riesel("run", "soft.yaml", "--out", "out")
        for point in self.summary(self.home / "out")["curve"]:
            self.assertEqual((point["passed"], point["brake_failure_fraction"], point["verdict"], point["cause"]),
                             (2, None, "suspect", "brake_failure_fraction"))
        self.assertRegex(result.stdout, r"(?m)^  suspect +brake_failure_fraction is not known: no impact comes away")


class WallArray(Impacts, CommandTest):
    scenario = "wall_array"
    normal_velocities = [0.1, 0.3, 0.5]

    def test_the_overlap_is_that_of_the_deepest_start(self):
        """Mean overlaps of these points stay below the threshold by which the deepest makes some of them suspect."""
        out = self.run_to_end(SHIPPED / "wall_array.yaml", "soft", "--set", "contact.stiffness=300", "--set",
                              "contact.damping=1000", "--set",
                              "impact.normal_velocity=1", "--set",
                              "impact.axial_velocity={from: 0.3, to: 1.5, points: 9, spacing: linear}")
        curve = self.summary(out)["curve"]
        deep = [point["max_overlap"] > 0.2 * 0.33e-3 for point in curve]
        self.assertEqual([point["cause"] == "max_overlap_ratio" for point in curve], deep)
        self.assertIn(True, deep)
        self.assertIn(False, deep)

    def test_means_over_starts_are_means(self):
        """A sum over eight starts would be some eight times as much as one of them."""
        curves = []
        for starts in (1, 8):
            out = self.run_to_end(SHIPPED / "wall_array.yaml", f"of{starts}", "--set", f"impact.starts={starts}", "--set",
                                  "impact.normal_velocity=0.3", "--set",
                                  "impact.axial_velocity={from: 0.02, to: 0.08, points: 3, spacing: linear}")
            curves.append(self.summary(out)["curve"])
        for one, several in zip(*curves):
            for name in ("contacts", "contact_time"):
                self.assertTrue(0.2 < several[name] / one[name] < 3.0, (name, one[name], several[name]))

    def test_two_contacts_by_chance_are_not_taken_for_the_rise(self):
        """With few starts the mean touches 2 at a low velocity; with many it comes to it between 20 and 30 m/s."""
        out = self.run_to_end(SHIPPED / "wall_array.yaml", "wide", "--set", "wall.spacing=2.5 mm",
                              "--set", "impact.normal_velocity=0.3")
        summary = self.summary(out)
        self.assertTrue(any((point["contacts"] or 0) >= 2 for point in summary["curve"] if point["v_y"] < 1))
        self.assertTrue(10 < summary["lines"][0]["two_contacts_at"] < 40)


class BeadColumn(CommandTest):
    """Luding et al.'s column, with few gaps: what the paper shows, and what the user is told."""

    POINT_NAMES = {"gap_ratio", "gap", "restitution", "rebound", "detachment", "contacts", "contact_time",
                   "max_overlap", "verdict"}

    def drop(self, out, *options, threads=1):
        return self.run_to_end(SHIPPED / "bead_column.yaml", out, *options, threads=threads)

    def test_the_summary_has_the_names_of_the_contract_and_finite_values(self):
        out = self.drop("out")
        summary = self.summary(out)
        self.assertEqual(set(summary), COMMON_NAMES | {"t_col", "rigid", "column"})
        self.assertEqual(set(summary["rigid"]), {"restitution", "rebound", "collisions", "collapsed"})
        self.assert_finite(summary)
        with h5py.File(out / "run.h5", "r") as file:
            self.assertEqual(set(file["curve"]), self.POINT_NAMES)
            for name, column in file["curve"].items():
                of_column = [point[name] for point in summary["column"]]
                if name == "verdict":
                    of_column = [VERDICTS.index(verdict) for verdict in of_column]
                self.assertEqual(list(column), of_column, name)

    def test_a_bead_alone_rebounds_as_fast_as_it_came_and_a_column_does_not(self):
        for beads, are_alike in ((1, True), (5, False)):
            out = self.drop(f"of{beads}", "--set", f"column.beads={beads}")
            summary = self.summary(out)
            for point in [*summary["column"], summary["rigid"]]:
                self.assertEqual(abs(point["rebound"] / point["restitution"] - 1.0) < 1e-6, are_alike, point)

    def test_the_result_depends_neither_on_threads_nor_on_the_way_the_settings_came(self):
        one = self.drop("one")
        self.assert_same_result(one, self.drop("three", threads=3))
        self.assert_same_result(one, self.run_to_end(one / "effective.yaml", "again"))

    def test_the_user_is_told_where_t_col_is_too_long(self):
        """Beads that stand closer than v t_col touch several at once; a stiffness k times as large
        moves that to gaps smaller by sqrt(k)."""
        summary = self.summary(self.drop("out"))
        for point in summary["column"]:
            kept = point["restitution"]**2 - summary["rigid"]["restitution"]**2
            self.assertAlmostEqual(point["detachment"], kept / (1 - summary["rigid"]["restitution"]**2), places=12)
            if point["gap_ratio"] > 1.0:
                self.assertEqual(point["verdict"], "valid", point)
            if point["gap_ratio"] < 0.2:
                self.assertEqual(point["verdict"], "unphysical", point)
        valid = min(p["gap_ratio"] for p in summary["column"] if p["verdict"] == "valid")
        result = self.riesel("run", SHIPPED / "bead_column.yaml", "--out", "screen")
        self.assertIn(f"t_col is too long for gaps below {valid:.3g} v t_col", result.stdout)
        close = self.riesel("run", SHIPPED / "bead_column.yaml", "--out", "close", "--set", "column.gap_ratio=0.1")
        self.assertIn("too long for all of these gaps: raise contact.stiffness", close.stdout)

    def test_drops_that_were_given_up_tell_nothing_of_t_col(self):
        out = self.drop("out")
        summary = self.summary(out)
        valid = min(p["gap_ratio"] for p in summary["column"] if p["verdict"] == "valid")
        widest = max(summary["column"], key=lambda point: point["gap_ratio"])
        widest.update(detachment=None, restitution=None, verdict="suspect")
        (out / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
        self.assert_done(self.riesel("report", out))
        self.assertIn(f"t_col is too long for gaps below {valid:.3g} v t_col",
                      (out / "report.html").read_text(encoding="utf-8"))

    def test_energy_that_comes_from_nowhere_is_told(self):
        """Beads without damping that steps do not resolve."""
        result = self.riesel("run", SHIPPED / "bead_column.yaml", "--out", "coarse", "--set", "contact.restitution=1",
                             "--set", "run.steps_per_collision=5")
        self.assert_done(result)
        column = self.summary(self.home / "coarse")["column"]
        self.assertGreater(max(point["restitution"] for point in column), 1.01)
        for point in column:
            if point["restitution"] > 1.01:
                self.assertNotEqual(point["verdict"], "valid", point)
        self.assertIn("raise run.steps_per_collision", result.stdout)

    def test_check_warns_of_gaps_below_v_t_col(self):
        result = self.riesel("check", SHIPPED / "bead_column.yaml")
        self.assert_done(result)
        self.assertIn("warning: t_col is longer than the time between two impacts", result.stdout)
        wide = self.riesel("check", SHIPPED / "bead_column.yaml", "--set", "column.gap_ratio=2")
        self.assertNotIn("t_col is longer", wide.stdout)

    def test_a_column_that_collapses_is_told(self):
        out = self.drop("out", "--set", "contact.restitution=0.3", "--set", "column.gap_ratio=[0.01, 3]")
        rigid = self.summary(out)["rigid"]
        self.assertEqual((rigid["collapsed"], rigid["restitution"]), (True, 0.0))

    def test_it_has_a_report_and_can_be_swept(self):
        out = self.drop("out")
        self.assert_done(self.riesel("report", out))
        page = (out / "report.html").read_text(encoding="utf-8")
        self.assertIn("t_col is too long for gaps below", page)
        self.assertIn("Red crosses: unphysical.<", page)
        self.assertTrue((out / "figures" / "restitution.svg").is_file())
        self.write("base.yaml", (SHIPPED / "bead_column.yaml").read_text(encoding="utf-8"))
        self.write("sweep.yaml", "base: base.yaml\naxes:\n  - {contact.stiffness: [2000 N/m, 20000 N/m]}\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "swept"))
        self.assert_done(self.riesel("report", "swept"))
        self.assertIn("unphysical", (self.home / "swept" / "report.html").read_text(encoding="utf-8"))


class Threads(CommandTest):

    def test_the_number_of_threads_is_that_of_openmp_unless_set(self):
        file = SHIPPED / "single_wall_grain.yaml"
        for number in (1, 3):
            out = f"out-{number}"
            self.assert_done(self.riesel("run", file, "--out", out, OMP_NUM_THREADS=str(number)))
            self.assertEqual(self.summary(self.home / out)["performance"]["threads"], number)
        out = self.run_to_end(file, "set", threads=2)
        self.assertEqual(self.summary(out)["performance"]["threads"], 2)


class NoDirectoryGiven(CommandTest):

    def test_results_go_to_a_directory_named_after_the_file(self):
        self.write("graze.yaml", (SHIPPED / "single_wall_grain.yaml").read_text(encoding="utf-8"))
        self.assert_done(self.riesel("run", "graze.yaml"))
        self.assertTrue((self.home / "runs" / "graze" / "summary.json").is_file())
