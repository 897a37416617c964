#!/usr/bin/python3
"""Reference tables of impacts, against which riesel's results are tested.

    python3 impacts.py           rewrites all tables beside this script
    python3 impacts.py --check   recomputes them, compares, exits 1 on a difference

The integrator is soft_impact.py. Each table is one function that lists its impacts; its
parameters go into the head of the file. Everything is SI.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterator

import numpy as np

from bead_column import Column, drop
from soft_impact import ContactLaw, HertzLaw, LinearLaw, Outcome, System, Wall, collide

HERE = Path(__file__).resolve().parent
DIGITS = 12
CLOSED_FORM_TOLERANCE = 1e-9
CHECK_RELATIVE = 1e-8
CHECK_ABSOLUTE = 1e-12  # in units of the largest value of the column
CHECK_SENSITIVITY = 1e-2  # in 1/s: a difference quotient magnifies rounding by 1 / SHIFT

MASS = 1e-6
FREE_RADIUS = 0.5e-3
WALL_RADIUS = 0.33e-3
REACH = FREE_RADIUS + WALL_RADIUS
STIFFNESS = 2000.0
DAMPING = 1e4
FRICTION = 0.5
HERTZ_STIFFNESS = 5e5  # contact time 7.0e-5 s and restitution 0.70 at 1 m/s, see head_on.csv
HERTZ_DAMPING = 3.3
SPACING = 0.66e-3
STARTS = 10
SHIFT = 1e-9  # of the start, for the sensitivity

Value = float | int | str
Row = dict[str, Value]


@dataclass(frozen=True)
class Table:
    """A CSV file: its name, what its head tells, and the function that yields its rows."""

    name: str
    about: str
    rows: Callable[[], Iterator[Row]]


def log_points(first: float, last: float, count: int) -> list[float]:
    """Logarithmically spaced values, rounded so that the table states them exactly."""
    return [float(f"{v:.6g}") for v in np.geomspace(first, last, count)]


def exact(value: float) -> float:
    """The number that the table will state, so that its inputs are the true inputs; never -0."""
    return float(f"{value:.{DIGITS}g}") + 0.0


def changes(outcome: Outcome, vx: float, vy: float) -> Row:
    """Delta v_x = v_x after, away from the wall, plus v_x before, towards it (vx < 0 here);
    Delta v_y = loss of axial velocity."""
    return {"dv_x": outcome.vx - vx, "dv_y": vy - outcome.vy}


def touched(outcome: Outcome) -> Row:
    """The tally of an impact as columns."""
    tally = outcome.tally
    return {
        "contacts": tally.contacts,
        "contact_time": tally.contact_time,
        "max_overlap": tally.max_overlap,
    }


# --- single wall grain --------------------------------------------------------------------

SINGLE_ABOUT = """\
Scenario 1: a free grain (radius 0.5 mm, mass 1 mg) flies past one fixed wall grain (radius
0.33 mm, at the origin) with v_x = 0, its centre at x = 0.82 mm, from upstream (y = -0.13 mm).
mu = 0.5, attraction keep, m_red = mass, no gravity.
"""


def single_wall_grain(laws: list[ContactLaw], speeds: list[float]) -> Iterator[Row]:
    """Scenario 1 for several contact laws."""
    for law in laws:
        system = System(law, FRICTION, MASS, REACH)
        for vy in speeds:
            outcome = collide(system, 0.82e-3, -0.13e-3, 0.0, vy)
            yield {"gamma": law.gamma, "v_y": vy} | changes(outcome, 0.0, vy) | touched(outcome)


def single_linear() -> Iterator[Row]:
    """Scenario 1, eq. (1), with and without damping."""
    laws: list[ContactLaw] = [LinearLaw(STIFFNESS, DAMPING), LinearLaw(STIFFNESS, 0.0)]
    return single_wall_grain(laws, log_points(0.1, 40.0, 40))


def single_hertz() -> Iterator[Row]:
    """Scenario 1, Hertz-Kuwabara-Kono."""
    return single_wall_grain([HertzLaw(HERTZ_STIFFNESS, HERTZ_DAMPING)], log_points(0.1, 40.0, 15))


# --- wall array ---------------------------------------------------------------------------


def wall_array() -> Iterator[Row]:
    """Scenario 2, every single impact."""
    system = System(LinearLaw(STIFFNESS, DAMPING), FRICTION, MASS, REACH, Wall(SPACING))
    for towards in (0.1, 0.3, 0.5):
        for vy in log_points(0.1, 40.0, 12):
            for start in range(STARTS):
                y = start * SPACING / STARTS
                outcome = collide(system, REACH, y, -towards, vy)
                shifted = collide(system, REACH, y + SHIFT, -towards, vy)
                yield (
                    {"v_x": towards, "v_y": vy, "start": start}
                    | changes(outcome, -towards, vy)
                    | touched(outcome)
                    | {
                        "passed": int(outcome.end_state == "passed"),
                        "end_state": outcome.end_state,
                        "sensitivity": abs(shifted.vy - outcome.vy) / SHIFT,
                    }
                )


# --- isolated head-on contacts ------------------------------------------------------------


def head_on() -> Iterator[Row]:
    """Head-on contacts of two grains, or of a grain and the wall (mass_2 = inf)."""
    linear = [(2000.0, 0.0), (2000.0, 1e4), (200.0, 1e4), (2e5, 1e5)]
    for k, gamma in linear:
        for mass_2 in (math.inf, 1e-6, 3e-6):
            yield head_on_row(LinearLaw(k, gamma), "keep", MASS, mass_2, 1.0)
    for k, gamma in linear[1:]:
        yield head_on_row(LinearLaw(k, gamma), "clip", MASS, math.inf, 1.0)
    yield head_on_row(LinearLaw(STIFFNESS, DAMPING), "keep", 0.5e-6, 2e-6, 0.05)
    yield head_on_row(LinearLaw(STIFFNESS, DAMPING), "keep", MASS, math.inf, 10.0)
    for gamma in (0.0, HERTZ_DAMPING):
        for mass_2 in (math.inf, 3e-6):
            for speed in (0.1, 1.0, 10.0):
                yield head_on_row(HertzLaw(HERTZ_STIFFNESS, gamma), "keep", MASS, mass_2, speed)
    yield head_on_row(HertzLaw(HERTZ_STIFFNESS, HERTZ_DAMPING), "clip", MASS, math.inf, 1.0)


def head_on_row(
    law: LinearLaw | HertzLaw, attraction: str, mass_1: float, mass_2: float, speed: float
) -> Row:
    """One head-on contact in the relative coordinate, which moves like a grain of mass m_red."""
    reduced_mass = 1.0 / (1.0 / mass_1 + 1.0 / mass_2)
    system = System(law, FRICTION, reduced_mass, REACH, Wall(), attraction)
    outcome = collide(system, 1.1 * REACH, 0.0, -speed, 0.0)
    row: Row = {
        "law": law.name,
        "attraction": attraction,
        "mass_1": mass_1,
        "mass_2": mass_2,
        "k": law.k,
        "gamma": law.gamma,
        "v": speed,
        "restitution": outcome.vx / speed,
        "contact_time": outcome.tally.contact_time,
        "max_overlap": outcome.tally.max_overlap,
    }
    for column, expected in closed_form(law, attraction, reduced_mass, speed).items():
        if not math.isclose(float(row[column]), expected, rel_tol=CLOSED_FORM_TOLERANCE):
            raise AssertionError(f"{column}: {row[column]} is not {expected} in {row}")
    return row


def closed_form(law: ContactLaw, attraction: str, mass: float, speed: float) -> dict[str, float]:
    """What is known in closed form about a head-on contact."""
    if isinstance(law, LinearLaw):
        return linear_closed_form(law, attraction, mass, speed)
    if law.gamma == 0.0:
        return hertz_closed_form(law, mass, speed)
    return {}


def linear_closed_form(
    law: LinearLaw, attraction: str, mass: float, speed: float
) -> dict[str, float]:
    """Eq. (1) from xi = 0: xi = (v/w) exp(-d t) sin(w t) with d = gamma_N/2 and t_col = pi/w,
    eq. (4). With 'clip' the force ends at d2(xi)/dt2 = 0 and the grain coasts to xi = 0."""
    d = law.gamma / 2.0
    w = math.sqrt(law.k / mass - d * d)
    t_col = math.pi / w
    peak = speed / w * math.exp(-d / w * math.atan2(w, d)) * math.sin(math.atan2(w, d))
    if peak > speed * t_col / math.pi * (1.0 + CLOSED_FORM_TOLERANCE):
        raise AssertionError("xi_max exceeds v t_col / pi")
    if attraction == "keep":
        return {
            "restitution": math.exp(-law.gamma * t_col / 2.0),
            "contact_time": t_col,
            "max_overlap": peak,
        }
    release = (math.pi - math.atan2(2.0 * d * w, w * w - d * d)) / w
    decay = math.exp(-d * release)
    overlap = speed / w * decay * math.sin(w * release)
    leaving = -speed * decay * (math.cos(w * release) - d / w * math.sin(w * release))
    return {
        "restitution": leaving / speed,
        "contact_time": release + overlap / leaving,
        "max_overlap": peak,
    }


def hertz_closed_form(law: HertzLaw, mass: float, speed: float) -> dict[str, float]:
    """Elastic Hertz contact from energy conservation: m v^2/2 = (2/5) k xi_max^(5/2), and
    t = 2 xi_max/v times the integral of (1 - u^(5/2))^(-1/2) over u = 0 ... 1."""
    peak = (1.25 * mass * speed**2 / law.k) ** 0.4
    integral = math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9)
    return {
        "restitution": 1.0,
        "contact_time": 2.0 * peak / speed * integral,
        "max_overlap": peak,
    }


# --- oblique impacts ----------------------------------------------------------------------


def oblique() -> Iterator[Row]:
    """Oblique impacts on one fixed wall grain: impact height b/R, direction, speed, law."""
    damped = LinearLaw(STIFFNESS, DAMPING)
    hertz = HertzLaw(HERTZ_STIFFNESS, HERTZ_DAMPING)
    for height in (-0.9, -0.5, -0.1, 0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
        yield oblique_row(damped, "keep", FRICTION, height, 180.0, 1.0)
    for height, direction, speed in [(0.3, 37.0, 10.0), (0.8, 90.0, 10.0), (0.95, 255.0, 30.0)]:
        for law in (damped, LinearLaw(STIFFNESS, 0.0), hertz):
            yield oblique_row(law, "keep", FRICTION, height, direction, speed)
    for height in (0.2, 0.8):
        yield oblique_row(damped, "clip", FRICTION, height, 120.0, 2.0)
        yield oblique_row(hertz, "clip", FRICTION, height, 120.0, 2.0)
        yield oblique_row(damped, "keep", 0.1, height, 120.0, 2.0)
        yield oblique_row(damped, "keep", 0.0, height, 120.0, 2.0)
        yield oblique_row(LinearLaw(2e4, 2e4), "keep", FRICTION, height, 120.0, 2.0, 3e-6, 0.7e-3)


def oblique_row(
    law: LinearLaw | HertzLaw,
    attraction: str,
    mu: float,
    height: float,
    direction: float,
    speed: float,
    mass: float = MASS,
    radius: float = FREE_RADIUS,
) -> Row:
    """One oblique impact. The grain flies in a direction given in degrees from +x, on a line that
    lies height * R to the left of the wall grain, seen in the direction of flight."""
    reach = radius + WALL_RADIUS
    cosine, sine = (round(f(math.radians(direction)), DIGITS) for f in (math.cos, math.sin))
    aside, before = height * reach, 1.2 * reach
    x = exact(-before * cosine - aside * sine)
    y = exact(-before * sine + aside * cosine)
    vx, vy = exact(speed * cosine), exact(speed * sine)
    outcome = collide(System(law, mu, mass, reach, Wall(), attraction), x, y, vx, vy)
    return {
        "law": law.name,
        "attraction": attraction,
        "b_over_R": height,
        "radius_free": radius,
        "radius_wall": WALL_RADIUS,
        "mass": mass,
        "k": law.k,
        "gamma": law.gamma,
        "mu": mu,
        "x": x,
        "y": y,
        "vx": vx,
        "vy": vy,
        "vx_after": outcome.vx,
        "vy_after": outcome.vy,
        "contact_time": outcome.tally.contact_time,
        "max_overlap": outcome.tally.max_overlap,
        "slip_stops": outcome.tally.slip_stops,
    }


# --- files --------------------------------------------------------------------------------


def bead_column() -> Iterator[Row]:
    """Beads that collide one after the other, and beads that touch several others at once."""
    for beads, damping, ratios in ((1, DAMPING, [1.0]), (2, DAMPING, [0.05, 0.3, 0.8, 3.0]), (2, 0.0, [0.05, 0.8]),
                                   (3, 3e3, [0.01, 0.2, 0.7, 5.0]), (5, 3e3, [0.1, 0.4, 1.0]), (10, 2e3, [0.3, 0.6])):
        for ratio in ratios:
            plate = Column(beads, STIFFNESS, damping, MASS, 0.0, 1.0)
            gap = exact(ratio * plate.collision_time(0))
            outcome = drop(Column(beads, STIFFNESS, damping, MASS, gap, 1.0))
            yield {
                "beads": beads,
                "gamma": damping,
                "gap_ratio": ratio,
                "gap": gap,
                "restitution": outcome.restitution,
                "rebound": outcome.rebound,
                "contacts": outcome.contacts,
                "duration": outcome.duration,
                "max_overlap": outcome.max_overlap,
            }


TABLES = [
    Table(
        "single_wall_grain.csv",
        SINGLE_ABOUT
        + f"Linear law, eq. (1): k_N = {STIFFNESS:g} N/m, gamma_N = column gamma in 1/s.\n"
        + "dv_y = loss of axial velocity; dv_x = v_x after, away from the wall.\n",
        single_linear,
    ),
    Table(
        "single_wall_grain_hertz.csv",
        SINGLE_ABOUT
        + "Hertz-Kuwabara-Kono: F_N = k xi^(3/2) + gamma xi^(1/2) d(xi)/dt, "
        + f"k = {HERTZ_STIFFNESS:g} N/m^(3/2),\n"
        + "gamma = column gamma in N s/m^(3/2). Head-on at 1 m/s: contact time 7.02e-5 s, "
        + "restitution 0.702.\n"
        + "dv_y = loss of axial velocity; dv_x = v_x after, away from the wall.\n",
        single_hertz,
    ),
    Table(
        "wall_array.csv",
        f"""\
Scenario 2: a free grain (radius 0.5 mm, mass 1 mg) hits an endless row of fixed wall grains
(radius 0.33 mm, centres at x = 0, y = k lambda, lambda = {SPACING * 1e3:g} mm).
Linear law, eq. (1): k_N = {STIFFNESS:g} N/m, gamma_N = {DAMPING:g} 1/s, mu = {FRICTION:g},
attraction keep, m_red = mass, no gravity.
Start: x = 0.83 mm, y = start lambda / {STARTS}, velocity (-v_x, +v_y). The impact is over when the
grain is at x > 0.83 mm and moves away (end_state away), has gone through to x < -0.83 mm (passed)
or rests in overlap (stuck).
dv_y = loss of axial velocity; dv_x = v_x after, away from the wall, plus v_x before, towards it.
contacts: one is counted when an overlap begins; the same wall grain touched twice counts twice.
contact_time: sum over the contacts of their durations (simultaneous contacts add up).
sensitivity: |change of dv_y| when the start is shifted by {SHIFT:g} m along y, divided by that
shift, in 1/s.
""",
        wall_array,
    ),
    Table(
        "head_on.csv",
        """\
Isolated head-on contact of two grains, or of a grain and the wall (mass_2 = inf), that starts at
xi = 0 with the relative velocity v; radii play no part.
law linear, eq. (1): F_N = k xi + gamma m_red d(xi)/dt; k in N/m, gamma in 1/s.
law hertz: F_N = k xi^(3/2) + gamma xi^(1/2) d(xi)/dt; k in N/m^(3/2), gamma in N s/m^(3/2).
attraction clip: F_N >= 0; the contact lasts until xi = 0 all the same.
All rows of the linear law and those of hertz with gamma = 0 agree with their closed forms to 1e-9.
""",
        head_on,
    ),
    Table(
        "bead_column.csv",
        """\
A column of equal beads falls on a plate with the velocity 1 m/s; linear law, no gravity.
gap between neighbours, in m; gap_ratio = gap over velocity times t_col at the plate.
restitution = square root of the energy after over that before; rebound = velocity of the centre of mass after over
that before; duration from the begin of the first contact to the end of the last.
""",
        bead_column,
    ),
    Table(
        "oblique.csv",
        """\
A free grain hits one fixed wall grain at the origin; m_red = mass, no gravity, no rotation.
Start (x, y), velocity (vx, vy); b_over_R = distance of the line of flight from the origin, divided
by the sum R of the radii, positive if the line lies to the left of the origin as seen in flight.
Laws and units as in head_on.csv. Friction, eq. (2); where the slip reaches zero it stays zero until
the contact ends (slip_stops = 1), because nothing drives it.
b_over_R = 0 has no slip from the start, so that friction has nothing to stop.
""",
        oblique,
    ),
]


def as_text(value: Value) -> str:
    """A cell of a table."""
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


def write_table(table: Table) -> None:
    """Write the head of a table and its rows."""
    rows = list(table.rows())
    head = f"{table.about}SI units, {DIGITS} significant digits. Made by: python3 impacts.py\n"
    with open(HERE / table.name, "w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in head.splitlines())
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([as_text(value) for value in row.values()] for row in rows)
    print(f"{table.name}: {len(rows)} rows written")


def read_table(name: str) -> list[dict[str, str]]:
    """Rows of a kept table as text."""
    with open(HERE / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def agrees(kept: str, value: Value, largest: float, column: str) -> bool:
    """Whether a kept cell says the same as a recomputed one."""
    if isinstance(value, str):
        return kept == value
    absolute = CHECK_SENSITIVITY if column == "sensitivity" else CHECK_ABSOLUTE * largest
    return math.isclose(float(kept), value, rel_tol=CHECK_RELATIVE, abs_tol=absolute)


def largest_value(rows: list[Row], column: str) -> float:
    """Largest finite magnitude in a column, 0 in a column of words."""
    values = [abs(row[column]) for row in rows if not isinstance(row[column], str)]
    return max((value for value in values if math.isfinite(value)), default=0.0)


def check_table(table: Table) -> bool:
    """Recompute a table and report what differs from the kept one."""
    kept = read_table(table.name)
    rows = list(table.rows())
    if len(kept) != len(rows) or list(kept[0]) != list(rows[0]):
        print(f"{table.name}: the kept table has other rows or columns")
        return False
    differences = [
        f"{table.name}, row {number}, {column}: kept {old[column]}, now {as_text(row[column])}"
        for column in rows[0]
        for number, (old, row) in enumerate(zip(kept, rows), start=1)
        if not agrees(old[column], row[column], largest_value(rows, column), column)
    ]
    print("\n".join(differences) if differences else f"{table.name}: {len(rows)} rows agree")
    return not differences


def main() -> int:
    """Write or check all tables; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    if parser.parse_args().check:
        return 0 if all([check_table(table) for table in TABLES]) else 1
    for table in TABLES:
        write_table(table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
