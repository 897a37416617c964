#!/usr/bin/env python3
"""The small table of a campaign of tubes that is kept in the repository.

    docs/paper/keep.py sweeps/fig6_map docs/paper/fig6_map.csv

A row per run that is done. It has what the sweep's own table lacks: sigma_vx and sigma_vy, also at the wall (the outermost
strips of the profiles) and in the core, the walls as they are (the spacing is adjusted to the length), and five equal windows
of the run, so that a fall that has not ended can be seen from the table: mean velocity, the wall's share of the weight,
sigma_vx and rate of visits to the walls in each.
"""
import argparse
import csv
import json
import sys
from pathlib import Path

import h5py
import numpy as np

from results import Missing, rows_of
from tube import WINDOWS


def mean_and_error(samples):
    """The mean and its error from the eight slowest cosines, as docs/statistics-methods.md has it, without its allowance for
    short series."""
    n = len(samples)
    if n < 16:
        return np.mean(samples), np.nan
    phase = np.pi / n * np.outer(np.arange(1, 9), np.arange(n) + 0.5)
    slowest = np.sqrt(2 / n) * np.cos(phase) @ (samples - np.mean(samples))
    return np.mean(samples), 1.0665 * np.sqrt(np.mean(slowest**2) / n)


def walls_of(file):
    spacing, line = file["final/walls/spacing"][0], file["final/walls/line"][:]
    return {"length": spacing * file["final/walls/count"][0], "width": line[1] - line[0], "spacing": spacing}


def windows_of(series, mass, grains, gravity):
    """Velocity, the wall's share of the weight, sigma_vx and visits per grain and second in equal parts of the run."""
    columns = {}
    ends = np.linspace(0, len(series["time"]) - 1, WINDOWS + 1).astype(int)
    for i, (begin, end) in enumerate(zip(ends[:-1], ends[1:]), start=1):
        def gain(name):
            return series[name][end] - series[name][begin]
        lasts = gain("time")
        columns |= {f"velocity_{i}": series["mean_vy"][begin:end].mean(),
                    f"share_{i}": -gain("wall_impulse_y") / (mass * gravity * lasts),
                    f"sigma_vx_{i}": series["sigma_vx"][begin:end].mean(),
                    f"visit_rate_{i}": gain("wall_visits") / (grains * lasts)}
    return columns


def zones_of(profiles):
    """sigma_vx, velocity and area fraction of the wall layers and of the core. (The kept tables are of riesel up to 0.12,
    where this sigma_vx includes what all grains do together.)"""
    columns = {}
    for word, zone in (("wall", profiles["wall_layers"]), ("core", profiles["core"])):
        t_x = zone["temperature_x"]
        sigma = t_x["value"] ** 0.5
        columns |= {f"sigma_vx_{word}": sigma, f"sigma_vx_{word}_error": t_x["error"] / (2 * sigma),
                    f"velocity_{word}": zone["mean_axial_velocity"]["value"],
                    f"area_fraction_{word}": zone["area_fraction"]["value"]}
    return columns


def finding(summary, name):
    return next(f["value"] for f in summary["validity"]["findings"] if f["name"] == name)


def row_of(sweep, row):
    directory = sweep / "points" / row["point"]
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    flow, balance, visits = (summary[key] for key in ("mean_axial_velocity", "balance", "wall_visits"))
    gravity, grains = balance["gravity"], summary["grains"]
    with h5py.File(directory / "run.h5") as file:
        series = {name: file["series"][name][:] for name in
                  ("time", "mean_vy", "sigma_vx", "sigma_vy", "wall_impulse_y", "wall_visits")}
        mass, walls = file["final/mass"][:].sum(), walls_of(file)
    late = series["time"] >= summary["transient_end"]
    kept = {"point": row["point"], "k_n": row["contact.stiffness"], "e_n": row["contact.restitution"], **walls,
            "branch": row.get("branch", ""), "start": row.get("start.axial_velocity", ""),
            "leg": row.get("leg", ""), "seed": row["seed"], "grains": grains,
            "steps": row.get("run.steps_per_collision", ""), "attraction": row.get("contact.attraction", ""),
            "time": summary["time"], "time_step": summary["time"] / summary["steps"], "state": summary["state"], "velocity": flow["value"],
            "velocity_error": flow["error"], "independent_samples": summary["independent_samples"],
            "transient_end": summary["transient_end"]}
    for name in ("sigma_vx", "sigma_vy"):
        kept[name], kept[f"{name}_error"] = mean_and_error(series[name][late])
    kept |= zones_of(summary["profiles"])
    kept |= {"share": balance["n_dot_dv_y"] / gravity, "share_error": balance["errors"]["n_dot_dv_y"] / gravity,
             "contact_rate": balance["n_dot"],
             "visit_rate": np.ptp(series["wall_visits"][late]) / (grains * np.ptp(series["time"][late])),
             "visit_dv_y": visits["dv_y"]["value"], "visit_dv_y_error": visits["dv_y"]["error"],
             "visit_dv_x": visits["dv_x"]["value"], "visit_contacts": visits["contacts"]["value"],
             "entry_rate": visits["entry_rate"]["value"],
             "entry_slip": visits["entry_slip"]["value"], "verdict": summary["validity"]["verdict"],
             "brake_failure": summary["validity"]["brake_failure_fraction"],
             "steps_per_contact": finding(summary, "steps_per_contact"),
             "wall_speed": finding(summary, "wall_speed_over_v_crit"), "commit": summary["commit"][:7]}
    return kept | windows_of(series, mass, grains, gravity)


def text_of(value):
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    return f"{value:.5g}" if isinstance(value, float) else value


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sweep", metavar="SWEEP", type=Path)
    parser.add_argument("table", metavar="TABLE.csv", type=Path)
    arguments = parser.parse_args()

    rows = rows_of(arguments.sweep / "sweep.csv")
    kept = [row_of(arguments.sweep, row) for row in rows if row["status"] == "done"]
    if not kept:
        raise Missing(f"{arguments.sweep}: no run is done")
    with open(arguments.table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, kept[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: text_of(value) for key, value in row.items()} for row in kept)
    print(f"{arguments.table}: {len(kept)} of {len(rows)} runs")


if __name__ == "__main__":
    try:
        main()
    except Missing as missing:
        print(f"keep.py: {missing}", file=sys.stderr)
        sys.exit(1)
