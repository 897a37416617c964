#!/usr/bin/env python3
"""The bulk of flows down a chute, from the profiles of their runs.

    docs/flows/chute.py [--sweep sweeps/chute] [--draw docs/flows/chute.svg]

Prints a row for each inclination and number of layers, means over seeds: the height H of the flow, its mean velocity
and area fraction, the stress ratio, and two exponents: that of the shear rate over the normal stress in the bulk
(Bagnold: 1/2), and that of the mean velocity over H between flows of the same inclination (3/2). The bulk is what lies
between 0.2 H and 0.8 H. docs/flows.md quotes the table as it is printed.
"""
import argparse
import pathlib
from typing import NamedTuple

import matplotlib
import numpy as np

from seeds import mean_of, runs_by_setting, states_of

import riesel  # by way of seeds

HOME = pathlib.Path(__file__).resolve().parents[2]
matplotlib.use("Agg")
import matplotlib.pyplot as plt


class Flow(NamedTuple):
    inclination: float  # degrees
    layers: float
    state: str
    velocity: riesel.Estimate  # m/s, mean over the grains
    height: riesel.Estimate  # m, of the grains at the area fraction of the bulk
    area_fraction: riesel.Estimate  # mean and scatter over the bulk
    stress_ratio: riesel.Estimate  # likewise, over the tangent of the inclination
    rate_exponent: riesel.Estimate
    x: np.ndarray  # m, above the bottom line
    v: np.ndarray  # m/s


def over(values):
    """Mean and standard deviation."""
    return riesel.Estimate(float(np.mean(values)), float(np.std(values)))


def slope(x, y):
    """Of a straight line through (log x, log y), with its error."""
    (a, _), covariance = np.polyfit(np.log(x), np.log(y), 1, cov=True)
    return riesel.Estimate(float(a), float(covariance[0, 0] ** 0.5))


def bulk_of(x, fraction):
    """The height of the flow, and the strips of its bulk; the height is measured with the bulk's area fraction."""
    width = x[1] - x[0]
    height = fraction.sum() * width / np.median(fraction[fraction > 0.5 * fraction.max()])
    for _ in range(10):
        bulk = (x > 0.2 * height) & (x < 0.8 * height)
        height = fraction.sum() * width / fraction[bulk].mean()
    return height, bulk


def flow_of(run):
    p, settings = run.profiles, run.settings
    x, v = p["x"], p["mean_axial_velocity"]
    height, bulk = bulk_of(x, p["area_fraction"])
    rate, normal, shear = np.gradient(v, x)[bulk], p["stress_xx"][bulk], -p["stress_xy"][bulk]
    flows = bool((rate > 0).all())
    return Flow(inclination=float(np.degrees(settings["chute.inclination"])), layers=settings["chute.layers"],
                state=run.summary["state"], velocity=run.estimate("mean_axial_velocity"),
                height=riesel.Estimate(height, np.nan), area_fraction=over(p["area_fraction"][bulk]),
                stress_ratio=over(shear / normal / np.tan(settings["chute.inclination"])),
                rate_exponent=slope(normal, rate) if flows else riesel.Estimate(np.nan, np.nan), x=x, v=v)


def mean_flow(runs):
    """Of several seeds. The scatter over the bulk is that of a single run, in the mean."""
    flows = [flow_of(run) for run in runs]

    def mean(name):
        return mean_of([getattr(flow, name) for flow in flows])

    def mean_and_scatter(name):
        return riesel.Estimate(*np.mean([getattr(flow, name) for flow in flows], axis=0))

    return flows[0]._replace(state=states_of(runs), velocity=mean("velocity"), height=mean("height"),
                             area_fraction=mean_and_scatter("area_fraction"),
                             stress_ratio=mean_and_scatter("stress_ratio"), rate_exponent=mean("rate_exponent"),
                             v=np.mean([flow.v for flow in flows], axis=0))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sweep", type=pathlib.Path, default=HOME / "sweeps/chute")
    parser.add_argument("--draw", type=pathlib.Path, default=HOME / "docs/flows/chute.svg")
    options = parser.parse_args()
    flows = sorted(map(mean_flow, runs_by_setting(options.sweep)), key=lambda flow: (flow.inclination, flow.layers))

    print("| inclination | layers | state | velocity, m/s | H, mm | area fraction of the bulk | stress ratio over tan | "
          "exponent of the shear rate |")
    print("|--:|--:|---|--:|--:|--:|--:|--:|")
    for f in flows:
        at_rest = abs(f.velocity.value) < 1e-6
        state = "at rest" if at_rest else f.state
        velocity = 0 if at_rest else f.velocity if "accelerating" not in state else f"{f.velocity.value:.4g}"
        exponent = "" if np.isnan(f.rate_exponent.value) else f.rate_exponent
        print(f"| {f.inclination:.0f} | {f.layers:.0f} | {state} | {velocity} | {1e3 * f.height.value:.1f} | "
              f"{f.area_fraction} | {f.stress_ratio} | {exponent} |")
    for angle in sorted({f.inclination for f in flows}):
        same = [f for f in flows if f.inclination == angle and f.velocity.value > 0.01]
        if len(same) > 2:
            power = slope(np.array([f.height.value for f in same]), np.array([f.velocity.value for f in same]))
            print(f"\nexponent of the mean velocity over H at {angle:.0f} degrees: {power}")

    figure, axis = plt.subplots(figsize=(6.0, 4.0))
    for f in flows:
        inside = f.x < f.height.value
        axis.plot(f.v[inside], 1e3 * f.x[inside], ".-", label=f"{f.inclination:.0f}°, {f.layers:.0f} layers")
    axis.set(xlabel="velocity down the slope, m/s", ylabel="height above the bottom, mm")
    axis.legend(frameon=False)
    figure.savefig(options.draw, bbox_inches="tight")


if __name__ == "__main__":
    main()
