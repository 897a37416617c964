#!/usr/bin/env python3
"""The core of shear cells beside the kinetic theory of nearly elastic discs, from the profiles of their runs.

    docs/flows/cell.py [--sweep sweeps/cell]

Prints a row for each point: the shear rate in units of diameter and temperature, and temperature, pressure, shear
stress (of the walls) and dissipation over those of the theory at the measured area fraction, shear rate and
temperature. docs/flows.md quotes the table as it is printed.
"""
import argparse
import pathlib
import sys

import numpy as np

HOME = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(HOME / "python"))
import riesel


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


def row_of(run):
    p, settings = run.profiles, run.settings
    strips = len(p["x"])
    core = slice(strips // 4, strips - strips // 4)

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
    cells = [f"{e:g}", f"{rate * d / t ** 0.5:.2f}", run.summary["state"], f"{nu:.3f}", f"{tx / ty:.3f}",
             ratio(t, t_error, theory.temperature(rate)), ratio(pressure, pressure_error, theory.pressure * t),
             ratio(shear, shear_error, theory.viscosity * t ** 0.5 * rate),
             ratio(shear * rate, shear_error * rate, theory.loss * t ** 1.5)]
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sweep", type=pathlib.Path, default=HOME / "sweeps/cell")
    options = parser.parse_args()
    print("| e_N | shear rate d / T^(1/2) | state | area fraction | T_x / T_y | temperature | pressure | shear stress | dissipation |")
    print("|--:|--:|---|--:|--:|--:|--:|--:|--:|")
    for point in riesel.Sweep(options.sweep).points:
        if point.run.is_done:
            print(row_of(point.run))


if __name__ == "__main__":
    main()
