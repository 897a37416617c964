"""Impacts of one free grain on fixed wall grains, solved to nearly machine precision.

The equations are piecewise smooth: they change form where a contact begins or ends, where
the slip of a contact reverses or stops, and where the normal force changes sign. Each smooth
piece (a *regime*) is integrated with scipy's adaptive DOP853, the method behind
``solve_ivp(method="DOP853")``, and every change of regime is located on its dense output.
Between contacts the grain flies straight, so the next contact comes from a quadratic.

The stepper is driven step by step because a contact starts at a root of its own end condition
(overlap = 0). A regime is therefore described by guards, quantities that are positive while it
holds: a guard that starts at zero is no event, one that is negative after a step is.

Everything is SI. x points from the wall into the tube, y downstream. Discs do not rotate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import product
from typing import Callable, Iterable, NamedTuple, Protocol

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

RELATIVE_TOLERANCE = 1e-13
ABSOLUTE_TOLERANCE = 1e-15  # in units of the contact distance and of the impact speed
STEP_PER_LAW_TIME = 0.08  # longest step, in units of the time scale of the contact law
STEP_PER_DISTANCE = 0.015  # longest path of one step, in units of the contact distance
FORCE_TOLERANCE = 1e-12  # in units of momentum / time scale of the contact law
MAX_EVENTS = 100_000

State = np.ndarray  # x, y, v_x, v_y
Trajectory = Callable[[float], State]


class ContactLaw(Protocol):
    """A normal force law F_N(xi, d(xi)/dt), repulsive positive."""

    gamma: float

    def normal_force(self, overlap: float, rate: float, reduced_mass: float) -> float:
        """Normal force in N."""

    def time_scale(self, mass: float, speed: float) -> float:
        """Time in s on which the overlap changes."""


@dataclass(frozen=True)
class LinearLaw:
    """Eq. (1): F_N = k_N xi + gamma_N m_red d(xi)/dt; k in N/m, gamma in 1/s."""

    k: float
    gamma: float
    name = "linear"

    def normal_force(self, overlap: float, rate: float, reduced_mass: float) -> float:
        return self.k * overlap + self.gamma * reduced_mass * rate

    def time_scale(self, mass: float, speed: float) -> float:
        return math.sqrt(mass / self.k)


@dataclass(frozen=True)
class HertzLaw:
    """Hertz-Kuwabara-Kono, eq. (3) with alpha = 3/2, beta = 1/2, g = 1:
    F_N = k xi^(3/2) + gamma xi^(1/2) d(xi)/dt; k in N/m^(3/2), gamma in N s/m^(3/2)."""

    k: float
    gamma: float
    name = "hertz"

    def normal_force(self, overlap: float, rate: float, reduced_mass: float) -> float:
        return math.sqrt(max(overlap, 0.0)) * (self.k * overlap + self.gamma * rate)

    def time_scale(self, mass: float, speed: float) -> float:
        return (mass**2 / (self.k**2 * speed)) ** 0.2


@dataclass(frozen=True)
class Wall:
    """Wall grains on the line x = 0: one at y = 0, or an endless row of them at y = k spacing."""

    spacing: float | None = None

    def grains_between(self, y_low: float, y_high: float) -> Iterable[int]:
        """Numbers k of the wall grains whose centres lie between two values of y."""
        if self.spacing is None:
            return range(0, 1)
        first = math.ceil(y_low / self.spacing)
        last = math.floor(y_high / self.spacing)
        return range(first, last + 1)

    def centre(self, k: int) -> float:
        """y of wall grain k in m."""
        return 0.0 if self.spacing is None else k * self.spacing


@dataclass(frozen=True)
class System:
    """What stays the same during an impact. ``reach`` is the sum of the two radii in m, ``mass``
    the mass of the free grain in kg, which is also the reduced mass of a wall contact."""

    law: ContactLaw
    mu: float
    mass: float
    reach: float
    wall: Wall = Wall()
    attraction: str = "keep"


class Frame(NamedTuple):
    """Geometry of a grain at a wall grain: n = (nx, ny) points from the wall grain to the free
    grain, s = (-ny, nx) is n turned by 90 degrees."""

    nx: float
    ny: float
    overlap: float  # xi
    rate: float  # d(xi)/dt, positive while approaching
    slip: float  # v_S


def frame(system: System, k: int, state: State) -> Frame:
    """Split the relative motion at wall grain k into overlap, approach rate and slip."""
    x, y, vx, vy = state
    y -= system.wall.centre(k)
    distance = math.hypot(x, y)
    nx, ny = x / distance, y / distance
    return Frame(nx, ny, system.reach - distance, -(vx * nx + vy * ny), vy * nx - vx * ny)


@dataclass
class Contact:
    """One contact and its regime. ``slip_sign`` is sgn(v_S), 0 while the contact sticks;
    ``force_sign`` is the sign of F_N according to the contact law."""

    k: int
    began: float
    slip_sign: int
    force_sign: int = 1


@dataclass
class Tally:
    """What an impact has touched so far."""

    contacts: int = 0
    contact_time: float = 0.0  # sum of the durations of all contacts, s
    max_overlap: float = 0.0
    slip_stops: int = 0  # how often a slip came to rest (start of sticking)


@dataclass(frozen=True)
class Outcome:
    """Velocity after an impact, its tally, and how it ended: 'away', 'passed' or 'stuck'."""

    vx: float
    vy: float
    tally: Tally
    end_state: str


@dataclass(frozen=True)
class Guard:
    """A quantity that is positive while the present regime holds. ``slope`` is its rate of
    change where that is cheap to know; it serves to find dips that a step jumps over."""

    kind: str
    k: int
    value: Callable[[State], float]
    slope: Callable[[State], float] | None = None


@dataclass
class Episode:
    """The time from the first contact out of free flight to the end of the last overlapping
    one. Time runs from 0 in every episode, which keeps its resolution fine."""

    system: System
    state: State
    speed: float  # of the impact: the scale of velocities
    tally: Tally
    time: float = 0.0
    contacts: list[Contact] = field(default_factory=list)


# --- forces -------------------------------------------------------------------------------


def normal_force(system: System, contact: Contact, at: Frame) -> float:
    """F_N of a contact; with attraction 'clip' a pulling contact exerts none."""
    if system.attraction == "clip" and contact.force_sign < 0:
        return 0.0
    return system.law.normal_force(at.overlap, at.rate, system.mass)


def friction_bound(system: System, contact: Contact, at: Frame) -> float:
    """|mu F_N|, continued smoothly beyond the end of the regime."""
    return system.mu * contact.force_sign * normal_force(system, contact, at)


def force_without_sticking(
    system: System, contacts: list[Contact], state: State
) -> tuple[float, float]:
    """Sum of all normal forces and of the friction of the sliding contacts, eqs. (1) and (2)."""
    fx = fy = 0.0
    for contact in contacts:
        at = frame(system, contact.k, state)
        fn = normal_force(system, contact, at)
        fs = -contact.slip_sign * friction_bound(system, contact, at)
        fx += fn * at.nx - fs * at.ny
        fy += fn * at.ny + fs * at.nx
    return fx, fy


def sticking_load(system: System, contact: Contact, others: list[Contact], state: State) -> float:
    """Tangential force that the rest of the world exerts at a sticking contact."""
    fx, fy = force_without_sticking(system, others, state)
    at = frame(system, contact.k, state)
    return fy * at.nx - fx * at.ny


def total_force(system: System, contacts: list[Contact], state: State) -> tuple[float, float]:
    """Force on the grain. A sticking contact cancels the force along its own tangent; in motion
    at most one contact sticks, since two different tangents leave no direction to move in."""
    fx, fy = force_without_sticking(system, contacts, state)
    for contact in contacts:
        if contact.slip_sign == 0:
            at = frame(system, contact.k, state)
            load = fy * at.nx - fx * at.ny
            fx += load * at.ny
            fy -= load * at.nx
    return fx, fy


# --- friction where the slip is zero ------------------------------------------------------


def settle_friction(episode: Episode, sliding_away: Contact | None = None) -> None:
    """Choose sticking or sliding for the contacts without slip (Filippov).

    At v_S = 0 eq. (2) allows any friction in [-mu |F_N|, mu |F_N|] and d(v_S)/dt is s.F/m. The
    one consistent choice is: a sticking contact needs no more than its bound, a sliding one
    starts to slide against its friction. ``sliding_away`` has just exceeded its bound.
    """
    at_rest = [contact for contact in episode.contacts if contact.slip_sign == 0]
    if not at_rest:
        return
    system, state = episode.system, episode.state
    frames = [frame(system, c.k, state) for c in at_rest]
    bounds = np.array([abs(friction_bound(system, c, at)) for c, at in zip(at_rest, frames)])
    tangents = np.array([[-at.ny, at.nx] for at in frames]).T
    given = np.array(force_without_sticking(system, episode.contacts, state))
    law_time = system.law.time_scale(system.mass, episode.speed)
    tolerance = FORCE_TOLERANCE * system.mass * episode.speed / law_time
    choices = [(1, -1) if c is sliding_away else (0, 1, -1) for c in at_rest]
    for signs in product(*choices):
        if is_consistent(np.array(signs), bounds, tangents, given, tolerance):
            for contact, sign in zip(at_rest, signs):
                contact.slip_sign = sign
            return
    raise RuntimeError("no consistent friction state")


def is_consistent(
    signs: np.ndarray, bounds: np.ndarray, tangents: np.ndarray, given: np.ndarray, tolerance: float
) -> bool:
    """Whether contacts at zero slip can have these slip signs (0 sticks) under a given force."""
    sticks = signs == 0
    force = given - tangents @ (signs * bounds)
    if sticks.any():
        friction = np.linalg.lstsq(tangents[:, sticks], -force, rcond=None)[0]
        force = force + tangents[:, sticks] @ friction
        if (np.abs(friction) > bounds[sticks] + tolerance).any():
            return False
    acceleration = tangents.T @ force
    return bool(
        (signs * acceleration >= -tolerance).all()
        and (np.abs(acceleration[sticks]) <= tolerance).all()
    )


def is_stuck(episode: Episode) -> bool:
    """Whether the grain rests in overlap: two sticking contacts leave no direction to move in,
    and nothing that could change their load changes any more."""
    return sum(contact.slip_sign == 0 for contact in episode.contacts) > 1


# --- guards and events --------------------------------------------------------------------


def regime_guards(episode: Episode) -> list[Guard]:
    """All conditions under which the present set of contacts and signs stays valid."""
    guards: list[Guard] = []
    touching = {c.k for c in episode.contacts}
    for contact in episode.contacts:
        guards += contact_guards(episode, contact)
    for k in reachable_grains(episode):
        if k not in touching:
            guards.append(begin_guard(episode.system, k))
    return guards


def reachable_grains(episode: Episode) -> Iterable[int]:
    """Wall grains that can be met while the first of the present contacts lasts."""
    system = episode.system
    centre = system.wall.centre(episode.contacts[0].k)
    return system.wall.grains_between(centre - 2 * system.reach, centre + 2 * system.reach)


def begin_guard(system: System, k: int) -> Guard:
    """A wall grain not touched has xi < 0."""
    return Guard(
        "begin",
        k,
        lambda state: -frame(system, k, state).overlap,
        lambda state: -frame(system, k, state).rate,
    )


def contact_guards(episode: Episode, contact: Contact) -> list[Guard]:
    """Conditions of one contact: overlap, sign of the force, and slip sign or sticking."""
    system, k = episode.system, contact.k
    law_sign, slip_sign = contact.force_sign, contact.slip_sign
    guards = [
        Guard(
            "end",
            k,
            lambda state: frame(system, k, state).overlap,
            lambda state: frame(system, k, state).rate,
        )
    ]
    if system.law.gamma > 0.0:
        guards.append(Guard("force_sign", k, lambda state: law_sign * law_force(system, k, state)))
    if slip_sign != 0:
        guards.append(Guard("slip", k, lambda state: slip_sign * frame(system, k, state).slip))
    elif len(episode.contacts) > 1:
        others = [c for c in episode.contacts if c is not contact]
        guards.append(
            Guard("unstick", k, lambda state: sticking_reserve(system, contact, others, state))
        )
    return guards


def law_force(system: System, k: int, state: State) -> float:
    """F_N as the law gives it, before any clipping."""
    at = frame(system, k, state)
    return system.law.normal_force(at.overlap, at.rate, system.mass)


def sticking_reserve(
    system: System, contact: Contact, others: list[Contact], state: State
) -> float:
    """How much more tangential force a sticking contact can bear."""
    bound = friction_bound(system, contact, frame(system, contact.k, state))
    return bound - abs(sticking_load(system, contact, others, state))


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Zero of a function between two times, to the last digits."""
    return float(brentq(function, low, high, xtol=1e-24, rtol=1e-15, maxiter=500))


def first_failure(guard: Guard, path: Trajectory, begin: float, end: float) -> float | None:
    """Time within a step at which a guard becomes negative, or None."""
    if guard.value(path(end)) < 0.0:
        failed = end
    else:
        dip = dip_time(guard, path, begin, end)
        if dip is None or guard.value(path(dip)) >= 0.0:
            return None
        failed = dip
    good = begin
    if guard.value(path(good)) <= 0.0:  # a guard may start at zero, where its regime began
        good += 1e-6 * (failed - begin)
        if guard.value(path(good)) <= 0.0:
            return begin
    return root(lambda t: guard.value(path(t)), good, failed)


def dip_time(guard: Guard, path: Trajectory, begin: float, end: float) -> float | None:
    """Time of a minimum of the guard inside a step, where its slope is known."""
    if guard.slope is None:
        return None
    slope = guard.slope
    if slope(path(begin)) < 0.0 < slope(path(end)):
        return root(lambda t: slope(path(t)), begin, end)
    return None


def may_fail(guard: Guard, before: State, after: State) -> bool:
    """Cheap test whether a step needs its dense output for this guard."""
    if guard.value(after) < 0.0:
        return True
    return guard.slope is not None and guard.slope(before) < 0.0 < guard.slope(after)


# --- integration --------------------------------------------------------------------------


def make_stepper(episode: Episode) -> DOP853:
    """DOP853 for the equation of motion of the present regime. The steps are kept short against
    the contact law and the geometry, so that no guard can fail and recover unseen."""
    system, contacts, speed = episode.system, list(episode.contacts), episode.speed

    def motion(_: float, state: State) -> State:
        fx, fy = total_force(system, contacts, state)
        return np.array([state[2], state[3], fx / system.mass, fy / system.mass])

    return DOP853(
        motion,
        episode.time,
        episode.state,
        t_bound=math.inf,
        max_step=min(
            STEP_PER_LAW_TIME * system.law.time_scale(system.mass, speed),
            STEP_PER_DISTANCE * system.reach / speed,
        ),
        rtol=RELATIVE_TOLERANCE,
        atol=ABSOLUTE_TOLERANCE * np.array([system.reach, system.reach, speed, speed]),
    )


def run_regime(episode: Episode) -> Guard:
    """Integrate until the first guard fails, and return that guard."""
    guards = regime_guards(episode)
    stepper = make_stepper(episode)
    while True:
        stepper.step()
        if stepper.status == "failed":
            raise RuntimeError("step size underflow")
        before, path = episode.state, None
        end, failed = stepper.t, None
        if any(may_fail(guard, before, stepper.y) for guard in guards):
            path = stepper.dense_output()
            end, failed = earliest_failure(guards, path, stepper.t_old, stepper.t)
        after = stepper.y if failed is None else path(end)
        track_overlap(episode, stepper, end, after)
        episode.time, episode.state = end, after
        if failed is not None:
            return failed


def earliest_failure(
    guards: list[Guard], path: Trajectory, begin: float, end: float
) -> tuple[float, Guard | None]:
    """The guard that fails first within a step and when; the end of the step if none does."""
    first, failed = end, None
    for guard in guards:
        time = first_failure(guard, path, begin, end)
        if time is not None and (failed is None or time < first):
            first, failed = time, guard
    return first, failed


def track_overlap(episode: Episode, stepper: DOP853, end: float, after: State) -> None:
    """Record the largest overlap on the way from the start of a step to ``end``."""
    system, before = episode.system, episode.state
    for contact in episode.contacts:
        k = contact.k
        peak = after
        if frame(system, k, before).rate > 0.0 > frame(system, k, after).rate:
            path = stepper.dense_output()
            peak = path(root(lambda t: frame(system, k, path(t)).rate, stepper.t_old, end))
        episode.tally.max_overlap = max(episode.tally.max_overlap, frame(system, k, peak).overlap)


def change_regime(episode: Episode, failed: Guard) -> None:
    """Enter the regime that follows the failure of a guard. Every change can shift the load of
    the contacts without slip, so that they are settled anew each time."""
    if failed.kind == "begin":
        begin_contact(episode, failed.k)
    contact = find_contact(episode, failed.k)
    if failed.kind == "end":
        end_contact(episode, contact)
    elif failed.kind == "force_sign":
        contact.force_sign *= -1
    elif failed.kind == "slip":
        stop_slip(episode, contact)
    settle_friction(episode, sliding_away=contact if failed.kind == "unstick" else None)
    if failed.kind == "slip" and contact.slip_sign == 0:
        episode.tally.slip_stops += 1


def find_contact(episode: Episode, k: int) -> Contact:
    """The present contact with wall grain k."""
    return next(contact for contact in episode.contacts if contact.k == k)


def begin_contact(episode: Episode, k: int) -> None:
    """An overlap begins. A slip that is zero to rounding is zero."""
    slip = frame(episode.system, k, episode.state).slip
    slip_sign = 0 if abs(slip) < 1e-14 * episode.speed else int(math.copysign(1, slip))
    episode.contacts.append(Contact(k, episode.time, slip_sign))
    episode.tally.contacts += 1


def end_contact(episode: Episode, contact: Contact) -> None:
    """An overlap ends."""
    episode.contacts.remove(contact)
    episode.tally.contact_time += episode.time - contact.began


def stop_slip(episode: Episode, contact: Contact) -> None:
    """The slip of a contact reaches zero: the velocity is along its normal. If another contact
    sticks already, the velocity is along both normals, hence zero, and so are all slips."""
    state = episode.state.copy()
    if any(c.slip_sign == 0 for c in episode.contacts):
        state[2:] = 0.0
        for other in episode.contacts:
            other.slip_sign = 0
    else:
        at = frame(episode.system, contact.k, state)
        state[2:] = -at.rate * at.nx, -at.rate * at.ny
        contact.slip_sign = 0
    episode.state = state


# --- a whole impact -----------------------------------------------------------------------


def run_episode(episode: Episode, k: int) -> None:
    """Follow the grain from the begin of a contact until it touches nothing or is stuck."""
    begin_contact(episode, k)
    for _ in range(MAX_EVENTS):
        change_regime(episode, run_regime(episode))
        if not episode.contacts or is_stuck(episode):
            return
    raise RuntimeError("too many events")


def next_contact(system: System, state: State) -> tuple[float, int] | None:
    """Time until the free flight ends in a contact, and the wall grain it hits."""
    y_low, y_high = flight_span(system, state)
    hits = (
        (time, k)
        for k in system.wall.grains_between(y_low - system.reach, y_high + system.reach)
        if (time := time_to_touch(system, k, state)) is not None
    )
    return min(hits, default=None)


def flight_span(system: System, state: State) -> tuple[float, float]:
    """Range of y in which a straight flight is near enough to the wall line to touch it."""
    x, y, vx, vy = state
    if vx == 0.0:  # along the wall: one period holds the next contact, if there is any
        ahead = math.copysign(system.wall.spacing or 0.0, vy)
    else:
        ahead = vy * max((math.copysign(system.reach, vx) - x) / vx, 0.0)
    return min(y, y + ahead), max(y, y + ahead)


def time_to_touch(system: System, k: int, state: State) -> float | None:
    """Smaller root t of |position + velocity t - centre| = reach, None if there is none ahead."""
    x, y, vx, vy = state
    y -= system.wall.centre(k)
    approach = -(x * vx + y * vy)
    speed_squared = vx * vx + vy * vy
    gap = max((math.hypot(x, y) - system.reach) * (math.hypot(x, y) + system.reach), 0.0)
    discriminant = approach * approach - speed_squared * gap
    if approach <= 0.0 or discriminant <= 0.0:
        return None
    return gap / (approach + math.sqrt(discriminant))


def fly(state: State, time: float) -> State:
    """Straight flight; there is no gravity in the impact scenarios."""
    x, y, vx, vy = state
    return np.array([x + vx * time, y + vy * time, vx, vy])


def collide(system: System, x: float, y: float, vx: float, vy: float) -> Outcome:
    """One impact: from a state in free flight until nothing is ahead, or the grain is stuck."""
    state = np.array([x, y, vx, vy])
    speed = math.hypot(vx, vy)
    tally = Tally()
    while (hit := next_contact(system, state)) is not None:
        time, k = hit
        episode = Episode(system, fly(state, time), speed, tally)
        run_episode(episode, k)
        state = episode.state
        if episode.contacts:
            tally.contact_time += sum(episode.time - c.began for c in episode.contacts)
            return Outcome(0.0, 0.0, tally, "stuck")
    end_state = "passed" if system.wall.spacing is not None and state[2] < 0.0 else "away"
    return Outcome(float(state[2]), float(state[3]), tally, end_state)
