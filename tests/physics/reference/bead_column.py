"""The column of beads (scenario bead_column), solved to nearly machine precision.

N equal beads on a line fall with one velocity on a plate at x = 0. Only the gaps between their surfaces matter: gap 0 is that of
the first bead to the plate, gap i that of bead i to bead i - 1. A gap below zero is an overlap, with the force of eq. (1). As long
as the same gaps are overlaps the motion is smooth; each such piece is integrated with scipy's adaptive DOP853, and its end,
where a gap changes its sign, is located on the dense output.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

RELATIVE_TOLERANCE = 1e-12
STEPS_PER_CONTACT = 12.0  # at least
MAX_EVENTS = 100_000


@dataclass(frozen=True)
class Column:
    """k in N/m, gamma in 1/s, mass in kg, gap between neighbours in m, speed in m/s."""

    beads: int
    k: float
    gamma: float
    mass: float
    gap: float
    speed: float

    def reduced_mass(self, i: int) -> float:
        return self.mass if i == 0 else 0.5 * self.mass

    def collision_time(self, i: int) -> float:
        return math.pi / math.sqrt(self.k / self.reduced_mass(i) - self.gamma**2 / 4.0)


@dataclass(frozen=True)
class Outcome:
    restitution: float  # square root of the energy after over that before
    rebound: float  # velocity of the centre of mass after over that before
    contacts: int
    duration: float  # s, from the first contact to the end of the last
    max_overlap: float  # m


def gaps_of(positions: np.ndarray) -> np.ndarray:
    """Of positions without radii: bead i stands at its place minus the lengths of the beads below it."""
    return np.diff(positions, prepend=0.0)


def deepest_between(gap, rate, begin: float, end: float) -> float:
    """Largest overlap of a contact within one step, in which it has one at most."""
    if rate(begin) >= 0.0 or rate(end) <= 0.0:
        return max(-gap(begin), -gap(end))
    return -gap(brentq(rate, begin, end, xtol=1e-300, rtol=1e-15))


def smooth_piece(column: Column, touching: np.ndarray, start: np.ndarray, time: float, longest: float):
    """Up to the first change of `touching`: (time, state, gap that changes or None, largest overlap)."""
    n = column.beads
    masses = np.array([column.reduced_mass(i) for i in range(n)])

    def accelerations(_, state):
        gaps, rates = gaps_of(state[:n]), gaps_of(state[n:])
        forces = np.where(touching, -column.k * gaps - column.gamma * masses * rates, 0.0)
        pushed_back = np.append(forces[1:], 0.0)
        return np.concatenate([state[n:], (forces - pushed_back) / column.mass])

    solver = DOP853(accelerations, time, start, time + longest, rtol=RELATIVE_TOLERANCE,
                    atol=1e-15 * column.speed * column.collision_time(0),
                    max_step=column.collision_time(1) / STEPS_PER_CONTACT if touching.any() else np.inf)
    deepest = 0.0
    while solver.status == "running":
        solver.step()
        path = solver.dense_output()
        changes = []
        for i in range(n):
            # A contact lasts while its gap is negative, a flight while it is positive.
            def margin(t, i=i):
                return gaps_of(path(t)[:n])[i] * (-1.0 if touching[i] else 1.0)
            if margin(solver.t) < 0.0:
                # One that begins in this piece is zero at its start, and grows first.
                probes = [solver.t_old + (solver.t - solver.t_old) * 2.0**-k for k in range(40, -1, -1)]
                low = next((t for t in [solver.t_old, *probes] if margin(t) > 0.0), None)
                at = solver.t_old if low is None else brentq(margin, low, solver.t, xtol=1e-300, rtol=1e-15)
                changes.append((at, i))
        end = min(changes)[0] if changes else solver.t
        for i in np.flatnonzero(touching):
            deepest = max(deepest, deepest_between(lambda t: gaps_of(path(t)[:n])[i], lambda t: gaps_of(path(t)[n:])[i],
                                                   solver.t_old, end))
        if changes:
            return end, path(end), min(changes)[1], deepest
    return solver.t, solver.y, None, deepest


def is_over(column: Column, state: np.ndarray, touching: np.ndarray) -> bool:
    return not touching.any() and bool((gaps_of(state[column.beads:]) >= 0.0).all())


def flight(column: Column, state: np.ndarray) -> tuple[float, int]:
    """s until the next contact begins, and its gap."""
    gaps, rates = gaps_of(state[: column.beads]), gaps_of(state[column.beads:])
    return min((max(0.0, gap) / -rate, i) for i, (gap, rate) in enumerate(zip(gaps, rates)) if rate < 0.0)


def drop(column: Column) -> Outcome:
    """Follows the column until no beads approach each other or the plate any more."""
    n = column.beads
    state = np.concatenate([column.gap * np.arange(1, n + 1), np.full(n, -column.speed)])
    touching = np.zeros(n, dtype=bool)
    time, contacts, first, last, deepest = 0.0, 0, None, 0.0, 0.0
    for _ in range(MAX_EVENTS):
        if is_over(column, state, touching):
            v = state[n:]
            return Outcome(math.sqrt(float((v**2).sum()) / (n * column.speed**2)), float(v.mean()) / column.speed,
                           contacts, last - first, deepest)
        if not touching.any():
            wait, i = flight(column, state)
            state[:n] += wait * state[n:]
            time += wait
        else:
            time, state, i, deep = smooth_piece(column, touching, state, time, 1e3 * column.collision_time(0))
            deepest = max(deepest, deep)
            if i is None:
                raise RuntimeError("a contact without end")
        state[:n] = np.cumsum(np.where(np.arange(n) == i, 0.0, gaps_of(state[:n])))  # the gap is zero now
        touching[i] = not touching[i]
        contacts += int(touching[i])
        first = time if first is None else first
        last = time
    raise RuntimeError("too many events")
