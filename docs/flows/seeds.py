"""Runs of a sweep that differ in their seeds alone. Also makes the package riesel of the checkout known."""
import pathlib
import sys
from collections import Counter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import riesel


def runs_by_setting(sweep):
    """[runs that are done and differ in the seed alone, each once], in the order of the sweep file."""
    groups = ([point.run for point in group if point.is_done] for group in riesel.Sweep(sweep).groups())
    return [runs for runs in groups if runs]


def mean_of(values):
    """Of several seeds, by their scatter; of a single one, which has an error of its own, that."""
    return values[0] if len(values) == 1 else riesel.mean_of([value.value for value in values])


def states_of(runs):
    """"2 steady, 1 too_short"; one word if all are alike."""
    counts = Counter(run.summary["state"] for run in runs)
    if len(counts) == 1:
        return next(iter(counts))
    return ", ".join(f"{count} {state}" for state, count in counts.most_common())
