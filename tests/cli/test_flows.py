"""Flows beside the tube, through the command: smooth walls, slopes, walls that move."""

import json
import math
import re
import xml.etree.ElementTree

import h5py
import numpy as np

from report_files import SVG
from riesel_command import BAD_INPUT, SHIPPED, CommandTest, with_error

CONTACT = "contact: {stiffness: 500 N/m, restitution: 0.8, friction: 0.5}\n"
CHUTE = f"""
scenario: inclined_chute
{CONTACT}
chute: {{length: 10 mm, layers: 5, height: 20 mm, inclination: 25 degrees}}
start: {{random_velocity: 0.5 m/s}}
run: {{duration: 0.3 s}}
"""
CELL = f"""
scenario: shear_cell
{CONTACT}
cell: {{width: 10 mm, length: 10 mm}}
run: {{duration: 0.1 s}}
output: {{trajectory_interval: 20 ms}}
"""
SMOOTH = f"""
scenario: periodic_tube
{CONTACT}
wall: {{surface: smooth}}
tube: {{width: 10 mm, length: 10 mm, tilt: 30 degrees}}
run: {{duration: 0.1 s}}
output: {{trajectory_interval: 20 ms}}
"""
UPWARDS = f"""
scenario: periodic_tube
{CONTACT}
wall: {{surface: smooth}}
tube: {{width: 10 mm, length: 10 mm}}
start: {{axial_velocity: -1 m/s, random_velocity: 0.2 m/s}}
run: {{duration: 60 ms}}
"""


class Flows(CommandTest):

    def run_of(self, name, text, *options):
        self.write(f"{name}.yaml", text)
        return self.run_to_end(f"{name}.yaml", name, *options)

    def braking(self, out):
        return xml.etree.ElementTree.parse(out / "figures/braking.svg").getroot()

    def level_of_braking(self, out):
        """y of the dashed lines from one side to the other."""
        return [float(line.get("y1")) for line in self.braking(out).findall(f"{SVG}line")
                if line.get("stroke-dasharray") == "5 4" and line.get("y1") == line.get("y2")]

    def test_a_dense_chute_is_no_brake_failure(self):
        out = self.run_of("chute", CHUTE)
        summary = self.summary(out)
        self.assertEqual(summary["validity"]["verdict"], "valid")
        self.assertEqual(summary["judged_by"], "mean_vy")
        self.assertAlmostEqual(summary["balance"]["gravity"], 4.226, places=3)
        self.assertLess(abs(summary["energy"]["residual"]), 0.01 * summary["energy"]["gravity_work"])

    def test_the_residual_is_told_beside_what_was_turned_over_also_if_gravity_takes(self):
        self.write("upwards.yaml", UPWARDS)
        result = self.riesel("run", "upwards.yaml", "--out", "upwards")
        self.assert_done(result)
        energy = self.summary(self.home / "upwards")["energy"]
        self.assertLess(energy["gravity_work"], -0.3 * energy["initial"])
        part = energy["residual"] / (energy["initial"] - energy["gravity_work"])
        told = re.search(r"(?m)^  energy residual       (\S+) of the energy turned over$", result.stdout)
        self.assertAlmostEqual(float(told[1]) / part, 1.0, delta=0.06)
        self.assert_done(self.riesel("report", "upwards"))
        page = (self.home / "upwards/report.html").read_text(encoding="utf-8")
        self.assertIn("of what was turned over", page)
        self.assertIn(f"{100.0 * part:.3g} %", page)

    def test_the_flow_of_mass_weighs_grains(self):
        self.write("two.csv", "x (mm),y (mm),vx (m/s),vy (m/s),diameter (mm),mass (mg)\n"
                              "2, 2, 0, 1, 1, 1\n6, 2, 0, 2, 1, 9\n")
        self.write("two.yaml", SMOOTH.replace(", tilt: 30 degrees", "")
                   + "gravity: 0\nstart: {kind: file, from: two.csv}\n")
        summary = self.summary(self.run_to_end("two.yaml", "two", "--set", "grains.mass=1 mg"))
        self.assertAlmostEqual(summary["mean_axial_velocity"]["value"], 1.5, places=6)
        momentum, length = 1e-6 * 1.0 + 9e-6 * 2.0, 0.01
        self.assertAlmostEqual(summary["mass_flow_rate"]["value"] / (momentum / length), 1.0, places=6)

    def test_the_balance_is_as_sure_as_the_momentum(self):
        out = self.run_of("chute", CHUTE)
        summary = self.summary(out)
        with h5py.File(out / "run.h5", "r") as file:
            time, impulse = file["series/time"][()], file["series/wall_impulse_y"][()]
            mass = np.sum(file["final/mass"][()])
        after = time >= summary["transient_end"] * (1 - 1e-9)
        velocity = (summary["balance"]["gravity"] * time + impulse / mass)[after]
        # The error of the mean is added to the scatter.
        least = math.sqrt(2.0) * np.std(velocity, ddof=1) / (time[-1] - time[after][0])
        error = summary["balance"]["errors"]["n_dot_dv_y"]
        self.assertGreater(error, least)
        self.assertLess(error, 1.5 * least)  # 1.75 if momentum were not balanced
        self.assertAlmostEqual(summary["braking_force"]["left"]["error"] / (mass * error), 1.0, places=9)

    def test_a_chute_has_one_wall(self):
        self.write("chute.yaml", CHUTE)
        result = self.riesel("run", "chute.yaml", "--out", "chute")
        self.assert_done(result)
        braking = self.summary(self.home / "chute")["braking_force"]
        self.assertEqual(set(braking), {"left", "weight"})
        self.assertRegex(result.stdout, r"(?m)^  braking by the walls  left [^,\n]* N, weight [^,\n]* N$")
        self.assert_done(self.riesel("report", "chute"))
        page = (self.home / "chute/report.html").read_text(encoding="utf-8")
        for told in ("braking force of the bottom", "x (the height above the bottom) to the right", "across the flow",
                     "along the bottom, which carries it in a steady state",
                     "along the bottom, carried by the bottom in a steady state", "of the grains to the bottom"):
            self.assertIn(told, page)
        for of_a_tube in ("left wall", "right wall", "across the tube", "along the tube", "the walls"):
            self.assertNotIn(of_a_tube, page)

    def test_a_flow_is_not_steady_before_its_spins_are(self):
        cell = ["run", SHIPPED / "shear_cell.yaml", "--set", "seed=3", "--set", "contact.friction=0.0005", "--set",
                "cell.width=10 mm", "--set", "cell.length=10 mm", "--set", "run.duration=0.6 s", "--set",
                "output.interval=1 ms", "--set", "grains.rotation=disc", "--out", "spins"]
        result = self.riesel(*cell)
        self.assert_done(result)
        self.assertIn("there is still a trend of the rotational temperature", result.stdout)
        summary = self.summary(self.home / "spins")
        self.assertEqual((summary["state"], summary["held_back_by"]), ("drifting", "rotational_temperature"))

    def test_a_shear_cell_is_judged_by_how_hot_it_is(self):
        out = self.run_of("cell", CELL)
        summary = self.summary(out)
        self.assertEqual(summary["judged_by"], "granular_temperature")
        self.assertGreater(summary["energy"]["wall_work"], 0.0)
        with h5py.File(out / "trajectory.h5") as file:  # the walls move apart
            walls = file["particles/walls/position"]
            x, y = walls["value"][:, :, 0], walls["value"][:, :, 1]
            left = x[0] == 0.0
            for side, velocity in ((left, -0.5), (~left, 0.5)):
                way = (y[1, side] - y[0, side]) - velocity * (walls["time"][1] - walls["time"][0])
                length = file["particles/walls/box/edges"][1]
                self.assertLess(abs(way - length * np.round(way / length)).max(), 1e-8)

    def test_temperatures_are_those_of_the_frames_without_profile_and_sway(self):
        """A frame for each row; lines fitted to v_y in each strip by another hand."""
        out = self.run_of("cell", CELL, "--set", "run.duration=10 ms", "--set", "output.interval=0.1 ms", "--set",
                          "output.trajectory_interval=0.1 ms")
        with h5py.File(out / "run.h5") as run, h5py.File(out / "trajectory.h5") as frames:
            profiles = {name: column[()] for name, column in run["profiles"].items()}
            since = run["profiles"].attrs["since"]
            grains = frames["particles/grains"]
            late = grains["position/time"][()] > since - 1e-9
            x, v = grains["position/value"][()][late, :, 0], grains["velocity/value"][()][late]
        width = profiles["x"][1] - profiles["x"][0]
        v = v - v.mean(axis=1, keepdims=True)
        strip = np.clip(x // width, 0, len(profiles["x"]) - 1)
        for i, middle in enumerate(profiles["x"]):
            here = strip == i
            of_line = np.polynomial.Polynomial.fit(x[here] - middle, v[here][:, 1], 1)
            random = v[here][:, 1] - of_line(x[here] - middle)
            self.assertAlmostEqual(profiles["temperature_x"][i] / (v[here][:, 0]**2).mean(), 1.0, delta=1e-6)
            self.assertAlmostEqual(profiles["temperature_y"][i] / (random**2).mean(), 1.0, delta=1e-6)
        self.assertGreater((v[:, :, 1]**2).mean(), 2.0 * profiles["temperature_y"].mean(), "there is a profile")

    def test_the_report_of_a_shear_cell_tells_how_hot_it_is_and_of_no_weight(self):
        out = self.run_of("cell", CELL)
        self.assert_done(self.riesel("report", out))
        page = (out / "report.html").read_text(encoding="utf-8")
        temperature = with_error(self.summary(out)["fluctuations"]["granular_temperature"])
        self.assertRegex(page, rf"<p[^>]*>Granular temperature {temperature} m\^2/s\^2 after .* Mean axial velocity ")
        self.assertNotIn("Dashed: the weight", page)
        self.assertEqual(self.level_of_braking(out), [])

    def test_the_walls_of_a_leaning_tube_carry_the_weight_together(self):
        """Whatever each of them does: the line stands where the force of both is as large."""
        out = self.run_of("smooth", SMOOTH)
        self.assert_done(self.riesel("report", out))
        self.assertIn("Dashed: the weight of all grains along the walls, which carry it together in a steady state.",
                      (out / "report.html").read_text(encoding="utf-8"))
        with h5py.File(out / "run.h5") as file:
            time, impulse = file["series/time"][()], file["series/wall_impulse_y"][()]
        ends = np.arange(51) * (len(time) - 1) // 50  # of the parts that are drawn
        force = -np.diff(impulse[ends]) / np.diff(time[ends])
        drawn = [float(place.split(",")[1]) for place in self.braking(out).findall(
            f"{SVG}g[@class='curve']/{SVG}polyline")[-1].get("points").split()]
        slope, offset = np.polyfit(force, drawn, 1)
        level, = self.level_of_braking(out)
        self.assertAlmostEqual(level, slope * self.summary(out)["braking_force"]["weight"] + offset, delta=0.05)

    def test_a_gas_that_only_cools_is_not_steady(self):
        """Its mean velocity is conserved and tells nothing."""
        out = self.run_of("cooling", SMOOTH, "--set", "gravity=0", "--set", "contact.friction=0", "--set",
                          "start.axial_velocity=1 m/s", "--set", "run.duration=1 s")
        summary = self.summary(out)
        self.assertEqual(summary["judged_by"], "granular_temperature")
        self.assertEqual(summary["state"], "drifting")

    def test_a_shear_cell_that_only_gets_hotter_has_no_error_bars(self):
        """Nothing takes out what the walls put in."""
        out = self.run_of("cell", CELL, "--set", "contact.restitution=1", "--set", "contact.friction=0", "--set",
                          "run.duration=0.2 s")
        summary = self.summary(out)
        self.assertEqual(summary["state"], "accelerating")
        temperature = summary["fluctuations"]["granular_temperature"]
        self.assertGreater(temperature["value"], 0.5)
        self.assertIsNone(temperature["error"])
        self.assertIsNone(summary["mean_axial_velocity"]["error"])
        self.assertGreater(summary["fluctuations"]["sigma_vx"]["error"], 0.0)

    def test_smooth_walls_cannot_be_passed(self):
        out = self.run_of("smooth", SMOOTH)
        summary = self.summary(out)
        self.assertIsNone(summary["validity"]["v_crit"])
        findings = {finding["name"]: finding for finding in summary["validity"]["findings"]}
        self.assertEqual(findings["wall_speed_over_v_crit"]["value"], 0.0)

    def test_they_resume_to_the_same_bits_and_make_reports(self):
        for name, text, short in (("chute", CHUTE, "0.1 s"), ("cell", CELL, "30 ms"),
                                  ("smooth", SMOOTH, "30 ms")):
            with self.subTest(name=name):
                whole = self.run_of(name, text, "--set", "run.stepping=plain")
                part = self.run_to_end(f"{name}.yaml", f"{name}_part", "--set", f"run.duration={short}",
                                       "--set", "run.stepping=windows")
                duration = json.loads((whole / "summary.json").read_text())["time"]
                self.assert_done(self.riesel("resume", part, "--set", f"run.duration={duration}"))
                self.assertEqual(self.state_hash(part), self.state_hash(whole))
                self.assert_done(self.riesel("report", whole))

    def test_a_shaken_bed_is_judged_by_how_hot_it_is(self):
        out = self.run_of("bed", SMOOTH, "--set", "tube.tilt=90 degrees", "--set", "wall.shake_amplitude=0.2 mm",
                          "--set", "wall.shake_frequency=50", "--set", "wall.shake_angle=90 degrees")
        summary = self.summary(out)
        self.assertEqual(summary["judged_by"], "granular_temperature")
        self.assertEqual(summary["balance"]["gravity"], 0.0)
        checked = self.riesel("check", "bed.yaml", "--set", "wall.shake_amplitude=0.2 mm", "--set",
                              "wall.shake_frequency=50").stdout
        self.assertRegex(checked, r"walls shake +up to 0.0628 m/s and 19.7 m/s\^2 \(1.97 g\), \d+ steps per period")

    def test_a_resume_to_a_length_at_which_rows_are_in_step_is_refused(self):
        out = self.run_of("short", SMOOTH, "--set", "wall.shake_amplitude=0.2 mm", "--set", "wall.shake_frequency=50",
                          "--set", "output.interval=20 ms")
        before = self.summary(out)
        refused = self.riesel("resume", out, "--set", "run.duration=6 s")
        self.assertEqual(refused.returncode, BAD_INPUT, refused)
        self.assertIn("output.interval: in step with the walls", refused.stderr)
        self.assertIn("in a new run: this one has its rows", refused.stderr)
        self.assertEqual(self.summary(out), before)

    def test_a_single_grain_has_no_temperature_that_could_be_steady(self):
        (self.home / "one.csv").write_text("x (mm),y (mm),vx (m/s),vy (m/s),diameter (mm)\n5,5,0.3,0,1\n")
        out = self.run_of("ball", SMOOTH.replace("tilt: 30 degrees", "tilt: 90 degrees").replace("friction: 0.5",
                          "friction: 0"), "--set", "start.kind=file", "--set", "start.from=one.csv")
        summary = self.summary(out)
        self.assertEqual((summary["granular_temperature"], summary["state"]), (0.0, "too_short"))
        self.assertEqual(summary["independent_samples"], 0.0)

    def test_v_crit_of_a_single_grain_is_that_of_its_own_velocity(self):
        text = SMOOTH.replace("surface: smooth", "spacing: 1.2 mm").replace("tilt: 30 degrees", "tilt: 90 degrees")
        (self.home / "one.csv").write_text("x (mm),y (mm),vx (m/s),vy (m/s),diameter (mm)\n5,5,0.3,0,1\n")
        out = self.run_of("one", text, "--set", "start.kind=file", "--set", "start.from=one.csv")
        # In a head-on contact at 0.1 m/s and more the chord is a tenth of the grain or more.
        self.assertGreater(self.summary(out)["validity"]["v_crit"], 0.5)
