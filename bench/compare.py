#!/usr/bin/env python3
"""Ratios within one result of the benchmark suite, and between two.

    bench/compare.py A.json                 windows/plain, plain/scalar, two threads/one, two jobs/one
    bench/compare.py A.json B.json          the same, and B against A row by row
    bench/compare.py ... --plots FOLDER     pictures besides, speed.svg and ratios.svg (or --format png)

Variants of one case are measured in turns, so that each repetition gives a ratio of its own: what stands here is their
median, and in brackets the least and the largest. Between two files it is the ratio of the medians, and in brackets that
of the slowest repetition of one side to the fastest of the other, and the other way round.
"""

import argparse
import json
import statistics
import sys
from pathlib import Path
from typing import NamedTuple

SUITE, PEERS = "riesel benchmark", "riesel peers"  # formats of results
FORMAT_VERSION = 1  # of both

# name of the ratio, numerator, denominator
RATIOS = [("plain / scalar", "plain 1", "scalar"),
          ("windows / plain", "windows 1", "plain 1"),
          ("plain, 2 threads / 1", "plain 2", "plain 1"),
          ("plain, 2 apart / 1", "plain 2 apart", "plain 1"),
          ("windows, 2 threads / 1", "windows 2", "windows 1"),
          ("windows, 2 apart / 1", "windows 2 apart", "windows 1"),
          ("plain, 2 runs / 1", "plain 2 runs", "plain 1"),
          ("windows, 2 runs / 1", "windows 2 runs", "windows 1"),
          ("plain, 2 threads / 2 runs", "plain 2", "plain 2 runs"),
          ("windows, 2 threads / 2 runs", "windows 2", "windows 2 runs"),
          ("automatic / plain", "automatic", "plain 1"),
          ("2 threads / 1", "threads 2", "threads 1"),
          ("2 jobs / 1", "jobs 2", "jobs 1")]


class BadInput(Exception):
    """A file that is no result of the suite."""


class Ratio(NamedTuple):
    """Of two speeds, with the span that the repetitions leave open."""
    value: float
    least: float
    most: float

    def __str__(self):
        return f"{self.value:8.2f}  [{self.least:.2f} {self.most:.2f}]"


def paired_ratio(row, base):
    """How much faster `row` is than `base`, which was measured in turns with it."""
    ratios = [row["work"] / seconds / (base["work"] / base_seconds)
              for seconds, base_seconds in zip(row["seconds"]["all"], base["seconds"]["all"], strict=True)]
    return Ratio(statistics.median(ratios), min(ratios), max(ratios))


def unpaired_ratio(row, base):
    """How much faster `row` is than `base`, which was measured at another time."""
    def speeds(of):
        times = of["seconds"]
        return [of["work"] / t for t in (times["median"], max(times["all"]), times["min"])]

    (median, slow, fast), (base_median, base_slow, base_fast) = speeds(row), speeds(base)
    return Ratio(median / base_median, slow / base_fast, fast / base_slow)


def load(path, formats=(SUITE,)):
    """The results in a file of one of these formats, rows by (case, size, variant)."""
    try:
        results = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BadInput(f"{path}: cannot be read ({error})") from error
    if not isinstance(results, dict) or results.get("format") not in formats:
        raise BadInput(f"{path}: is no result of the benchmark suite{' nor beside other codes' if PEERS in formats else ''}")
    if results.get("format_version") != FORMAT_VERSION:
        raise BadInput(f"{path}: has version {results.get('format_version')} of the format, "
                       f"known is {FORMAT_VERSION}")
    if missing := {"date", "machine", "build"} - results.keys():
        raise BadInput(f"{path}: is no whole result: {', '.join(sorted(missing))} missing")
    try:
        rows = results["rows"] if "rows" in results else [row for case in results["cases"] for row in case["rows"]]
        results["rows"] = {(r["case"], r["size"], r["variant"]): r for r in rows}
    except (KeyError, TypeError) as missing:
        raise BadInput(f"{path}: is no whole result: {missing}") from missing
    return results


def title(results):
    """One line about where a result comes from."""
    build, machine = results["build"], results["machine"]
    changed = " (changed)" if build["changed"] else ""
    quick = " (quick)" if results["quick"] else ""
    return (f"{build['commit'][:7]}{changed}{quick}, {results['date']}, {machine['cpu']}, {machine['cores']} cores, "
            f"{build['compiler']} {build['flags']}, load {machine['load_average'][0]:.2f}")


def inner_ratios(results):
    """[(case, size, name, Ratio)] of variants measured side by side."""
    rows = results["rows"]
    found = []
    for case, size in dict.fromkeys(key[:2] for key in rows):
        for name, over, under in RATIOS:
            if (case, size, over) in rows and (case, size, under) in rows:
                found.append((case, size, name,
                              paired_ratio(rows[case, size, over], rows[case, size, under])))
    return found


def print_inner(results):
    print(title(results))
    if not results["hashes_agree"]:
        print("NOT THE SAME BITS: " + "; ".join(results["disagreements"]))
    for b in results["bandwidth"]:
        print(f"triad over {b['working_set'] / 2**20:.0f} MiB, threads {b['threads']}: "
              f"{b['bytes_per_second'] * 1e-9:.1f} GB/s")
    for row in results["rows"].values():
        if row["bandwidth_share"] is not None:
            print(f"{row['case']} {row['size']} {row['variant']}: {row['bytes_per_particle_step']:.0f} bytes per "
                  f"particle-step if each step went through all grains, {100 * row['bandwidth_share']:.0f} % of the "
                  "bandwidth")
    print(f"\n{'case':18} {'size':>5}  {'ratio':27} {'median':>8}  span")
    for case, size, name, ratio in inner_ratios(results):
        print(f"{case:18} {size:>5}  {name:27} {ratio}")


def print_growth(results):
    """How the cost of a particle-step grows with the number of grains."""
    print(f"\n{'case':18} {'variant':15} cost of a particle-step: largest size over the cheapest one")
    for case, variants in flow_rows(results).items():
        for variant, rows in variants.items():
            if len(rows) > 1:
                largest, best = max(rows, key=lambda r: r["grains"]), max(rows, key=lambda r: r["per_second"]["median"])
                growth = best["per_second"]["median"] / largest["per_second"]["median"]
                print(f"{case:18} {variant:15} {growth:6.2f}  ({largest['size']} over {best['size']})")


def print_between(a, b):
    print(f"\nB against A\n{'case':18} {'size':>5}  {'variant':22} {'B / A':>8}  span")
    for key, row in b["rows"].items():
        if key not in a["rows"]:
            print(f"{key[0]:18} {key[1]:>5}  {key[2]:22} only in B")
            continue
        base = a["rows"][key]
        # Rows without a start state hash what they come to, which is the same only after as much work.
        same_steps = row["steps_before"] == base["steps_before"] and (row["steps_before"] or row["work"] == base["work"])
        note = "" if row["state_hash"] == base["state_hash"] or not same_steps else "  other bits"
        print(f"{key[0]:18} {key[1]:>5}  {key[2]:22} {unpaired_ratio(row, base)}{note}")
    for key in a["rows"].keys() - b["rows"].keys():
        print(f"{key[0]:18} {key[1]:>5}  {key[2]:22} only in A")


def flow_rows(results):
    """{case: {variant: [row...]}} of the cases with many grains."""
    cases = {}
    for row in results["rows"].values():
        if row["unit"] == "particle-steps":
            cases.setdefault(row["case"], {}).setdefault(row["variant"], []).append(row)
    return cases


def draw_speeds(plt, files, path):
    """Million particle-steps per second over the number of grains, a panel for each case."""
    cases = list(dict.fromkeys(case for _, results in files for case in flow_rows(results)))
    columns = min(3, len(cases))
    rows_of_panels = -(-len(cases) // columns)
    figure, panels = plt.subplots(rows_of_panels, columns, figsize=(3.2 * columns + 1.5, 2.9 * rows_of_panels),
                                  sharex=True, sharey=True, squeeze=False)
    lines = {}
    for axes, case in zip(panels.flat, cases):
        for (name, results), style in zip(files, ("-o", "--s")):
            for color, (variant, rows) in enumerate(flow_rows(results).get(case, {}).items()):
                label = variant if len(files) == 1 else f"{variant}, {name}"
                lines[label], = axes.plot([r["grains"] for r in rows], [r["per_second"]["median"] * 1e-6 for r in rows],
                                          style, color=f"C{color}", markersize=3)
        axes.set(title=case, xscale="log", yscale="log", xlim=(1e3, 1e7), xlabel="grains")
    for axes in panels[:, 0]:
        axes.set_ylabel("million particle-steps / s")
    figure.legend(lines.values(), lines.keys(), fontsize=7, loc="center right")
    save(figure, path, right=1.0 - 1.4 / figure.get_figwidth())


def draw_ratios(plt, files, path):
    """The ratios within each result as bars."""
    labels = list(dict.fromkeys(f"{case} {size}: {name}" for _, results in files
                                for case, size, name, _ in inner_ratios(results)))
    figure, axes = plt.subplots(figsize=(7, 0.8 + 0.18 * len(labels)))
    for shift, (name, results) in enumerate(files):
        ratios = {f"{case} {size}: {label}": ratio for case, size, label, ratio in inner_ratios(results)}
        places = [i + 0.35 * shift for i, label in enumerate(labels) if label in ratios]
        axes.barh(places, [ratios[label].value for label in labels if label in ratios], height=0.35, label=name)
    axes.set_yticks(range(len(labels)), labels, fontsize=6)
    axes.invert_yaxis()
    axes.axvline(1.0, color="0.3", linewidth=0.8)
    axes.set(xscale="log", xlabel="ratio of speeds")
    axes.legend()
    save(figure, path)


def save(figure, path, right=1.0):
    figure.tight_layout(rect=(0.0, 0.0, right, 1.0))
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    print(f"drawn: {path}")


def draw(files, folder, ending):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    matplotlib.rcParams["svg.hashsalt"] = "riesel"  # the same file each time
    folder.mkdir(parents=True, exist_ok=True)
    if any(flow_rows(results) for _, results in files):
        draw_speeds(plt, files, folder / f"speed.{ending}")
    if any(inner_ratios(results) for _, results in files):
        draw_ratios(plt, files, folder / f"ratios.{ending}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", metavar="A.json")
    parser.add_argument("b", metavar="B.json", nargs="?")
    parser.add_argument("--plots", metavar="FOLDER", type=Path)
    parser.add_argument("--format", choices=("svg", "png"), default="svg")
    arguments = parser.parse_args()
    files = [("A", load(arguments.a))] + ([("B", load(arguments.b))] if arguments.b else [])

    for name, results in files:
        print(f"{name}: ", end="")
        print_inner(results)
        print_growth(results)
        print()
    if arguments.b:
        print_between(files[0][1], files[1][1])
    if arguments.plots:
        draw(files, arguments.plots, arguments.format)


if __name__ == "__main__":
    try:
        main()
    except BadInput as mistake:
        print(f"compare.py: {mistake}", file=sys.stderr)
        sys.exit(2)
