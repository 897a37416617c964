#!/usr/bin/env python3
"""Numbers and pictures of the paper's figures from the results of riesel sweep.

    docs/paper/figures.py fig3 fig4_5 fig6_map ...     # prints tables, draws docs/paper/FIGURE.svg

Curves of impacts are read from the sweeps (--sweeps, default sweeps/), the states of the tube from the kept tables
docs/paper/fig6_*.csv. docs/paper/reproduce.sh makes the sweeps first. docs/paper.md quotes the tables as they are
printed.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

from fig6 import fig6, fig6_fast
from fig6_balance import fig6_balance
from fig6_map import fig6_map
from fig6_rigid import fig6_rigid
from fig6_short import fig6_short
from fig6_steps import fig6_steps
from fig6_thresholds import fig6_thresholds
from impacts import fig3, fig4_5
from results import Missing

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent


def main():
    sweeps, out = Path("sweeps"), HERE
    figures = {"fig3": lambda: fig3(sweeps, out, plt),
               "fig4_5": lambda: fig4_5(sweeps, out, plt),
               "fig6": lambda: fig6(HERE, out, plt),
               "fig6_fast": lambda: fig6_fast(HERE, out, plt),
               "fig6_steps": lambda: fig6_steps(HERE, out, plt),
               "fig6_thresholds": lambda: fig6_thresholds(HERE, out, plt),
               "fig6_short": lambda: fig6_short(HERE, out, plt),
               "fig6_map": lambda: fig6_map(HERE, out, plt),
               "fig6_rigid": lambda: fig6_rigid(HERE, out, plt),
               "fig6_balance": lambda: fig6_balance(sweeps, HERE, out, plt)}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures", metavar="FIGURE", nargs="+", choices=figures)
    parser.add_argument("--sweeps", metavar="FOLDER", type=Path, default=sweeps)
    parser.add_argument("--out", metavar="FOLDER", type=Path, default=out, help="for the pictures")
    arguments = parser.parse_args()

    sweeps, out = arguments.sweeps, arguments.out
    matplotlib.rcParams["svg.hashsalt"] = "riesel"  # the same file each time
    for name in arguments.figures:
        figures[name]()


if __name__ == "__main__":
    try:
        main()
    except Missing as missing:
        print(f"figures.py: {missing}", file=sys.stderr)
        sys.exit(1)
