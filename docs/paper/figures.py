#!/usr/bin/env python3
"""Numbers and pictures of the paper's figures from the results of riesel sweep.

    docs/paper/figures.py fig3 fig4_5 fig6_short     # prints tables, draws docs/paper/FIGURE.svg

Curves of impacts are read from the sweeps (--sweeps, default sweeps/), the states of the tube from the kept table
docs/paper/fig6_short.csv. docs/paper/reproduce.sh makes the sweeps first. docs/paper.md quotes the tables as they are
printed.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

from impacts import fig3, fig4_5
from results import Missing
from tube import fig6_short

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures", metavar="FIGURE", nargs="+", choices=("fig3", "fig4_5", "fig6_short"))
    parser.add_argument("--sweeps", metavar="FOLDER", type=Path, default=Path("sweeps"))
    parser.add_argument("--out", metavar="FOLDER", type=Path, default=HERE, help="for the pictures")
    arguments = parser.parse_args()

    matplotlib.rcParams["svg.hashsalt"] = "riesel"  # the same file each time
    figures = {"fig3": lambda: fig3(arguments.sweeps, arguments.out, plt),
               "fig4_5": lambda: fig4_5(arguments.sweeps, arguments.out, plt),
               "fig6_short": lambda: fig6_short(HERE / "fig6_short.csv", arguments.out, plt)}
    for name in arguments.figures:
        figures[name]()


if __name__ == "__main__":
    try:
        main()
    except Missing as missing:
        print(f"figures.py: {missing}", file=sys.stderr)
        sys.exit(1)
