"""Means with their error bars."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Estimate(NamedTuple):
    """A mean with its 68 % error bar; NaN where it is not known."""

    value: float
    error: float

    def __str__(self) -> str:
        """Two digits of the error, and the value as far: "1.534 +- 0.050"."""
        if 0.0 < self.error < math.inf:
            decimals = 1 - math.floor(math.log10(self.error))
            if decimals <= 6:
                return f"{self.value:.{max(0, decimals)}f} +- {self.error:.{max(0, decimals)}f}"
            order = math.floor(math.log10(abs(self.value))) if self.value else -decimals
            return f"{self.value:.{max(1, order + decimals)}e} +- {self.error:.1e}"
        return f"{self.value:.4g} +- {self.error:.2g}"

    def __sub__(self, other: "Estimate") -> "Estimate":
        """The difference of two independent means."""
        return Estimate(self.value - other.value, math.hypot(self.error, other.error))


def mean_of(values: Sequence[float]) -> Estimate:
    """The mean of independent values, such as those of runs that differ in their seeds. Its error is
    the standard error by their scatter times Student's 68 % point: three know little of their own
    scatter. NaN of a single one."""
    n = len(values)
    if n == 0:
        return Estimate(math.nan, math.nan)
    mean = float(np.mean(values))
    if n == 1:
        return Estimate(mean, math.nan)
    return Estimate(mean, _student_68(n - 1) * float(np.std(values, ddof=1)) / math.sqrt(n))


def _student_68(freedom: int) -> float:
    """Student's two-sided point of 68.27 %, one standard deviation of the normal distribution: exact
    for one degree of freedom, else by the expansion of Cornish and Fisher, to 0.001."""
    if freedom == 1:
        return math.tan(0.5 * math.pi * math.erf(math.sqrt(0.5)))
    return 1.0 + (0.5 + (0.25 + 0.0625 / freedom) / freedom) / freedom
