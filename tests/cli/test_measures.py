"""What a run says of its flow: means are those after the transient, series those of what the frames show."""

import h5py
import numpy as np

from riesel_command import SMALL_TUBE, CommandTest, series_of

# 85 grains, which come to rest against their walls within half of the run: 121 rows, the first sixty a transient.
TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.92}
tube: {width: 10 mm, length: 12 mm}
run: {duration: 0.12 s}
"""

# A frame for each row; grains rotate, and the walls work on them.
SEEN = SMALL_TUBE + """\
output: {interval: 0.05 ms, trajectory_interval: 0.05 ms}
wall: {shake_amplitude: 0.5 mm, shake_frequency: 3000, shake_angle: 30 degrees}
"""

# Grains that slide down a smooth wall; the other one is not touched after the beginning.
LEANING = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.8}
tube: {width: 10 mm, length: 10 mm, tilt: 68 degrees}
grains: {area_fraction: 0.25}
wall: {surface: smooth}
run: {duration: 0.5 s}
"""

# One grain that hits the wall, or two that hit each other.
FEW = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 10 mm, length: 10 mm}
start: {kind: file, from: grains.csv}
run: {duration: 3 ms}
"""
HEAD = "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n"


class AfterTheTransient(CommandTest):

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.out = maker.run_to_end(maker.write("tube.yaml", TUBE), "out")
        cls.said = maker.summary(cls.out)
        cls.series = series_of(cls.out)
        cls.first = int(np.argmax(cls.series["time"] >= cls.said["transient_end"] - 1e-12))
        with h5py.File(cls.out / "run.h5") as file:
            cls.profiles = {name: column[()] for name, column in file["profiles"].items()}
            cls.rates = {name: group["rate"][()].sum() for name, group in file["histograms"].items()}

    def test_there_is_a_transient(self):
        self.assertGreater(self.first, 20)
        self.assertLess(self.first, len(self.series["time"]) - 20)

    def test_the_rates_of_histograms(self):
        time = self.series["time"][-1] - self.series["time"][self.first]
        for histogram, column in (("wall_contact_duration", "wall_contacts_ended"),
                                  ("grain_contact_duration", "grain_contacts_ended"),
                                  ("wall_visit_entry_slip", "wall_visits")):
            gained = self.series[column][-1] - self.series[column][self.first]
            self.assertAlmostEqual(self.rates[histogram] * time / gained, 1.0, delta=1e-9, msg=histogram)

    def test_means_of_series(self):
        self.assertEqual(set(self.said["fluctuations"]), {"sigma_vx", "sigma_vy", "granular_temperature"})
        self.assertEqual(set(self.said["structure_factor"]), set("1234"))
        for name, mean in self.said["fluctuations"].items():
            self.assertAlmostEqual(mean["value"], self.series[name][self.first:].mean(), msg=name)
        for n, mean in self.said["structure_factor"].items():
            self.assertAlmostEqual(mean["value"], self.series[f"structure_factor_{n}"][self.first:].mean(), msg=n)

    def test_means_and_rates_of_the_summary(self):
        said, after = self.said, {name: column[self.first:] for name, column in self.series.items()}
        time, grains = np.ptp(after["time"]), said["grains"]
        with h5py.File(self.out / "run.h5") as file:
            mass, length = file["final/mass"][()], file["final"].attrs["box_length"]
            momentum = (mass * file["final/velocity"][()][:, 1]).sum()
        gained = {name: column[-1] - column[0] for name, column in after.items()}
        # Nothing but gravity and the walls changes it. (The run goes on for a step or so after the last row.)
        momenta = momentum - (mass.sum() * 10.0 * (after["time"][-1] - after["time"])
                              + after["wall_impulse_y"][-1] - after["wall_impulse_y"])
        expected = {
            "mean_axial_velocity": (said["mean_axial_velocity"], after["mean_vy"].mean(), 1e-9),
            "granular_temperature": (said["granular_temperature"], after["granular_temperature"].mean(), 1e-9),
            "mass_flow_rate": (said["mass_flow_rate"], momenta.mean() / length, 1e-3),
            "n_dot": (said["balance"]["n_dot"], gained["wall_contacts"] / time / grains, 1e-6),
            "n_dot_dv_y": (said["balance"]["n_dot_dv_y"], -gained["wall_impulse_y"] / time / mass.sum(), 1e-6),
            "grain_contact_rate": (said["grain_contact_rate"], 2.0 * gained["grain_contacts"] / time / grains, 1e-6)}
        for wall, outwards in (("left", 1.0), ("right", -1.0)):
            across, along = gained[f"{wall}_wall_impulse_x"], gained[f"{wall}_wall_impulse_y"]
            expected[f"{wall} braking"] = (said["braking_force"][wall], -along / time, 1e-6)
            expected[f"{wall} pressure"] = (said["wall_pressure"][wall], outwards * across / time / length, 1e-6)
        for name, (told, value, tolerance) in expected.items():
            told = told["value"] if isinstance(told, dict) else told
            self.assertAlmostEqual(told / value, 1.0, delta=tolerance, msg=name)

    def test_the_zones_are_the_strips_of_the_profiles(self):
        weight = self.profiles["density"]  # that of numbers of grains within a hundredth or two
        for zone, strips in (("core", slice(2, 8)), ("wall_layers", [0, -1])):
            for name, mean in self.said["profiles"][zone].items():
                values, by_area = self.profiles[name][strips], name == "area_fraction" or name.startswith("stress")
                if name == "shear_rate":  # nearly the line through the means of the strips
                    x, v = (self.profiles[column][strips] for column in ("x", "mean_axial_velocity"))
                    slope = np.polyfit(x, v, 1, w=np.sqrt(weight[strips]))[0]
                    self.assertLess(abs(mean["value"] - slope), mean["error"], zone)
                    continue
                expected = np.average(values, weights=None if by_area else weight[strips])
                if name in ("mean_spin", "rotational_temperature"):  # the grains do not rotate
                    self.assertEqual((mean["value"], mean["error"], expected), (0.0, 0.0, 0.0))
                    continue
                self.assertAlmostEqual(mean["value"] / expected, 1.0, delta=1e-9 if by_area else 0.03, msg=f"{zone} {name}")

    def test_energies(self):
        columns = {"residual": "energy_residual", "kinetic": "kinetic_energy", "rotational": "rotational_energy",
                   "elastic": "elastic_energy"}
        for name, end in self.said["energy"].items():
            if name != "initial":
                last = self.series[columns.get(name, name)][-1]
                # The run goes on for a step or so after the last row.
                self.assertAlmostEqual(end, last, delta=1e-3 * self.said["energy"]["gravity_work"], msg=name)


class ForcesOfWalls(CommandTest):
    """Their error bars, beside that of both together, which the bounded momentum makes small."""

    def bars(self, text, *options):
        """Of both, of the left and of the right wall, in N; and the summary."""
        out = self.run_to_end(self.write("tube.yaml", text), "out", *options)
        said = self.summary(out)
        with h5py.File(out / "run.h5") as file:
            mass = file["final/mass"][()].sum()
        force = said["braking_force"]
        return mass * said["balance"]["errors"]["n_dot_dv_y"], force["left"]["error"], force["right"]["error"], said

    def test_two_walls_share_what_is_known_of_both(self):
        """Half of the sum, half of the difference, and what both have in common."""
        both, left, right, _ = self.bars(TUBE.replace("0.12 s", "0.5 s"), "--set", "contact.restitution=0.9", "--set",
                                         "grains.rotation=disc")
        of_halves = np.sqrt(0.5 * (left**2 + right**2))  # what they have in common has opposite signs
        self.assertGreater(of_halves, 0.5 * both)
        self.assertLess(of_halves, 1.3 * both)  # 1.9 by their increments

    def test_the_only_wall_that_is_touched_bears_all(self):
        """Along the tube and, as gravity presses the grains to it, across."""
        both, left, right, said = self.bars(LEANING)
        self.assertGreater(both, 0.0)
        self.assertEqual(right, 0.0)
        self.assertAlmostEqual(left / both, 1.0, places=6)
        pressure = said["wall_pressure"]
        self.assertEqual(pressure["right"], {"value": 0.0, "error": 0.0})
        self.assertGreater(pressure["left"]["error"], 0.0)
        self.assertLess(pressure["left"]["error"], 1e-3 * pressure["left"]["value"])


class FromFrames(CommandTest):

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.out = maker.run_to_end(maker.write("tube.yaml", SEEN), "out", "--set", "grains.rotation=disc")
        cls.series = series_of(cls.out)
        with h5py.File(cls.out / "trajectory.h5") as file, h5py.File(cls.out / "run.h5") as run:
            grains = file["particles/grains"]
            cls.y, cls.v = grains["position/value"][()][:, :, 1], grains["velocity/value"][()][:, :, :2].astype(float)
            cls.spin = grains["spin/value"][()].astype(float)
            cls.mass, cls.radius = grains["mass"][()].astype(float), grains["radius"][()].astype(float)
            cls.length = run["final"].attrs["box_length"]
            assert np.allclose(grains["position/time"][()], cls.series["time"], atol=1e-9)
        cls.initial = maker.summary(cls.out)["energy"]["initial"]

    def assert_seen(self, name, expected):
        scale = abs(expected).max()
        self.assertGreater(scale, 0.0, name)
        np.testing.assert_allclose(self.series[name], expected, rtol=0.0, atol=1e-5 * scale, err_msg=name)

    def test_motion(self):
        inertia = 0.5 * self.mass * self.radius**2
        self.assert_seen("mean_vx", self.v[:, :, 0].mean(axis=1))
        self.assert_seen("mean_vy", self.v[:, :, 1].mean(axis=1))
        self.assert_seen("sigma_vx", self.v[:, :, 0].std(axis=1))
        self.assert_seen("sigma_vy", self.v[:, :, 1].std(axis=1))
        self.assert_seen("kinetic_energy", 0.5 * (self.mass * (self.v**2).sum(axis=2)).sum(axis=1))
        self.assert_seen("mean_spin", self.spin.mean(axis=1))
        self.assert_seen("rotational_energy", 0.5 * (inertia * self.spin**2).sum(axis=1))
        self.assert_seen("rotational_temperature", (inertia / self.mass * self.spin**2).mean(axis=1))

    def test_the_flow_of_mass(self):
        momentum = (self.mass * self.v[:, :, 1]).sum(axis=1)
        told = self.summary(self.out)["mass_flow_rate"]["value"]
        self.assertAlmostEqual(told / (momentum.mean() / self.length), 1.0, delta=1e-5)

    def test_the_pressure_on_the_walls(self):
        """The impulses of both change the momentum across, as nothing else does."""
        summary, s = self.summary(self.out), self.series
        across = (self.mass * self.v[:, :, 0]).sum(axis=1)
        both = s["left_wall_impulse_x"] + s["right_wall_impulse_x"]
        self.assertGreater(s["left_wall_impulse_x"][-1], 2 * abs(across).max())
        np.testing.assert_allclose(both - both[0], across - across[0], rtol=0.0, atol=1e-2 * abs(across).max())
        after = s["time"] >= summary["transient_end"] - 1e-12
        for wall, outwards in (("left", 1.0), ("right", -1.0)):
            impulse = s[f"{wall}_wall_impulse_x"][after]
            pressure = outwards * (impulse[-1] - impulse[0]) / np.ptp(s["time"][after]) / self.length
            self.assertAlmostEqual(summary["wall_pressure"][wall]["value"] / pressure, 1.0, delta=1e-6)
            self.assertGreater(pressure, summary["wall_pressure"][wall]["error"])

    def test_the_report_shows_spins_where_grains_rotate(self):
        still = self.run_small_tube("still")
        for out, shown in ((self.out, True), (still, False)):
            self.assert_done(self.riesel("report", out))
            for figure in ("spin", "rotational_temperature"):
                self.assertEqual((out / f"figures/{figure}.svg").exists(), shown)

    def test_spins_in_the_zones(self):
        with h5py.File(self.out / "run.h5") as run:
            profiles = {name: run[f"profiles/{name}"][()] for name in run["profiles"]}
        core = self.summary(self.out)["profiles"]["core"]
        left_out = (len(profiles["x"]) + 1) // 4
        strips = slice(left_out, len(profiles["x"]) - left_out)
        for name in ("mean_spin", "rotational_temperature"):
            low, high = profiles[name][strips].min(), profiles[name][strips].max()
            self.assertTrue(low <= core[name]["value"] <= high and low < high, name)

    def test_waves(self):
        for n in range(1, 5):
            wave = np.exp(2j * np.pi * n * self.y / self.length).sum(axis=1)
            expected = abs(wave) ** 2 / len(self.mass)
            # Places along the tube count in steps of a 1024th of its length.
            np.testing.assert_allclose(self.series[f"structure_factor_{n}"], expected, rtol=0.0,
                                       atol=0.02 * n * expected.max())

    def test_the_energies_of_each_row_add_up(self):
        s = self.series
        for name in ("wall_work", "normal_loss", "friction_loss"):
            self.assertGreater(abs(s[name][-1]), 0.01 * self.initial, name)
        self.assertGreater(abs(s["wall_work"][-1] - s["gravity_work"][-1]), 0.01 * self.initial)
        missing = (self.initial + s["gravity_work"] + s["wall_work"] - s["kinetic_energy"] - s["rotational_energy"]
                   - s["elastic_energy"] - s["normal_loss"] - s["friction_loss"])
        np.testing.assert_allclose(s["energy_residual"], missing, rtol=0.0, atol=1e-9 * self.initial)
        self.assertGreater(abs(missing).max(), 1e-6 * self.initial)


class OneKindOnly(CommandTest):

    def few(self, grains, *options):
        self.write("grains.csv", HEAD + grains)
        out = self.run_to_end(self.write("few.yaml", FEW), f"out{len(list(self.home.iterdir()))}", *options)
        return {name: column[-1] for name, column in series_of(out).items()}

    def assert_zero_but(self, row, others, *names):
        for name in names:
            self.assertNotEqual(row[name], 0.0, name)
        for name in others:
            self.assertEqual(row[name], 0.0, name)

    def test_what_grains_and_walls_did_is_told_apart(self):
        grains = ("grain_contacts_ended", "grain_contact_time", "grain_slip_path")
        walls = ("wall_contacts_ended", "wall_contact_time", "wall_slip_path", "wall_impulse_y", "wall_visits")
        self.assert_zero_but(self.few("4,5,1,0,1\n6,5.1,-1,0,1\n"), walls, *grains)
        self.assert_zero_but(self.few("2,5,-1,0.5,1\n"), grains, *walls)

    def test_damping_and_friction_are_told_apart(self):
        meeting = "4,5,1,0,1\n6,5.3,-1,0,1\n"
        self.assert_zero_but(self.few(meeting, "--set", "contact.friction=0"), ["friction_loss"], "normal_loss")
        self.assert_zero_but(self.few(meeting, "--set", "contact.restitution=1"), ["normal_loss"], "friction_loss")
        energy = self.summary(max(self.home.glob("out*"), key=lambda path: path.stat().st_mtime_ns))["energy"]
        self.assertEqual(energy["normal_loss"], 0.0)
        self.assertGreater(energy["friction_loss"], 0.0)


class Evidence(CommandTest):

    def test_fewer_than_twenty_contacts_with_walls_are_none(self):
        path = self.write("tube.yaml", TUBE)
        ratios = ("brake_failure_fraction", "passages_per_wall_visit", "wall_speed_over_v_crit", "pulling_fraction")
        seen = set()
        for duration in (2, 4, 6, 8, 12, 16, 24):
            out = self.run_to_end(path, f"out{duration}", "--set", f"run.duration={duration} ms")
            found = {finding["name"]: finding["value"] for finding in self.summary(out)["validity"]["findings"]}
            series = series_of(out)
            first = np.argmax(series["time"] >= self.summary(out)["transient_end"] - 1e-12)
            of_walls = series["wall_contacts_ended"][-1] - series["wall_contacts_ended"][first]
            if 0 < of_walls < 20:
                seen.add("few")
                self.assertEqual([found[name] for name in ratios], [None] * len(ratios), of_walls)
            elif of_walls >= 20:
                seen.add("enough")
                self.assertNotIn(None, [found[name] for name in ratios], of_walls)
        self.assertEqual(seen, {"few", "enough"})

    def test_fewer_than_twenty_contacts_do_not_tell_how_long_contacts_are(self):
        path = self.write("tube.yaml", TUBE)
        for duration, known in (("0.2 ms", False), ("2 ms", True)):
            out = self.run_to_end(path, f"out{known}", "--set", f"run.duration={duration}", "--set", "output.interval=0.1 ms")
            steps = next(finding["value"] for finding in self.summary(out)["validity"]["findings"]
                         if finding["name"] == "steps_per_contact")
            self.assertGreater(series_of(out)["grain_contacts_ended"][-1], 1)
            self.assertEqual(steps is not None, known, steps)
