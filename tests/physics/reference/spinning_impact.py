#!/usr/bin/python3
"""Impacts of two discs that may spin, with Cundall and Strack's tangential spring: the table spinning.csv.

    python3 spinning_impact.py           rewrites the table
    python3 spinning_impact.py --check   recomputes it and compares within 1e-8; exit status 1 on a difference

Shares no line with the engine: scipy's DOP853, cut into smooth pieces where the contact begins to slide or to
stick and where the normal force changes its sign. While it sticks the spring is a variable of its own; while it
slides the spring is what the limit mu |F_N| leaves of it. Everything is SI.

The state is that of the second body relative to the first: x, y, vx, vy, the two spins, the spring.
"""

from __future__ import annotations

import csv
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

TABLE = Path(__file__).resolve().parent / "spinning.csv"
COLUMNS = ["k", "gamma", "k_t", "gamma_t", "mu", "inertia", "radius_1", "radius_2", "mass_1", "mass_2", "x", "y",
           "vx", "vy", "w_1", "w_2", "vx_after", "vy_after", "w_1_after", "w_2_after", "contact_time", "slides",
           "sticks", "begins"]
ABOUT = """\
# Body 2 meets body 1 (which stands still, at the origin) from (x, y) with the velocity (vx, vy); both are discs or
# spheres of the moment of inertia `inertia` m r^2 (0: they do not turn) with spins w_1, w_2, positive from x towards y.
# mass_1 = inf: body 1 is a wall grain, which stays as it is. Linear law, attraction keep; k, k_t in N/m, gamma and
# gamma_t in 1/s per reduced mass. After: velocity of 2 relative to 1, spins. slides, sticks: changes of the regime;
# begins: the first of them."""


@dataclass
class Pair:
    k: float
    gamma: float
    k_t: float
    gamma_t: float
    mu: float
    inertia: float
    radii: tuple[float, float]
    masses: tuple[float, float]

    def __post_init__(self):
        per_mass = [1.0 / m for m in self.masses]  # 0 for the wall
        self.mass = 1.0 / sum(per_mass)
        self.sign = 1.0  # of the normal force
        self.reach = sum(self.radii)
        self.arms = [r / self.reach for r in self.radii]
        self.per_inertia = [p / (self.inertia * r * r) if self.inertia else 0.0
                            for p, r in zip(per_mass, self.radii)]

    def look(self, state, slides):
        """What holds in a state; `slides` is the sign of a spring that is cut off at the limit, 0 if it is not."""
        x, y, vx, vy, w_1, w_2, spring = state
        d = math.hypot(x, y)
        nx, ny = x / d, y / d
        along, across = vx * nx + vy * ny, -vx * ny + vy * nx  # of n, and of s = (-ny, nx)
        slip = -across + d * (self.arms[0] * w_1 + self.arms[1] * w_2)  # of the surface of 1 relative to 2, along s
        normal = self.k * (self.reach - d) - self.gamma * self.mass * along
        limit = self.mu * self.sign * normal
        if slides:
            spring = slides * limit / self.k_t
        pull = self.k_t * spring + self.gamma_t * self.mass * slip
        friction = -max(-limit, min(limit, pull))
        d_second = normal / self.mass + across * across / d
        limit_rate = self.mu * self.sign * (-self.k * along - self.gamma * self.mass * d_second)
        force = friction * -ny - normal * nx, friction * nx - normal * ny  # on body 1
        return dict(overlap=self.reach - d, normal=normal, slip=slip, pull=pull, limit=limit, spring=spring,
                    limit_rate=limit_rate, acceleration=(-force[0] / self.mass, -force[1] / self.mass),
                    torques=[arm * d * friction * p for arm, p in zip(self.arms, self.per_inertia)])

    def motion(self, state, slides):
        at = self.look(state, slides)
        spring_rate = 0.0 if slides else at["slip"]  # of no meaning while it slides
        return [state[2], state[3], *at["acceleration"], *at["torques"], spring_rate]

    def slides(self, state, before):
        """The sign of the spring if it is to slide from here on, where the last regime ended."""
        at = self.look(state, before)
        beyond = abs(self.k_t * at["spring"]) - at["limit"]
        if abs(beyond) > 1e-9 * self.k_t * self.reach:
            return math.copysign(1.0, at["spring"]) if beyond > 0.0 else 0.0
        sign = math.copysign(1.0, at["spring"] if at["spring"] else at["slip"])
        return sign if sign * self.k_t * at["slip"] > at["limit_rate"] else 0.0


def event(function, direction):
    function.terminal, function.direction = True, direction
    return function


def collide(pair, state):
    """From the first touch to the end: state, time, regimes entered."""
    state, time, entered = np.array(state, float), 0.0, []
    pair.sign = 1.0
    slides = pair.slides(state, 0.0)
    begins = "slides" if slides else "sticks"
    step = math.pi * math.sqrt(pair.mass / pair.k) / 200.0
    for _ in range(50):
        events = [event(lambda t, s: pair.look(s, slides)["overlap"], -1),
                  event(lambda t, s: pair.look(s, slides)["limit"] if pair.gamma else 1.0, -1),
                  event(lambda t, s: (lambda a: a["limit"] - abs(a["pull"]))(pair.look(s, slides)), 0)]
        if slides:
            events.append(event(lambda t, s: (lambda a: slides * pair.k_t * a["slip"] - a["limit_rate"])(
                pair.look(s, slides)), -1))
        else:
            events.append(event(lambda t, s: (lambda a: a["limit"] - abs(pair.k_t * s[6]))(pair.look(s, 0.0)), -1))
        # Where friction reaches its limit it has a kink, which is only to be met by the end of a step.
        events[2].terminal = pair.gamma_t > 0.0
        run = solve_ivp(lambda t, s: pair.motion(s, slides), (time, time + 1.0), state, method="DOP853",
                        rtol=1e-12, atol=1e-20, max_step=step, events=events)
        time, state = run.t[-1], run.y[:, -1]
        if slides:
            state[6] = pair.look(state, slides)["spring"]
        if len(run.t_events[0]):
            return state, time, entered, begins
        before = slides
        if len(run.t_events[1]):
            pair.sign = -pair.sign
        if len(run.t_events[3]):
            slides = 0.0 if slides else math.copysign(1.0, state[6])
        # Beyond the event, so that it is not met again; from a change of sign on the limit grows.
        state = state + 1e-9 * step * np.array(pair.motion(state, slides))
        time += 1e-9 * step
        if slides and len(run.t_events[1]):
            slides = pair.slides(state, slides)
        if slides != before:
            entered.append("slides" if slides else "sticks")
    raise RuntimeError("the regimes chatter")


def rows():
    radius, mass = 0.5e-3, 1e-6
    small, wall = (0.4e-3, 0.6e-6), (0.33e-3, math.inf)
    k = 2000.0
    for name, other in [("equal", (radius, mass)), ("unequal", small), ("wall", wall)]:
        for inertia in (0.5, 0.4, 0.0):
            for k_t, gamma_t, gamma in [(2 / 7 * k, 0.0, 1e4), (k / 3, 1e4, 1e4), (1.5 * k, 3e3, 0.0),
                                        (0.4 * k, 0.0, 0.0)]:
                for speed, angle, spin in [(1.0, 0.1, 0.0), (1.0, 0.7, 0.0), (1.0, 1.2, 500.0), (2.0, -0.4, -3000.0)]:
                    yield k, gamma, k_t, gamma_t, inertia, other, radius, mass, speed, angle, spin


def table():
    for k, gamma, k_t, gamma_t, inertia, (r_1, m_1), r_2, m_2, speed, angle, spin in rows():
        mu, place = 0.5, 0.6  # the direction from 1 to 2, along no axis
        reach = r_1 + r_2
        nx, ny = math.cos(place), math.sin(place)
        inward, aside = -speed * math.cos(angle), speed * math.sin(angle)
        w_1, w_2 = (0.0 if math.isinf(m_1) else -0.5 * spin), spin
        if inertia == 0.0:
            w_1 = w_2 = 0.0
        pair = Pair(k, gamma, k_t, gamma_t, mu, inertia, (r_1, r_2), (m_1, m_2))
        start = [reach * nx, reach * ny, inward * nx - aside * ny, inward * ny + aside * nx, w_1, w_2, 0.0]
        start = [float(f"{v:.16g}") for v in start]
        end, time, entered, begins = collide(pair, start)
        yield [k, gamma, k_t, gamma_t, mu, inertia, r_1, r_2, m_1, m_2, *start[:6], *end[2:6], time,
               entered.count("slides"), entered.count("sticks"), begins]


def text(value):
    return value if isinstance(value, str) else f"{value:.16g}"


def main():
    fresh = [[text(v) for v in row] for row in table()]
    if "--check" not in sys.argv:
        with TABLE.open("w", newline="") as file:
            file.write(ABOUT + "\n")
            csv.writer(file, lineterminator="\n").writerows([COLUMNS, *fresh])
        return 0
    with TABLE.open() as file:
        kept = list(csv.reader(line for line in file if not line.startswith("#")))[1:]
    for row, old in zip(fresh, kept, strict=True):
        for name, a, b in zip(COLUMNS, row, old):
            if a != b and (name == "begins" or not math.isclose(float(a), float(b), rel_tol=1e-8, abs_tol=1e-9)):
                print(f"{name}: {b} is kept, {a} was found")
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
