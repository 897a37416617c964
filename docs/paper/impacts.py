"""Figs. 3 to 5: curves of single impacts, read from the points of the sweeps."""
import json
from typing import NamedTuple

import numpy as np

from results import Missing, print_table, rows_of, save

# The impacts of scenarios/single_wall_grain.yaml and wall_array.yaml, SI.
REACH, HEIGHT, MASS = 0.83e-3, 0.82e-3, 1e-6
PAPER_V_X = (0.1, 0.3, 0.5)


class Curve(NamedTuple):
    """Means over the starting places at one v_x, m/s, with the sweep's row that they belong to."""
    row: dict
    v_x: float
    v_y: np.ndarray
    dv_y: np.ndarray
    dv_x: np.ndarray
    contacts: np.ndarray
    left_out: int  # impacts that went through the wall or stuck to it, and are in no mean

    def setting(self, key):
        return float(self.row[key])


def curves_of(sweep):
    """One curve for each point of an impact sweep and each v_x, in the order of the table."""
    curves = []
    for row in rows_of(sweep / "sweep.csv"):
        if row["status"] != "done":
            raise Missing(f"{sweep}: point {row['point']} is not done; run docs/paper/reproduce.sh")
        summary = sweep / "points" / row["point"] / "summary.json"
        points = json.loads(summary.read_text(encoding="utf-8"))["curve"]
        for v_x in dict.fromkeys(point["v_x"] for point in points):
            of_this = [point for point in points if point["v_x"] == v_x]
            columns = {name: np.array([point[name] for point in of_this], dtype=float)  # null: not a number
                       for name in ("v_y", "dv_y", "dv_x", "contacts")}
            curves.append(Curve(row, v_x, **columns, left_out=sum(p["passed"] + p["stuck"] for p in of_this)))
    return curves


def collapse(curve, reference, stretch):
    """Worst relative difference to the reference with both axes times `stretch`, and at how many common points."""
    common = np.isclose(curve.v_y[:, None], stretch * reference.v_y[None, :], rtol=1e-9)
    here, there = np.nonzero(common)
    worst = np.abs(curve.dv_y[here] / (stretch * reference.dv_y[there]) - 1).max()
    return f"{'< 1e-9' if worst < 1e-9 else f'{worst:.1e}'} ({len(here)} points)"


def exponent(curve, low, high):
    """Slope of log dv_y over log v_y between two velocities."""
    inside = (curve.v_y >= low * (1 - 1e-9)) & (curve.v_y <= high * (1 + 1e-9))
    return np.polyfit(np.log(curve.v_y[inside]), np.log(curve.dv_y[inside]), 1)[0]


def v_crit(k_n, gamma_n):
    """m/s, chord over t_col, eq. (4), of the single wall grain."""
    t_col = np.pi / np.sqrt(k_n / MASS - gamma_n**2 / 4)
    return 2 * np.sqrt(REACH**2 - HEIGHT**2) / t_col


# --- Fig. 3 ---

def print_stiffnesses(curves):
    reference = next(c for c in curves if c.setting("contact.stiffness") == 2000)
    rows = []
    for c in curves:
        k_n = c.setting("contact.stiffness")
        best = c.dv_y.argmax()
        rows.append((k_n, v_crit(k_n, c.setting("contact.damping")), c.v_y[best], c.dv_y[best],
                     c.dv_y[0] / c.v_y[0], collapse(c, reference, np.sqrt(k_n / 2000))))
    print_table("Fig. 3, stiffness: the collapse is with the curve of 2000 N/m, both axes times sqrt(k_N / 2000 N/m)",
                ("k_N (N/m)", "v_crit (m/s)", "maximum at v_y (m/s)", "its dv_y (m/s)", "dv_y / v_y at 0.1 m/s",
                 "worst deviation from collapse"), rows)


def print_time_steps(curves):
    finest = max(curves, key=lambda c: c.setting("run.steps_per_collision"))
    rows = []
    for c in curves:
        off = np.abs(c.dv_y / finest.dv_y - 1)
        rows.append((c.setting("run.steps_per_collision"), f"{off.max():.1e}", c.v_y[off.argmax()],
                     f"{off.mean():.1e}"))
    print_table("Fig. 3, time step: relative deviation of dv_y from the finest, v_y from 0.1 to 40 m/s",
                ("steps per contact", "worst", "at v_y (m/s)", "mean"), rows)


def print_laws(curves):
    print_table("Fig. 3, laws",
                ("law", "maximum at v_y (m/s)", "its dv_y (m/s)", "dv_y at 1000 m/s (m/s)", "exponent, 0.1 to 0.3 m/s",
                 "exponent, 30 to 100 m/s"),
                [(c.row["branch"], c.v_y[c.dv_y.argmax()], c.dv_y.max(), c.dv_y[-1], exponent(c, 0.1, 0.3162278),
                  exponent(c, 31.62278, 100)) for c in curves])


def fig3(sweeps, out, plt):
    stiffnesses, laws = curves_of(sweeps / "fig3"), curves_of(sweeps / "fig3_laws")
    print_stiffnesses(stiffnesses)
    print_time_steps(curves_of(sweeps / "fig3_time_step"))
    print_laws(laws)
    save(draw_fig3(plt, stiffnesses, laws), out / "fig3.svg")


def draw_fig3(plt, curves, laws):
    figure, (plain, scaled, other) = plt.subplots(1, 3, figsize=(10, 3.3), sharey="row")
    for c in curves:
        k_n = c.setting("contact.stiffness")
        stretch = np.sqrt(k_n / 2000)
        plain.loglog(c.v_y, c.dv_y, label=f"{k_n:g} N/m")
        scaled.loglog(c.v_y / stretch, c.dv_y / stretch, dashes=(2 + stretch, 2), label=f"{k_n:g} N/m")
    for c in laws:
        other.loglog(c.v_y, c.dv_y, label=c.row["branch"])
    plain.set(xlabel="v_y (m/s)", ylabel="loss of axial velocity (m/s)", title="three stiffnesses")
    scaled.set(xlabel="v_y (2000 N/m / k_N)^(1/2)", title="both axes scaled")
    other.set(xlabel="v_y (m/s)", title="laws")
    for axes in (plain, scaled, other):
        axes.set_xlim(0.1, 100)
        axes.legend(fontsize=7)
    plain.set_ylim(1e-2, 10)
    return figure


# --- Figs. 4 and 5 ---

def onset(curve):
    """m/s, from which v_y on the mean impact has two contacts; between two points on a logarithmic scale."""
    below = np.flatnonzero(curve.contacts < 2)[-1]
    x, y = np.log(curve.v_y[below:below + 2]), curve.contacts[below:below + 2]
    return np.exp(np.interp(2, y, x))


def best_brake(curve):
    """Index of the largest loss below the onset of two contacts."""
    return curve.dv_y[:np.searchsorted(curve.v_y, onset(curve))].argmax()


def worst_brake(curve):
    """Index of the smallest loss beyond that."""
    best = best_brake(curve)
    return best + curve.dv_y[best:].argmin()


def brake_row(c):
    best, worst, fast = best_brake(c), worst_brake(c), np.abs(c.v_y - 40).argmin()
    return (c.row["branch"], c.setting("contact.stiffness"), c.v_x, onset(c), c.v_y[best], c.dv_y[best], c.v_y[worst],
            c.dv_y[worst], c.dv_y[fast], c.left_out)


def shift_row(soft, stiff):
    """Exponents with which velocities grow with k_N."""
    stiffer = np.log(stiff.setting("contact.stiffness") / soft.setting("contact.stiffness"))
    return (soft.v_x, *(np.log(velocity(stiff) / velocity(soft)) / stiffer for velocity in (
        lambda c: c.v_y[best_brake(c)], onset, lambda c: c.v_y[worst_brake(c)])))


def fig4_5(sweeps, out, plt):
    curves = curves_of(sweeps / "fig4_5")
    of = {(c.row["branch"], c.v_x): c for c in curves}
    print_table("Figs. 4 and 5, all velocities in m/s",
                ("branch", "k_N (N/m)", "v_x", "two contacts from v_y", "maximum at", "dv_y", "minimum at", "dv_y",
                 "dv_y at 40", "left out"), [brake_row(c) for c in curves if c.v_x in PAPER_V_X])
    print_table("Figs. 4 and 5, exponents with k_N from 200 N/m to 200 kN/m at the same v_x",
                ("v_x (m/s)", "maximum", "two contacts", "minimum"),
                [shift_row(of["soft", v_x], of["stiff", v_x]) for v_x in PAPER_V_X])
    print_table("Figs. 4 and 5, v_x scaled too: 200 kN/m against 2000 N/m, all velocities ten times as large",
                ("v_x at 2000 N/m (m/s)", "worst deviation of dv_y"),
                [(v_x, collapse(of["scaled", 10 * v_x], of["paper", v_x], 10)) for v_x in PAPER_V_X])
    save(draw_fig4_5(plt, of), out / "fig4_5.svg")


def draw_fig4_5(plt, of):
    figure, (number, loss, shift) = plt.subplots(1, 3, figsize=(10, 3.3))
    for i, v_x in enumerate(PAPER_V_X):
        for branch, style in (("paper", "-"), ("starts", ":")):
            c = of[branch, v_x]
            label = f"v_x = {v_x:g} m/s" if branch == "paper" else None
            number.semilogx(c.v_y, c.contacts, style, color=f"C{i}", label=label)
            loss.loglog(c.v_y, c.dv_y, style, color=f"C{i}", label=label)
    for branch in ("soft", "paper", "stiff"):
        c = of[branch, 0.3]
        shift.loglog(c.v_y, c.dv_y, label=f"{c.setting('contact.stiffness'):g} N/m")
    number.set(ylabel="contacts", title="2000 N/m", ylim=(0, 10))
    loss.set(ylabel="loss of axial velocity (m/s)", title="2000 N/m")
    shift.set(title="v_x = 0.3 m/s")
    for axes in (number, loss, shift):
        axes.set(xlabel="v_y (m/s)", xlim=(0.1, 100))
        axes.legend(fontsize=7)
    return figure
