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
from compare import PEERS, BadInput, paired_ratio  # noqa: E402
from goals import SIZES, STATES, counting  # noqa: E402
from peer import riesel_name  # noqa: E402

CODES = ("lammps", "liggghts", "yade")


def number(value):
    """With two digits at least that count."""
    return f"{value:,.0f}" if value >= 20.0 else f"{value:.1f}"


def beside(code, case, cores):
    """The speed of a code, and how many times as fast riesel is: three cells, or None if it was not measured."""
    rows = {row["variant"]: row for row in case["rows"]}
    peer = rows.get(f"{code} {cores}")
    ours = [rows.get(riesel_name(f"{stepping} {cores}", case.get("law", "viscous"))) for stepping in ("plain", "windows")]
    if not (peer and all(ours)):
        return None
    return [number(peer["per_second"]["median"] * 1e-6), *(number(paired_ratio(row, peer).value) for row in ours)]


def table(cases, cores):
    found = {(case["case"], case["size"], code): (case["grains"], cells)
             for case in cases for code in CODES if (cells := beside(code, case, cores))}
    lines = ["| state | grains | " + " | ".join(f"{code.upper()} | plain | windows" for code in CODES) + " |",
             "|---|---:|" + "---:|" * (3 * len(CODES))]
    for case, state in STATES.items():
        for size in SIZES:
            of_codes = [found.get((case, size, code)) for code in CODES]
            if any(of_codes):
                grains = next(grains for grains, _ in filter(None, of_codes))
                cells = [cell for one in of_codes for cell in (one[1] if one else ("", "", ""))]
                lines.append(f"| {state} | {grains:,} | {' | '.join(cells)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE.json", nargs="+")
    parser.add_argument("--cores", type=int, choices=(1, 2), default=1)
    options = parser.parse_args()
    cases = [case for _, results in counting(options.files, (PEERS,)) for case in results["cases"]]
    print(table(cases, options.cores))


if __name__ == "__main__":
    try:
        main()
    except BadInput as mistake:
        print(f"table.py: {mistake}", file=sys.stderr)
        sys.exit(2)
