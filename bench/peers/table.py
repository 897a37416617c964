#!/usr/bin/env python3
"""riesel beside other codes, of kept results of run.py: a table in Markdown.

    bench/peers/table.py FILE.json...               on one core
    bench/peers/table.py FILE.json... --cores 2

For each code its speed in million particle-steps per second, and how many times as fast riesel is by plain stepping and by
windows on as many cores, with the same law: medians over the repetitions. A row that is in several files is that of the last.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from compare import PEERS, BadInput, load, paired_ratio  # noqa: E402
from goals import SIZES, STATES  # noqa: E402

CODES = {"lammps": ("LAMMPS", ""), "liggghts": ("LIGGGHTS", ""), "yade": ("YADE", ", spring")}  # name, and end of riesel's rows


def number(value):
    """With two digits at least that count."""
    return f"{value:,.0f}" if value >= 20.0 else f"{value:.1f}"


def cells(rows, case, size, cores):
    """Three for each code, empty where it was not measured."""
    found = []
    for code, (_, ending) in CODES.items():
        peer = rows.get((case, size, f"{code} {cores}"))
        ours = [rows.get((case, size, f"riesel {stepping} {cores}{ending}")) for stepping in ("plain", "windows")]
        found.append(number(peer["per_second"]["median"] * 1e-6) if peer else "")
        found += [number(paired_ratio(row, peer).value) if peer and row else "" for row in ours]
    return found


def table(rows, cores):
    lines = ["| state | grains | " + " | ".join(f"{name} | plain | windows" for name, _ in CODES.values()) + " |",
             "|---|---:|" + "---:|" * (3 * len(CODES))]
    for case, state in STATES.items():
        for size in SIZES:
            if any(found := cells(rows, case, size, cores)):
                grains = next(row["grains"] for key, row in rows.items() if key[:2] == (case, size))
                lines.append(f"| {state} | {grains:,} | {' | '.join(found)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE.json", nargs="+")
    parser.add_argument("--cores", type=int, choices=(1, 2), default=1)
    options = parser.parse_args()
    rows = {}
    for path in options.files:
        rows |= load(path, (PEERS,))["rows"]
    print(table(rows, options.cores))


if __name__ == "__main__":
    try:
        main()
    except BadInput as mistake:
        print(f"table.py: {mistake}", file=sys.stderr)
        sys.exit(2)
