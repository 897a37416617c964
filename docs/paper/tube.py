"""Runs of the tube from the tables that keep.py has made."""
import numpy as np

from results import rows_of

WINDOWS = 5  # equal parts of a run, of which the table has means: velocity_1 to velocity_5, and so on
WORDS = ("branch", "leg", "state", "verdict", "commit")


class Run:
    """A row of a kept table; its columns are attributes, SI units."""

    def __init__(self, row):
        for key, text in row.items():
            setattr(self, key, text if key in WORDS else float(text or "nan"))

    @property
    def settled(self):
        """No trend, and the wall carries the weight, eq. (9), within two error bars and three per cent."""
        return self.state in ("steady", "too_short") and abs(self.share - 1) < 2 * self.share_error + 0.03

    def with_error(self, name):
        return plus_minus(getattr(self, name), getattr(self, f"{name}_error"))


def runs_of(table):
    return [Run(row) for row in rows_of(table)]


def at_default_spacing(runs):
    """1.2 mm, adjusted to the length."""
    return [run for run in runs if abs(run.spacing - 1.2e-3) < 0.05e-3]


def plus_minus(value, error):
    """1.234 ± 0.056: two digits of the error."""
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f}"
