"""The verdict of validity of short runs of a tube, and the balance eq. (9) of steady ones.

85 grains between walls that brake well. Started slowly they reach a steady state of 0.4 m/s within
0.1 s; started fast with soft contacts they fall through the wall grains.
"""

import math

import h5py
import numpy as np

from riesel_command import DONE, SHIPPED, SMALL_TUBE, CommandTest, series_of

TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.92}
tube: {width: 10 mm, length: 12 mm}
run: {duration: 0.15 s}
"""

FINDINGS = ["max_overlap_ratio", "brake_failure_fraction", "passages_per_wall_visit",
            "wall_speed_over_v_crit", "pulling_fraction", "steps_per_contact",
            "energy_error_ratio", "limits_exceeded", "grain_contact_rate_times_t_col"]


class Validity(CommandTest):

    def tube(self, out, **overrides):
        """Runs the tube; returns its summary and what it printed."""
        path = self.write("tube.yaml", TUBE)
        options = [part for key, value in overrides.items()
                   for part in ("--set", f"{key.replace('__', '.')}={value}")]
        result = self.riesel("run", path, "--out", out, "--threads", 1, *options)
        self.assertEqual(result.returncode, DONE, result)  # a busy machine may report progress
        return self.summary(self.home / out), result.stdout

    def series(self, out):
        return series_of(self.home / out)

    @staticmethod
    def gained_after_the_transient(summary, series):
        first = int(round(summary["transient_end"] / 1e-3))  # rows are 1 ms apart
        return {name: column[-1] - column[first] for name, column in series.items()}


class Verdicts(Validity):

    def test_hard_grains_on_the_slow_branch_are_valid(self):
        summary, text = self.tube("slow", contact__stiffness="200000 N/m")
        validity = summary["validity"]
        self.assertEqual(validity["verdict"], "valid", validity)
        self.assertEqual([finding["name"] for finding in validity["findings"]], FINDINGS)
        self.assertLess(validity["brake_failure_fraction"], 0.01)
        self.assertLess(validity["max_overlap_ratio"], 0.05)
        self.assertLess(summary["mean_axial_velocity"]["value"], 0.2 * validity["v_crit"])
        self.assertRegex(text, r"(?m)^  validity +valid$")
        self.assertNotRegex(text, r"(?m)^  (suspect|unphysical)")

    def test_soft_grains_that_fall_through_the_wall_grains_are_unphysical(self):
        for stiffness, speed in ((2000, 15), (2000, 30), (200, 15)):
            with self.subTest(stiffness=stiffness, speed=speed):
                summary, text = self.tube(
                    f"fast-{stiffness}-{speed}", contact__stiffness=stiffness,
                    start__axial_velocity=speed, run__duration="60 ms")
                validity = summary["validity"]
                self.assertEqual(validity["verdict"], "unphysical", validity)
                verdicts = {f["name"]: f["verdict"] for f in validity["findings"]}
                self.assertEqual(verdicts["brake_failure_fraction"], "unphysical", validity)
                self.assertGreater(validity["brake_failure_fraction"], 0.9)
                self.assertGreater(validity["friction_failure_fraction"], 0.9)
                self.assertGreater(summary["mean_axial_velocity"]["value"],
                                   3.0 * validity["v_crit"])
                self.assertRegex(text, r"(?m)^  validity +unphysical$")
                self.assertRegex(text, r"(?m)^  unphysical +brake_failure_fraction = ")
                # The emergency brake: visits of several contacts
                self.assertGreater(validity["contacts_per_wall_visit"], 1.5)

    def test_the_same_fast_start_with_hard_grains_is_no_brake_failure(self):
        # What makes the branch unphysical is softness: hard grains are braked within 30 ms.
        summary, _ = self.tube("hard", contact__stiffness="200000 N/m",
                               start__axial_velocity="15 m/s")
        self.assertLess(summary["validity"]["brake_failure_fraction"], 0.1)
        self.assertLess(summary["mean_axial_velocity"]["value"], 1.0)

    def test_a_run_without_wall_contacts_is_not_called_valid(self):
        summary, text = self.tube("brief", run__duration="0.1 ms", output__interval="0.01 ms")
        validity = summary["validity"]
        self.assertEqual(validity["verdict"], "suspect", validity)
        self.assertIsNone(validity["brake_failure_fraction"])
        self.assertRegex(text, r"(?m)^  suspect +brake_failure_fraction: not known")

    def test_walls_that_cannot_brake_do_not_fail_to(self):
        """A gas between smooth walls without friction, one of which shakes across."""
        summary, _ = self.tube("gas", wall__surface="smooth", contact__friction=0, gravity=0,
                               contact__stiffness="20 kN/m", start__axial_velocity=0,
                               wall__shake_amplitude="0.2 mm", wall__shake_frequency=200,
                               wall__shake_angle="90 degrees", grains__area_fraction=0.2, run__duration="0.3 s")
        self.assertEqual(summary["validity"]["brake_failure_fraction"], 0.0)
        self.assertEqual(summary["validity"]["verdict"], "valid", summary["validity"])

    def test_both_verdicts_stand_in_the_run_file(self):
        summary, _ = self.tube("run", run__duration="20 ms")
        with h5py.File(self.home / "run/run.h5", "r") as file:
            attributes = dict(file["validity"].attrs)
            states = {file[group].attrs["state"].decode() for group in ("profiles", "histograms")}
        self.assertEqual(states, {summary["state"]})
        self.assertEqual(attributes["verdict"].decode(), summary["validity"]["verdict"])
        for finding in summary["validity"]["findings"]:
            value = attributes[finding["name"]]
            self.assertTrue(value == finding["value"]
                            or (math.isnan(value) and finding["value"] is None), finding)


class WallVisits(Validity):

    def test_the_means_are_those_of_the_series(self):
        summary, _ = self.tube("run")
        visits = summary["wall_visits"]
        series = self.series("run")
        gained = self.gained_after_the_transient(summary, series)
        self.assertEqual(visits["visits"], gained["wall_visits"])
        self.assertGreater(visits["visits"], 50)
        for name in ("contacts", "dv_y", "dv_x", "entry_rate", "entry_slip"):
            self.assertAlmostEqual(visits[name]["value"],
                                   gained["wall_visit_" + name] / gained["wall_visits"])
            self.assertGreater(visits[name]["error"], 0.0)
            self.assertLess(visits[name]["error"], 0.5 * visits[name]["value"])
        self.assertEqual(sum(visits["of_contacts_since_start"]), series["wall_visits"][-1])
        self.assertEqual(summary["validity"]["contacts_per_wall_visit"],
                         visits["contacts"]["value"])

    def test_a_ratio_that_cannot_vary_has_no_error(self):
        """Grains of a gas touch a smooth wall once in a visit, however many visits there are in an interval."""
        summary, _ = self.tube("gas", wall__surface="smooth", contact__friction=0, contact__restitution=1, gravity=0,
                               contact__stiffness="20 kN/m", start__axial_velocity=0, start__random_velocity="1 m/s",
                               grains__area_fraction=0.1, run__duration="0.1 s")
        visits = summary["wall_visits"]
        self.assertGreater(visits["visits"], 100)
        self.assertEqual(visits["contacts"], {"value": 1.0, "error": 0.0})
        self.assertGreater(visits["entry_rate"]["error"], 0.0)

    def test_the_findings_are_ratios_of_the_series(self):
        summary, _ = self.tube("fast", contact__stiffness=200, start__axial_velocity=15, run__duration="60 ms")
        validity = summary["validity"]
        found = {finding["name"]: finding["value"] for finding in validity["findings"]}
        with h5py.File(self.home / "fast/run.h5", "r") as file:
            histograms = [(file[f"histograms/{kind}_contact_duration/count"][()],
                           file[f"histograms/{kind}_contact_duration/lower_edge"][()]) for kind in ("grain", "wall")]
            time_step = file["final"].attrs["time"] / file["final"].attrs["step"]
        gained = self.gained_after_the_transient(summary, self.series("fast"))
        for name, part, whole, unit in (
                ("brake_failure_fraction", "wall_braking_cut_short", "wall_braking", 1.0),
                ("passages_per_wall_visit", "wall_contacts_cut_short", "wall_visits", 1.0),
                ("wall_speed_over_v_crit", "wall_entry_slip", "wall_contacts_ended", validity["v_crit"]),
                ("pulling_fraction", "wall_pulling_time", "wall_contact_time", 1.0)):
            with self.subTest(name):
                self.assertGreater(found[name], 0.0)
                self.assertAlmostEqual(found[name] / (gained[part] / gained[whole] / unit), 1.0, delta=1e-9)
        # Fewer than 20 contacts of a kind would tell nothing.
        self.assertGreaterEqual(min(count.sum() for count, _ in histograms), 20)
        shortest = [edges[np.argmax(np.cumsum(count) > 0.05 * count.sum())] for count, edges in histograms]
        self.assertAlmostEqual(found["steps_per_contact"] / (min(shortest) / time_step), 1.0, delta=1e-9)

    def test_contacts_are_measured_by_the_closed_forms(self):
        k, gamma = 2000.0, 1e4
        summary, _ = self.tube("run", contact__restitution="", contact__damping=gamma, contact__stiffness=k)
        validity = summary["validity"]
        found = {finding["name"]: finding["value"] for finding in validity["findings"]}
        with h5py.File(self.home / "run/run.h5", "r") as file:
            mass, radius = (file["final"][name][()] for name in ("mass", "radius"))
            wall_radius = file["final/walls/radius"][0]
        t_grains, t_walls = (math.pi / math.sqrt(k / reduced - gamma**2 / 4) for reduced in (mass.mean() / 2, mass.mean()))
        reach = radius.mean() + wall_radius
        depth = summary["fluctuations"]["sigma_vx"]["value"] * t_walls / math.pi
        v_crit = 2 * math.sqrt(reach**2 - (reach - depth) ** 2) / t_walls
        gained = self.gained_after_the_transient(summary, self.series("run"))
        rate = 2 * gained["grain_contacts"] / len(mass) / gained["time"]
        overlap = max(self.series("run")["max_overlap"])
        for name, value, expected in (("t_col.grains", validity["t_col"]["grains"], t_grains),
                                      ("t_col.walls", validity["t_col"]["walls"], t_walls),
                                      ("v_crit", validity["v_crit"], v_crit),
                                      ("rate", found["grain_contact_rate_times_t_col"], rate * t_grains)):
            with self.subTest(name):
                self.assertAlmostEqual(value / expected, 1.0, delta=1e-6)
        # Over the smallest radius, of grains or, at walls, of wall grains, too.
        self.assertGreaterEqual(found["max_overlap_ratio"], overlap / radius.min())
        self.assertLessEqual(found["max_overlap_ratio"], overlap / min(wall_radius, radius.min()))

    def test_visits_lose_what_contacts_lose(self):
        # Per visit and per contact, of two sets of contacts that differ by the open visits only.
        summary, _ = self.tube("run", run__duration="1 s")
        visits, balance = summary["wall_visits"], summary["balance"]
        per_contact = visits["dv_y"]["value"] / visits["contacts"]["value"]
        self.assertAlmostEqual(per_contact / balance["dv_y"], 1.0, delta=0.03)


class Balance(Validity):

    def test_the_walls_carry_the_weight_in_steady_states(self):
        # g - n_dot dv_y is what the flow gains from one end of the window to the other, over its
        # length, and the error bar is that of such a difference: five of them are no chance, but a
        # trend, of which "steady" may overlook one in a hundred. A wrong count or impulse of 1 % is
        # found.
        for seed in (1, 2, 3):
            with self.subTest(seed=seed):
                summary, _ = self.tube(f"seed-{seed}", seed=seed, run__duration="4 s",
                                       output__interval="4 ms")
                balance = summary["balance"]
                self.assertEqual(summary["state"], "steady")
                error = balance["errors"]["n_dot_dv_y"]
                self.assertLess(error, 0.003 * balance["gravity"])
                self.assertLess(abs(balance["n_dot_dv_y"] - balance["gravity"]), 5.0 * error)
                self.assertAlmostEqual(balance["n_dot"] * balance["dv_y"], balance["n_dot_dv_y"],
                                       delta=1e-9 * balance["gravity"])

    def assert_covers(self, off, name):
        """`off`: of 40 means, in their own bars. 68 % are within; three standard deviations of that are 9."""
        self.assertEqual(len(off), 40)
        self.assertAlmostEqual(sum(abs(each) < 1.0 for each in off), 27, delta=9, msg=name)

    def test_the_bars_of_the_balance_and_of_visits_cover_as_often_as_they_say(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", "base: tube.yaml\nseeds: 40\n"
                                 "set: {run.duration: 0.5 s, grains.area_fraction: 0.5, start.axial_velocity: 1.5 m/s}\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        off, ratios = [], []
        for summary in map(self.summary, (self.home / "out/points").iterdir()):
            self.assertNotEqual(summary["state"], "accelerating")
            balance = summary["balance"]
            off.append(abs(balance["n_dot_dv_y"] - balance["gravity"]) / balance["errors"]["n_dot_dv_y"])
            ratios.append({**summary["wall_visits"],
                           "dv_y per contact": {"value": balance["dv_y"], "error": balance["errors"]["dv_y"]}})
        self.assert_covers(off, "n_dot_dv_y")
        self.assertGreaterEqual(sum(each < 2.0 for each in off), 34)  # of 95 %
        for name in ("contacts", "dv_y", "dv_x", "entry_rate", "entry_slip", "dv_y per contact"):
            with self.subTest(name):
                values, errors = np.array([(each[name]["value"], each[name]["error"]) for each in ratios]).T
                # The truth is not known, but to a sixth of a bar by the mean of all.
                self.assert_covers((values - values.mean()) / errors, name)

    def test_the_bar_of_the_loss_per_contact_is_not_too_wide_in_shear_cells(self):
        # Two walls that pull against each other give no momentum in the mean, and what they give in one
        # moment they take in the next. A bar that overlooks this is twice as wide as the means scatter.
        self.write("sweep.yaml", f"base: {SHIPPED}/shear_cell.yaml\nseeds: 40\n"
                                 "set: {contact.restitution: 0.9, cell.width: 10 mm, cell.length: 10 mm,"
                                 " cell.velocity: 0.5 m/s, run.duration: 0.6 s}\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        balances = [self.summary(point)["balance"] for point in (self.home / "out/points").iterdir()]
        off = np.array([balance["dv_y"] / balance["errors"]["dv_y"] for balance in balances])
        self.assert_covers(off, "dv_y")
        self.assertGreaterEqual(np.sum(np.abs(off) > 0.67), 14)  # half of 40, less two standard deviations

    def test_in_free_fall_they_do_not(self):
        summary, _ = self.tube("fast", start__axial_velocity="20 m/s", run__duration="0.3 s")
        balance = summary["balance"]
        self.assertEqual(summary["state"], "accelerating")
        self.assertIsNone(summary["mean_axial_velocity"]["error"])
        self.assertGreater(balance["gravity"] - balance["n_dot_dv_y"],
                           10.0 * balance["errors"]["n_dot_dv_y"])
