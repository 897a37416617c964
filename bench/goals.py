#!/usr/bin/env python3
"""The goals of speed, and how close kept results come to them: a table in Markdown.

    bench/goals.py                                          all of bench/results
    bench/goals.py --since 2026-11-26 bench/results/*amd*   of these files those of that date, or younger

Files are results of the suite and of bench/peers/run.py, in any order; each name of a machine has a table of its own (that
of AMD EPYC without a family stands for several processors: docs/performance-log.md). What was measured with --quick, with
sources that were changed, or does not agree is left out. Of each result counts the median over its repetitions. A cell has
the median over all files and their range: hours of one machine differ. Bold: each reaches the goal; if only some do, it says
how many of how many. Two runs side by side, which need not wait for each other, tell whether the machine itself had what is
asked of two threads.
"""

import argparse
import statistics
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from compare import PEERS, SUITE, BadInput, load, paired_ratio

KEPT = Path(__file__).resolve().parent / "results"
SIZES = ("1.4k", "10k", "100k", "1M")

STATES = {"tube_start": "start", "tube_slow": "slow tube", "tube_stiff": "stiff tube", "tube_fast": "fast tube",
          "dense_cold": "dense and cold", "dense_sheared": "dense and sheared", "ensemble": "ensemble",
          "start_up": "start-up"}


class Goal(NamedTuple):
    """One row of the table."""
    name: str
    state: str
    source: str  # format of the results that tell
    value: Callable  # of row(variant, size=that of the cell), None if there is none: a number, or None
    limit: Callable  # of the size: what the value is to reach, None if it is asked of other sizes only
    digits: int = 2
    at_most: bool = False

    def reached(self, value, size):
        return value <= self.limit(size) if self.at_most else value >= self.limit(size)


def ratio(over, under):
    """How much faster one variant is than another."""
    def value(row):
        return paired_ratio(row(over), row(under)).value if row(over) and row(under) else None
    return value


def speed(row):
    return row["per_second"]["median"]


def automatic_beside_one_thread(row):
    """`auto` over the faster of plain stepping and windows on one thread."""
    alone = [row(variant) for variant in ("plain 1", "windows 1") if row(variant)]
    return paired_ratio(row("automatic"), max(alone, key=speed)).value if row("automatic") and alone else None


def growth(variant):
    """Cost of a particle-step over that with 1.4 k grains."""
    def value(row):
        small, large = row(variant, "1.4k"), row(variant)
        return speed(small) / speed(large) if small and large else None
    return value


def column(variant, name, factor=1.0):
    def value(row):
        number = (row(variant) or {}).get(name)
        return None if number is None else factor * number
    return value


def seconds(variant):
    return lambda row: row(variant)["seconds"]["median"] if row(variant) else None


def everywhere(limit):
    return lambda size: limit


def up_to_100k(limit):
    return lambda size: limit if size != "1M" else None


def at_a_million(limit):
    return lambda size: limit if size == "1M" else None


def threads(size):
    return 1.8 if size == "1.4k" else 1.9


def goals():
    rows = []
    for state, limit in (("tube_slow", 3), ("tube_stiff", 20), ("tube_fast", 1.5), ("dense_cold", 0.95)):
        rows.append(Goal(f"windows {limit:g} times plain", state, SUITE, ratio("windows 1", "plain 1"), up_to_100k(limit)))
    for state in ("tube_slow", "tube_stiff", "tube_fast", "dense_cold", "dense_sheared"):
        rows.append(Goal("plain twice the scalar code", state, SUITE, ratio("plain 1", "scalar"), up_to_100k(2.0)))
    for cores in (1, 2):
        for state in ("tube_start", "tube_slow", "tube_stiff", "dense_sheared"):
            rows.append(Goal(f"plain 3 times LAMMPS, {'one core' if cores == 1 else 'two cores'}", state, PEERS,
                             ratio(f"riesel plain {cores}", f"lammps {cores}"), everywhere(3.0), digits=1))
    for state, limit in (("tube_start", 10), ("tube_slow", 10), ("tube_stiff", 60)):
        rows.append(Goal(f"windows {limit} times LAMMPS, one core", state, PEERS, ratio("riesel windows 1", "lammps 1"),
                         everywhere(limit), digits=1))
    for name, two in (("two threads 1.8 (1.4 k) and 1.9 times one", "2"), ("the same with a part each", "2 apart"),
                      ("the same of two runs side by side", "2 runs")):
        for variant in ("plain", "windows"):
            for state in ("tube_slow", "tube_stiff", "tube_fast"):
                rows.append(Goal(f"{name}, {variant}", state, SUITE, ratio(f"{variant} {two}", f"{variant} 1"), threads))
    for state in ("tube_slow", "tube_stiff", "tube_fast", "dense_sheared"):
        rows.append(Goal("`auto` 0.95 times the better way on one thread", state, SUITE, automatic_beside_one_thread, everywhere(0.95)))
    rows.append(Goal("two jobs 1.9 times one", "ensemble", SUITE, ratio("jobs 2", "jobs 1"), everywhere(1.9)))
    for variant, name in (("plain 1", "one thread"), ("plain 2", "two")):
        rows.append(Goal(f"plain takes 60 % of the bandwidth, {name}", "tube_slow", SUITE,
                         column(variant, "bandwidth_share", 100.0), at_a_million(60.0), digits=0))
    for variant, name in (("plain 1", "plain"), ("windows 1", "windows")):
        rows.append(Goal(f"cost 2.5 times that of 1.4 k at most, {name}", "tube_slow", SUITE, growth(variant),
                         at_a_million(2.5), at_most=True))
        rows.append(Goal(f"250 bytes per grain at most, {name}", "tube_slow", SUITE, column(variant, "bytes_per_grain"),
                         at_a_million(250.0), digits=0, at_most=True))
    rows.append(Goal("start-up in 3 s at most", "start_up", SUITE, seconds("threads 1"), everywhere(3.0), digits=1,
                     at_most=True))
    return rows


def value_in(results, goal, cell_size):
    def row(variant, size=cell_size):
        return results["rows"].get((goal.state, size, variant))
    return goal.value(row)


def values(goal, size, files):
    """One of each result in which it was measured."""
    if goal.limit(size) is None:
        return []
    all_values = [value_in(results, goal, size) for results in files if results["format"] == goal.source]
    return [value for value in all_values if value is not None]


def cell(goal, size, files):
    found = values(goal, size, files)
    if not found:
        return ""

    def number(value):
        return f"{value:.{goal.digits}f}"

    reached = sum(goal.reached(value, size) for value in found)
    text = number(statistics.median(found))
    if len(found) > 1:
        text += f" ({number(min(found))} to {number(max(found))})"
    if reached == len(found):
        return f"**{text}**"
    return f"{text}, {reached} of {len(found)}" if reached else text


def table(files):
    lines = [f"| goal | state | {' | '.join(size.replace('k', ' k').replace('M', ' M') for size in SIZES)} |",
             "|---|---|" + "---|" * len(SIZES)]
    before = None
    for goal in goals():
        cells = [cell(goal, size, files) for size in SIZES]
        if any(cells):
            name = goal.name if goal.name != before else ""
            lines.append(f"| {name} | {STATES[goal.state]} | {' | '.join(cells)} |")
            before = goal.name
    return "\n".join(lines)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE.json", nargs="*", default=sorted(KEPT.glob("*.json")))
    parser.add_argument("--since", metavar="DATE", default="", help="ISO 8601, as far as it matters")
    return parser.parse_args()


def tell_shares_of_the_best_bandwidth(results):
    """Of all measured sets that hold what a step moves: up to 0.8.2 it was that of the smallest, slower in some hours."""
    for row in results["rows"].values():
        if row.get("bandwidth_share") is not None:
            moved = row["bytes_per_particle_step"] * row["grains"]
            best = max(b["bytes_per_second"] for b in results["bandwidth"]
                       if b["threads"] == row["threads"] and b["working_set"] >= moved)
            row["bandwidth_share"] = row["bytes_per_particle_step"] * row["per_second"]["median"] / best


def counts(results):
    cases = results.get("cases", [])
    agreements = [one["agree"] for case in cases for one in case.get("agreements", {}).values()]
    agreements += [case["agreement"]["agree"] for case in cases if "agreement" in case]  # of one code, as it once was
    return all(agreements) and not (results.get("quick") or results["build"]["changed"] or results.get("disagreements"))


def counting(paths, formats):
    """(path, results) of the files whose results count; the others are told."""
    for path in paths:
        results = load(path, formats)
        if counts(results):
            yield path, results
        else:
            print(f"{path}: left out", file=sys.stderr)


def is_beside_lammps(results):
    return any(variant == "lammps 1" for _, _, variant in results["rows"])


def main():
    options = parse()
    machines = {}
    for path, results in counting(options.files, (SUITE, PEERS)):
        if results["date"] >= options.since:
            if not results.get("complete", True):
                print(f"{path}: was not finished", file=sys.stderr)
            tell_shares_of_the_best_bandwidth(results)
            machines.setdefault(results["machine"]["name"], []).append(results)
    tables = []
    for machine, files in machines.items():
        suites, peers = sum(results["format"] == SUITE for results in files), sum(map(is_beside_lammps, files))
        tables.append(f"{machine}: {suites} results of the suite, {peers} beside LAMMPS\n\n{table(files)}")
    if not tables:
        raise BadInput("no result that counts")
    print("\n\n".join(tables))


if __name__ == "__main__":
    try:
        main()
    except BadInput as mistake:
        print(f"goals.py: {mistake}", file=sys.stderr)
        sys.exit(2)
