"""Runs of the tube from the kept tables, and what several seeds say together."""
import dataclasses
from collections import Counter

import numpy as np
from scipy import stats

from results import rows_of

WORDS = ("branch", "leg", "state", "verdict", "commit")
VERDICTS = ("valid", "suspect", "unphysical")  # from good to bad


class Run:
    """A row of a kept table, see keep.py; SI units."""

    def __init__(self, row):
        for key, text in row.items():
            setattr(self, key, text if key in WORDS else float(text or "nan"))

    def __getattr__(self, name):  # only asked for what __init__ has not set
        raise AttributeError(f"the kept table has no column {name}")

    @property
    def settled(self):
        """No trend, and the wall carries the weight, eq. (9), within two error bars and three per cent."""
        return self.state in ("steady", "too_short") and abs(self.share - 1) < 2 * self.share_error + 0.03

    @property
    def stays_slow(self):
        """Settled where the walls brake by collisions, and not by contacts that are passed through."""
        return self.settled and self.brake_failure < 0.5


def runs_of(table):
    return [Run(row) for row in rows_of(table)]


def at_default_spacing(runs):
    """1.2 mm, adjusted to the length."""
    return [run for run in runs if abs(run.spacing - 1.2e-3) < 0.05e-3]


def mean_of_seeds(values, errors):
    """Mean and standard error, 68 %: Student's t for the few; of a single run its own error bar."""
    if len(values) == 1:
        return values[0], errors[0]
    return np.mean(values), stats.t.ppf(0.8413, len(values) - 1) * np.std(values, ddof=1) / np.sqrt(len(values))


@dataclasses.dataclass
class Group:
    """Runs that differ in nothing but the seed."""
    runs: list

    def __getattr__(self, name):
        return getattr(self.runs[0], name)

    @property
    def settled_runs(self):
        return [run for run in self.runs if run.settled]

    @property
    def is_settled(self):
        return len(self.settled_runs) == len(self.runs)

    @property
    def is_steady(self):
        """All seeds settled, with 20 independent samples among them, as the verdict on one run asks for."""
        return self.is_settled and sum(run.independent_samples for run in self.runs) >= 20

    def mean(self, name):
        """Over the settled runs; mean and 68 % error."""
        runs = self.settled_runs
        return mean_of_seeds([getattr(r, name) for r in runs], [getattr(r, f"{name}_error", np.nan) for r in runs])

    def last(self, name):
        """Mean over all seeds in the last fifth of the run."""
        return np.mean([getattr(run, f"{name}_5") for run in self.runs])

    @property
    def states(self):
        counts = Counter(run.state.replace("_", " ") for run in self.runs)
        return next(iter(counts)) if len(counts) == 1 else ", ".join(f"{n} {state}" for state, n in counts.items())

    @property
    def worst_verdict(self):
        return max((run.verdict for run in self.runs), key=VERDICTS.index)


def groups_of(runs, *keys):
    """Groups of equal `keys`, in the order of the table."""
    found = {}
    for run in runs:
        found.setdefault(tuple(getattr(run, key) for key in keys), []).append(run)
    return [Group(members) for members in found.values()]


def plus_minus(value, error):
    """1.234 ± 0.056: two digits of the error."""
    if not np.isfinite(error) or error <= 0:
        return f"{value:.3g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f}"
