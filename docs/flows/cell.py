#!/usr/bin/env python3
"""The core of shear cells beside the kinetic theory of nearly elastic discs, from the profiles of their runs.

    docs/flows/cell.py [--sweep sweeps/cell]

Prints a row for each stiffness and restitution, means over seeds: the shear rate in units of diameter and temperature,
and temperature, pressure, shear stress (of the walls) and dissipation over those of the theory at the measured area
fraction, shear rate and temperature. docs/flows.md quotes the table as it is printed.
"""
import argparse
import pathlib
import sys
from typing import NamedTuple

import numpy as np

from seeds import mean_of, runs_by_setting, states_of

import riesel  # by way of seeds

HOME = pathlib.Path(__file__).resolve().parents[2]


def ratio(value, error, theory):
    return riesel.Estimate(value / theory, error / theory)


class Theory:
    """Enskog's of discs of diameter d and mass m (Gass, J. Chem. Phys. 54, 1898 (1971)), their dissipation to first
    order in 1 - e^2 (Jenkins and Richman 1985). T is per mass and component."""

    def __init__(self, d, m, e, nu):
        g0 = (1 - 7 * nu / 16) / (1 - nu) ** 2
        self.rho = 4 * m * nu / (np.pi * d * d)
        self.pressure = self.rho * (1 + (1 + e) * nu * g0)  # over T
        self.viscosity = 1.022 * m / (2 * d * np.pi ** 0.5) * (1 / g0 + 2 * nu + 0.8729 * (2 * nu) ** 2 * g0)  # over T^(1/2)
        self.loss = 4 / (np.pi ** 0.5 * d) * self.rho * nu * g0 * (1 - e * e)  # over T^(3/2)

    def temperature(self, shear_rate):
        return self.viscosity * shear_rate ** 2 / self.loss


class Core(NamedTuple):
    """The middle half of the width of a cell."""

    shear_rate: float  # in units of diameter and temperature
    area_fraction: float
    anisotropy: float  # T_x / T_y
    # Over those of the theory.
    temperature: riesel.Estimate
    pressure: riesel.Estimate
    shear_stress: riesel.Estimate
    dissipation: riesel.Estimate


def reject_others(settings):
    """The theory is of smooth equal discs."""
    others = [key for key, of_theory in (("contact.friction", 0), ("grains.rotation", "none"), ("grains.polydispersity", 0))
              if settings.get(key) != of_theory]
    if others:
        sys.exit(f"the theory is of smooth equal discs: it says nothing where {', '.join(others)} differs")


def core_of(run):
    p, settings = run.profiles, run.settings
    reject_others(settings)
    strips = len(p["x"])
    left_out = (strips + 1) // 4  # on either side, as in summary.json
    core = slice(left_out, strips - left_out)

    def mean(name):
        return p[name][core].mean(), p[f"{name}_error"][core].mean()

    nu = mean("area_fraction")[0]
    d, e = settings["grains.diameter"], settings["contact.restitution"]
    theory = Theory(d, settings["grains.mass"], e, nu)
    rate = np.polyfit(p["x"][core], p["mean_axial_velocity"][core], 1)[0]
    (tx, tx_error), (ty, ty_error) = mean("temperature_x"), mean("temperature_y")
    t, t_error = (tx + ty) / 2, (tx_error + ty_error) / 2
    pressure, pressure_error = mean("stress_xx")
    force = [run.estimate(f"braking_force.{wall}") for wall in ("left", "right")]
    shear = (force[0].value - force[1].value) / (2 * settings["cell.length"])
    shear_error = np.hypot(force[0].error, force[1].error) / (2 * settings["cell.length"])
    return Core(shear_rate=rate * d / t ** 0.5, area_fraction=nu, anisotropy=tx / ty,
                temperature=ratio(t, t_error, theory.temperature(rate)),
                pressure=ratio(pressure, pressure_error, theory.pressure * t),
                shear_stress=ratio(shear, shear_error, theory.viscosity * t ** 0.5 * rate),
                dissipation=ratio(shear * rate, shear_error * rate, theory.loss * t ** 1.5))


def row_of(runs):
    settings = runs[0].settings
    rate, nu, anisotropy, *ratios = zip(*map(core_of, runs))
    cells = [f"{settings['contact.stiffness'] / 1000:g}", f"{settings['contact.restitution']:g}", states_of(runs),
             f"{np.mean(rate):.2f}", f"{np.mean(nu):.3f}", f"{np.mean(anisotropy):.3f}", *map(mean_of, ratios)]
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sweep", type=pathlib.Path, default=HOME / "sweeps/cell")
    options = parser.parse_args()
    print("| k_N, kN/m | e_N | state | shear rate d / T^(1/2) | area fraction | T_x / T_y | temperature | pressure | "
          "shear stress | dissipation |")
    print("|--:|--:|---|--:|--:|--:|--:|--:|--:|--:|")
    for runs in runs_by_setting(options.sweep):
        print(row_of(runs))


if __name__ == "__main__":
    main()
