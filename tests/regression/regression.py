"""Short runs of the tube whose velocities and hashes are kept: what a change of the program must not
change, or must change on purpose.

    /usr/bin/python3 tests/regression/regression.py renew              # both files anew, minutes
    /usr/bin/python3 tests/regression/regression.py renew hashes       # only one of them
    /usr/bin/python3 tests/regression/regression.py show               # what the kept values can tell

The command is build/release/app/riesel, or what the environment variable RIESEL names. See README.md."""

import argparse
import concurrent.futures
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import h5py
import numpy as np
from scipy import stats

HERE = pathlib.Path(__file__).resolve().parent
COMMAND = os.path.abspath(os.environ.get("RIESEL", HERE.parents[1] / "build/release/app/riesel"))
VELOCITIES, HASHES = HERE / "velocities.json", HERE / "hashes.json"

KEPT_SEEDS = range(1, 25)
TESTED_SEEDS = range(1001, 1005)
HASH_DURATION = 0.02  # s, some 20 000 steps with thousands of contacts

# How often a program that is as good as before, but has other bits, fails in any of the comparisons.
FALSE_ALARMS = 1e-3

BASE = {
    "scenario": "periodic_tube",
    "grains": {"area_fraction": 0.5},
    "tube": {"width": "10 mm", "length": "12 mm"},
}


def linear(stiffness, restitution):
    return {"stiffness": stiffness, "restitution": restitution}


def hertz(stiffness, damping):
    return {"law": "hertz", "stiffness": stiffness, "damping": damping}


def power(stiffness, damping):
    return {"law": "power", "stiffness": stiffness, "damping": damping, "exponent_elastic": 1.2,
            "exponent_overlap": 0.2, "exponent_rate": 1.1}


# name: contact, velocity at the start (m/s), duration (s). On the slow branch runs are steady after
# a tenth of that; on the fast branch contacts at the wall are cut short (docs/validity.md).
SLOW = {
    "slow soft": (linear(200, 0.97), 1, 3.0),
    "slow": (linear(2000, 0.92), 1, 2.0),
    "slow stiff": (linear(200e3, 0.90), 1, 0.8),
    "slow stiff, started fast": (linear(200e3, 0.90), 5, 0.8),
    "slow power": (power(2e4, 1e-2), 1, 1.5),
    "slow Hertz": (hertz(3e6, 0.7), 1, 1.2),
}
FAST = {
    "fast soft": (linear(200, 0.60), 12, 1.5),
    "fast": (linear(2000, 0.60), 25, 1.0),
    "fast power": (power(2e4, 0.5), 12, 0.7),
    "fast Hertz": (hertz(2e5, 10), 8, 1.0),
}
CASES = {**SLOW, **FAST}

# Of grains that rotate only the bits are kept: name as above, and how they rotate.
ROLLING = {
    "slow discs with springs": ({**linear(2000, 0.92), "slip": "spring", "slip_stiffness": 570,
                                 "slip_damping": 100, "rolling_friction": 0.02}, 1, 2.0),
    "slow Hertz spheres": (hertz(3e6, 0.7), 1, 1.2),
}
ROTATION = {"slow discs with springs": "disc", "slow Hertz spheres": "sphere"}
HASH_CASES = {**CASES, **ROLLING}


def run(name, seed, duration=None, **contact):
    """{velocity, state, mean, error, balance, hash, commit} of a run of the case, with other contact settings
    if there are any. velocity: mean over the second half of the run, which the program's own
    statistics have no part in; mean and error: those of the program, None for what it does not know."""
    settings, start, usual_duration = HASH_CASES[name]
    grains = {**BASE["grains"], "rotation": ROTATION.get(name, "none")}
    document = {**BASE, "grains": grains, "seed": seed, "contact": {**settings, **contact},
                "start": {"axial_velocity": start}, "run": {"duration": duration or usual_duration}}
    with tempfile.TemporaryDirectory(prefix="riesel-regression-") as home:
        file = pathlib.Path(home, "tube.json")
        file.write_text(json.dumps(document), encoding="utf-8")
        ended = subprocess.run([COMMAND, "run", file, "--out", "out", "--threads", "1"], cwd=home,
                               capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            raise RuntimeError(f"{name}, seed {seed}: {ended.stderr}")
        summary = json.loads(pathlib.Path(home, "out", "summary.json").read_text(encoding="utf-8"))
        with h5py.File(pathlib.Path(home, "out", "run.h5"), "r") as results:
            velocities = results["series/mean_vy"][()]
    return {"velocity": float(velocities[len(velocities) // 2:].mean()),
            "state": summary["state"],
            "mean": summary["mean_axial_velocity"]["value"],
            "error": summary["mean_axial_velocity"]["error"],
            "balance": summary["balance"],
            "hash": summary["state_hash"],
            "commit": summary["commit"]}


# --- comparisons ---

def differ(kept, tested, rate):
    """Whether the means of two sets of independent numbers differ, by Student's t test, which finds
    a difference where there is none at this rate."""
    return stats.ttest_ind(kept, tested).pvalue < rate


def differ_by_own_bars(kept, means, errors, rate):
    """The same where the scatter of the tested numbers is not looked at, but what their own error
    bars promise. Each rests on eight degrees of freedom."""
    kept_error = np.std(kept, ddof=1) / np.sqrt(len(kept))
    error = np.hypot(np.linalg.norm(errors) / len(errors), kept_error)
    return 2 * stats.t.sf(abs(np.mean(means) - np.mean(kept)) / error, 8 * len(errors)) < rate


def smallest_shift(kept, rate, found=0.95):
    """The shift of the mean that the t test finds in so many cases, approximately."""
    n, m = len(kept), len(TESTED_SEEDS)
    freedom = n + m - 2
    error = np.std(kept, ddof=1) * np.sqrt(1 / n + 1 / m)
    return error * (stats.t.isf(rate / 2, freedom) + stats.t.isf(1 - found, freedom))


def rate_of_each():
    """Each case is compared by its scatter, and each on the slow branch by its error bars, too."""
    return FALSE_ALARMS / (len(CASES) + len(SLOW))


# --- the kept files ---

def kept(file):
    return json.loads(file.read_text(encoding="utf-8"))


def machine_type():
    """What the bits may depend on: the start draws random numbers through the C library."""
    return " ".join([platform.machine(), *platform.libc_ver()])


def write(file, part, content, commit):
    command = f"/usr/bin/python3 tests/regression/regression.py renew {part}"
    text = json.dumps({"command": command, "commit": commit, **content}, indent=1)
    file.write_text(text + "\n", encoding="utf-8")


def runs_of(cases, seeds, **options):
    """{name: [results, by seed]}, on all processors."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pending = {name: [pool.submit(run, name, seed, **options) for seed in seeds] for name in cases}
        return {name: [result.result() for result in results] for name, results in pending.items()}


def renew_velocities():
    runs = runs_of(CASES, KEPT_SEEDS)
    columns = ("velocity", "state", "mean", "error")

    def rounded(value):
        return float(f"{value:.6g}") if isinstance(value, float) else value

    cases = {name: {column: [rounded(result[column]) for result in results] for column in columns}
             for name, results in runs.items()}
    write(VELOCITIES, "velocities", {"seeds": list(KEPT_SEEDS), "cases": cases},
          runs["slow"][0]["commit"])


def renew_hashes():
    runs = runs_of(HASH_CASES, [1], duration=HASH_DURATION)
    write(HASHES, "hashes", {"machine_type": machine_type(),
                             "hashes": {name: results[0]["hash"] for name, results in runs.items()}},
          runs["slow"][0]["commit"])


def coverage(case):
    """How many of the kept runs are steady, and how many of those have the ensemble's mean within
    one and two of their own error bars."""
    truth = np.mean(case["velocity"])
    misses = [abs(mean - truth) / error for mean, error, state
              in zip(case["mean"], case["error"], case["state"]) if state == "steady"]
    return len(misses), sum(miss <= 1 for miss in misses), sum(miss <= 2 for miss in misses)


def show():
    cases = kept(VELOCITIES)["cases"]
    print("| case | mean (m/s) | scatter | shift that is found | steady | 1 error | 2 errors |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for name, case in cases.items():
        velocity = np.array(case["velocity"])
        mean = velocity.mean()
        steady, once, twice = coverage(case)
        covered = f"{once} | {twice}" if name in SLOW else " | "
        print(f"| {name} | {mean:.4g} | {100 * velocity.std(ddof=1) / mean:.1f} % "
              f"| {100 * smallest_shift(velocity, rate_of_each()) / mean:.1f} % | {steady} | {covered} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("what", choices=["renew", "show"])
    parser.add_argument("parts", nargs="*", choices=["velocities", "hashes", []])
    options = parser.parse_args()
    if options.what == "show":
        return show()
    parts = options.parts or ["velocities", "hashes"]
    if "velocities" in parts:
        renew_velocities()
    if "hashes" in parts:
        renew_hashes()
    return None


if __name__ == "__main__":
    sys.exit(main())
