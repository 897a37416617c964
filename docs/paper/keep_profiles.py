#!/usr/bin/env python3
"""The profiles of sigma_vx across the tube that are kept in the repository, of the states that fig6_balance.py looks at.

    docs/paper/keep_profiles.py          # sweeps/fig6_slow, fig6_fast -> docs/paper/fig6_profiles.csv

A row per strip of run.h5: the run's point in the tables of keep.py, the middle of the strip in m, sigma_vx and its error in
m/s, area fraction.
"""
import csv
import sys
from pathlib import Path

import h5py
import numpy as np

from fig6_balance import settled_states
from keep import text_of
from results import Missing

HERE = Path(__file__).resolve().parent


def strips_of(run, sweeps):
    directory = next(iter(sweeps.glob(f"fig6_*/points/{run.point}")), None)
    if directory is None:
        raise Missing(f"{sweeps}: no point {run.point}; run docs/paper/reproduce.sh")
    with h5py.File(directory / "run.h5") as file:
        x, t_x, error, area = (file["profiles"][name][:] for name in
                               ("x", "temperature_x", "temperature_x_error", "area_fraction"))
    sigma = np.sqrt(t_x)
    for values in zip(x, sigma, error / (2 * sigma), area):
        yield [run.point, *(text_of(float(value)) for value in values)]


def main():
    runs = settled_states(HERE)
    rows = [row for run in runs for row in strips_of(run, Path("sweeps"))]  # before the kept table goes
    with open(HERE / "fig6_profiles.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("point", "x", "sigma_vx", "sigma_vx_error", "area_fraction"))
        writer.writerows(rows)
    print(f"{HERE / 'fig6_profiles.csv'}: {len(runs)} runs")


if __name__ == "__main__":
    try:
        main()
    except Missing as missing:
        print(f"keep_profiles.py: {missing}", file=sys.stderr)
        sys.exit(1)
