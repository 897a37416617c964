"""The example of docs/extending.md: a program of somebody else with a law and a scenario of its own,
which is the command that RIESEL names here."""

import pathlib
import re

import h5py
import numpy as np

from riesel_command import CommandTest

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/own_law_and_scenario"
SHORT = ("--set", "run.duration=5 ms")

GRAZING = """\
scenario: single_wall_grain
contact: {stiffness: 2000 N/m, damping: 1e-9 1/s, %s}
impact: {axial_velocity: [0.3 m/s, 3 m/s]}
"""
SWEEP = """\
base: cooling.yaml
set: {run.duration: 2 ms}
axes: {contact.stiffening_overlap: [20 um, 1 mm]}
"""


def series(run, name):
    with h5py.File(run / "run.h5", "r") as file:
        return file["series"][name][()]


class Example(CommandTest):

    def setUp(self):
        super().setUp()
        self.settings = self.write("cooling.yaml",
                                   (EXAMPLE / "cooling.yaml").read_text(encoding="utf-8"))

    def curve(self, law, out):
        settings = self.write(f"{out}.yaml", GRAZING % law)
        return self.summary(self.run_to_end(settings, out))["curve"]

    def test_it_is_short(self):
        lines = sum(len(path.read_text(encoding="utf-8").splitlines())
                    for path in EXAMPLE.iterdir())
        self.assertLess(lines, 100)

    def test_the_gas_cools_down_and_the_energy_is_accounted_for(self):
        run = self.run_to_end(self.settings, "run")
        energy = self.summary(run)["energy"]
        lost = energy["normal_loss"] + energy["friction_loss"]
        self.assertAlmostEqual(energy["kinetic"] + energy["elastic"] + lost, energy["initial"],
                               delta=2e-3 * energy["initial"])
        # Haff's law: 1/sqrt(T) grows in proportion to the time, here up to walls and inhomogeneity.
        kinetic = series(run, "kinetic_energy")
        self.assertGreater(kinetic[0], 50.0 * kinetic[-1])
        growth = np.diff(1.0 / np.sqrt(kinetic[::len(kinetic) // 5]))
        self.assertTrue(np.all(growth > 0.3 * growth.mean()), growth)

    def test_threads_stepping_and_interruption_change_no_bit(self):
        whole = self.state_hash(self.run_to_end(self.settings, "whole", *SHORT))
        for stepping in ("plain", "windows"):
            run = self.run_to_end(self.settings, stepping, *SHORT, "--set",
                                  f"run.stepping={stepping}", threads=2)
            self.assertEqual(self.state_hash(run), whole)
        self.run_to_end(self.settings, "part", "--set", "run.duration=2 ms")
        self.resume_to_end("part", *SHORT)
        self.assertEqual(self.state_hash(self.home / "part"), whole)

    def test_a_spring_that_does_not_stiffen_is_linear(self):
        soft = self.curve("law: linear", "linear")
        never = self.curve("law: stiffening, stiffening_overlap: 1e300 m", "never")
        stiff = self.curve("law: stiffening, stiffening_overlap: 1 um", "stiff")
        for linear, same, other in zip(soft, never, stiff, strict=True):
            self.assertAlmostEqual(same["dv_y"], linear["dv_y"], delta=1e-9 * linear["v_y"])
            self.assertGreater(abs(other["dv_y"] - linear["dv_y"]), 1e-4 * linear["v_y"])
            self.assertLess(other["max_overlap"], 0.9 * linear["max_overlap"])

    def test_settings_are_checked_as_those_of_riesel(self):
        self.assert_refused(self.riesel("run", "cooling.yaml", "--set", "contact.restitution=0.9"),
                            "contact.restitution", "stiffening")
        self.assert_refused(self.riesel("run", "cooling.yaml", "--set", "tube.size=0"),
                            "tube.size", "above 0 m")
        said = self.riesel("scenarios").stdout
        self.assertRegex(said, re.compile("^periodic_tube .*^cooling ", re.DOTALL | re.MULTILINE))

    def test_all_of_the_command_knows_them(self):
        self.assertIn("v_crit", self.riesel("check", "cooling.yaml").stdout)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "sweep"))
        self.assertEqual(len(list(self.home.glob("sweep/points/*/summary.json"))), 2)
        self.assertEqual(self.riesel("report", "sweep").returncode, 0)
