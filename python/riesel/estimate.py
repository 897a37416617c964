"""Means with their error bars."""

from __future__ import annotations

import math
from collections.abc import Sequence
from numbers import Real
from typing import NamedTuple, NoReturn

import numpy as np


class _ValueAndError(NamedTuple):
    value: float
    error: float


class Estimate(_ValueAndError):
    """A mean with its 68 % error bar; NaN where it is unknown. Sums and differences take the means
    for independent, and plain numbers, also as factors, for exact. Two estimates cannot be
    multiplied or divided, as means of one run depend on each other."""

    __slots__ = ()
    __array_ufunc__ = None  # so that numpy numbers on the left use the operators below

    def __array__(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("estimates cannot be turned into an array, which would mix error bars with "
                        "values; use [estimate.value for estimate in estimates]")

    def __format__(self, form: str) -> str:
        return f"{self.value:{form}} +- {self.error:{form}}" if form else str(self)

    def __str__(self) -> str:
        """The error to two digits, and the value to the same place: "1.534 +- 0.050"."""
        if 0.0 < self.error < math.inf and math.isfinite(self.value):
            # Of the error as it is printed: 0.0996 becomes 0.10.
            decimals = 1 - int(f"{self.error:.1e}".partition("e")[2])
            if decimals < 0:
                return f"{round(self.value, decimals):.0f} +- {round(self.error, decimals):.0f}"
            if decimals <= 6:
                return f"{self.value:.{decimals}f} +- {self.error:.{decimals}f}"
            order = math.floor(math.log10(abs(self.value))) if self.value else -decimals
            return f"{self.value:.{max(1, order + decimals)}e} +- {self.error:.1e}"
        return f"{self.value:.4g} +- {self.error:.2g}"

    # The reversed ones are needed too: a tuple's would join and repeat instead.

    def __add__(self, other: object) -> Estimate:
        if isinstance(other, Estimate):
            return Estimate(self.value + other.value, math.hypot(self.error, other.error))
        if isinstance(other, Real):
            return Estimate(self.value + float(other), self.error)
        return NotImplemented

    def __radd__(self, other: object) -> Estimate:
        return self + other

    def __sub__(self, other: object) -> Estimate:
        if isinstance(other, (Estimate, Real)):
            return self + -1.0 * other
        return NotImplemented

    def __rsub__(self, other: object) -> Estimate:
        return -1.0 * self + other

    def __mul__(self, other: object) -> Estimate:
        if isinstance(other, Real):
            return Estimate(self.value * float(other), self.error * abs(float(other)))
        return NotImplemented

    def __rmul__(self, other: object) -> Estimate:
        return self * other

    def __truediv__(self, other: object) -> Estimate:
        if isinstance(other, Real):
            return Estimate(self.value / float(other), self.error / abs(float(other)))
        return NotImplemented

    def __neg__(self) -> Estimate:
        return -1.0 * self


def mean_of(values: Sequence[float]) -> Estimate:
    """The mean of independent values, such as those of runs that differ in their seeds. Its error
    is the standard error times Student's 68 % point, because a few values know little of their own
    scatter; NaN for a single value. Raises TypeError for anything but plain numbers."""
    n = len(values)
    if not all(isinstance(value, Real) for value in values):
        raise TypeError("mean_of takes numbers; pass the values of estimates, as in "
                        "mean_of([estimate.value for estimate in estimates])")
    if n == 0:
        return Estimate(math.nan, math.nan)
    mean = float(np.mean(values))
    if n == 1:
        return Estimate(mean, math.nan)
    return Estimate(mean, _student_68(n - 1) * float(np.std(values, ddof=1)) / math.sqrt(n))


def _student_68(freedom: int) -> float:
    """Student's two-sided 68.27 % point (one standard deviation if the distribution were normal):
    exact for one degree of freedom, else by the Cornish-Fisher expansion, to 0.001."""
    if freedom == 1:
        return math.tan(0.5 * math.pi * math.erf(math.sqrt(0.5)))
    return 1.0 + (0.5 + (0.25 + 0.0625 / freedom) / freedom) / freedom
