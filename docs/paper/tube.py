"""Runs of the tube from the tables that keep.py has made."""
import sys
from pathlib import Path

import numpy as np

from results import rows_of

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
import riesel

WINDOWS = 5  # equal parts of a run, of which the table has means: velocity_1 to velocity_5, and so on
FEW = 4  # runs, whose own scatter may be small by chance
KNOWN = 0.15  # an error of the wall's share of the weight; with a larger one it agrees with anything
# (N/m, e_N) of starts that stay on the slow branch at 1.2 mm and yet gain velocity, until most of them are lost: fig6_lifetimes.
STILL_GAINING = {(2e5, 0.76)}
WORDS = ("point", "branch", "leg", "state", "attraction", "verdict", "commit")


def is_settled(state, share, share_error):
    """No trend, and the wall carries the weight, eq. (9), within two error bars and three per cent, as far as is known."""
    return state in ("steady", "too_short") and share_error < KNOWN and abs(share - 1) < 2 * share_error + 0.03


class Run:
    """A row of a kept table; its columns are attributes, SI units."""

    def __init__(self, row):
        for key, text in row.items():
            setattr(self, key, text if key in WORDS else float(text or "nan"))

    @property
    def settled(self):
        return is_settled(self.state, self.share, self.share_error)

    @property
    def lost(self):
        """Not on the slow branch any more: it accelerates, the brake works by contacts that are cut short, or the wall
        carries less than half of the weight at the end."""
        return self.state == "accelerating" or self.brake_failure > 0.1 or self.share_5 < 0.5

    @property
    def stays(self):
        return self.settled and not self.lost

    def windows(self, name):
        """Its means in the parts of the run."""
        return [getattr(self, f"{name}_{i}") for i in range(1, WINDOWS + 1)]

    def with_error(self, name):
        return plus_minus(getattr(self, name), getattr(self, f"{name}_error"))


def runs_of(table):
    return [Run(row) for row in rows_of(table)]


def runs_of_all(tables, names):
    """Of several kept tables; campaigns that have not been run have none."""
    return [run for name in names if (tables / f"{name}.csv").exists() for run in runs_of(tables / f"{name}.csv")]


def at_default_spacing(runs):
    """1.2 mm, adjusted to the length."""
    return [run for run in runs if abs(run.spacing - 1.2e-3) < 0.05e-3]


def grouped(runs, *names):
    """[(values of the columns, runs that have them)] in the order in which they come."""
    groups = {}
    for run in runs:
        groups.setdefault(tuple(getattr(run, name) for name in names), []).append(run)
    return list(groups.items())


def mean_of_runs(name, runs):
    """The mean of a column and its error by the scatter of the runs. Of a few runs it is that of their own error bars where
    these have one and it is larger."""
    value, error = riesel.mean_of([getattr(run, name) for run in runs])
    own = float(np.linalg.norm([getattr(run, f"{name}_error", np.nan) for run in runs])) / len(runs)
    return value, own if len(runs) <= FEW and own > error else error


def text_of(value, error):
    """Of one seed, whose scatter is not known, the value."""
    return f"{value:.3g}" if np.isnan(error) else plus_minus(value, error)


def mean_text(name, runs):
    """The mean of a column of these runs with its error."""
    return text_of(*mean_of_runs(name, runs))


def still_gains(run):
    return (run.k_n, run.e_n) in STILL_GAINING


def stay_cells(runs):
    """How many of them stay on the slow branch, and their velocity."""
    stay = [run for run in runs if run.stays]
    velocity = "still gaining" if any(map(still_gains, stay)) else mean_text("velocity", stay) if stay else ""
    return f"{len(stay)} of {len(runs)}", velocity


def steady_of(runs):
    """How many of them have this verdict."""
    return f"{sum(run.state == 'steady' for run in runs)}"


def plus_minus(value, error):
    """1.234 ± 0.056: two digits of the error; the value alone if it has none that is known."""
    if not error > 0:
        return f"{value:.5g}"
    digits = max(0, 1 - int(f"{error:.1e}".partition("e")[2]))  # of the error as it is printed
    return f"{value:.{digits}f} ± {error:.{digits}f}"
