"""The argument behind Fig. 6: where single impacts on the wall balance gravity, eq. (9), beside the measured states.

g = n_dot dv_y needs of each visit to the wall the loss g / n_dot. The curve of single impacts (Fig. 5) at the grains' v_x says
at which v_y they lose that much: a state is stable where the curve rises through it.
"""
import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from impacts import curves_of
from results import print_table, save
from tube import at_default_spacing, groups_of, plus_minus, runs_of

GRAVITY = 10.0  # m/s^2, scenarios/periodic_tube.yaml
FINE = np.geomspace(0.3, 158, 400)  # v_y, m/s


class Impacts:
    """dv_y and dv_x of single impacts over v_x and v_y at one e_N, interpolated in logarithms."""

    def __init__(self, curves):
        self.v_x = np.array([c.v_x for c in curves])
        places = (np.log(self.v_x), np.log(curves[0].v_y))
        self._dv_y = RegularGridInterpolator(places, np.log([c.dv_y for c in curves]))
        self._dv_x = RegularGridInterpolator(places, np.log([c.dv_x for c in curves]))

    def dv_y(self, v_x, v_y):
        return np.exp(self._dv_y((np.log(v_x), np.log(v_y))))

    def dv_x(self, v_x, v_y):
        return np.exp(self._dv_x((np.log(v_x), np.log(v_y))))

    def v_x_of(self, dv_x, v_y):
        """The v_x of impacts with this change of v_x; not a number beyond the curves."""
        def miss(v_x):
            return self.dv_x(v_x, v_y) - dv_x
        low, high = self.v_x[0], self.v_x[-1] * (1 - 1e-9)
        return brentq(miss, low, high) if miss(low) < 0 < miss(high) else np.nan

    def crossings(self, v_x, needed):
        """[(v_y, stable)] where impacts lose what is needed."""
        over = self.dv_y(v_x, FINE) - needed
        places = np.flatnonzero(np.sign(over[1:]) != np.sign(over[:-1]))
        return [(brentq(lambda v: self.dv_y(v_x, v) - needed, FINE[i], FINE[i + 1]), over[i] < 0) for i in places]


def impacts_of(sweep):
    """e_N: Impacts."""
    by_e_n = {}
    for curve in curves_of(sweep):
        by_e_n.setdefault(curve.setting("contact.restitution"), []).append(curve)
    return {e_n: Impacts(curves) for e_n, curves in by_e_n.items()}


class Case:
    """A measured state and what single impacts predict of it."""

    def __init__(self, group, impacts):
        self.group, self.impacts = group, impacts
        for name in ("velocity", "sigma_vx", "entry_slip", "visit_rate", "visit_dv_y", "visit_dv_x"):
            setattr(self, name, group.mean(name)[0])
        self.needed = GRAVITY / self.visit_rate
        self.v_x = impacts.v_x_of(self.visit_dv_x, self.entry_slip)


def cases_of(tables, sweep):
    impacts = impacts_of(sweep)
    runs = at_default_spacing(runs_of(tables / "fig6_map.csv")) + runs_of(tables / "fig6_fast.csv")
    settled = [group for group in groups_of(runs, "e_n", "branch", "start") if group.is_settled]
    return [Case(group, impacts[group.e_n]) for group in sorted(settled, key=lambda group: group.e_n)]


def crossings_text(crossings):
    return ", ".join(f"{v:.3g} {'stable' if stable else 'unstable'}" for v, stable in crossings) or "none"


def fig6_balance(sweeps, tables, out, plt):
    cases = cases_of(tables, sweeps / "fig6_curves")
    print_table("Fig. 6, predicted states, 2000 N/m: where a single impact loses g / n_dot, velocities in m/s",
                ("start", "e_N", "mean v_y", "slip at the wall", "n_dot (1/s)", "g / n_dot", "sigma_vx",
                 "v_y predicted with v_x = sigma_vx", "v_x at the wall", "v_y predicted with this v_x"),
                [(c.group.branch, c.group.e_n, plus_minus(*c.group.mean("velocity")), c.entry_slip, c.visit_rate, c.needed,
                  plus_minus(*c.group.mean("sigma_vx")), crossings_text(c.impacts.crossings(c.sigma_vx, c.needed)),
                  c.v_x, crossings_text(c.impacts.crossings(c.v_x, c.needed)) if np.isfinite(c.v_x) else "")
                 for c in cases])
    save(draw_balance(plt, cases), out / "fig6_balance.svg")


def draw_balance(plt, cases):
    """A panel for each e_N: the curves, what is needed, and the measured states."""
    e_ns = sorted({c.group.e_n for c in cases})
    figure, panels = plt.subplots(1, len(e_ns), figsize=(2.6 * len(e_ns), 3.2), sharey=True, squeeze=False)
    for axes, e_n in zip(panels[0], e_ns):
        for c in (c for c in cases if c.group.e_n == e_n):
            color = "C0" if c.group.branch == "slow" else "C3"
            axes.loglog(FINE, c.impacts.dv_y(c.sigma_vx, FINE), color=color, label=f"{c.group.branch}, v_x = sigma_vx")
            if np.isfinite(c.v_x):
                axes.loglog(FINE, c.impacts.dv_y(c.v_x, FINE), "--", color=color, label="v_x at the wall")
            axes.axhline(c.needed, color=color, linestyle=":", linewidth=0.8)
            axes.plot(c.entry_slip, c.visit_dv_y, "o", color=color, label="measured")
        axes.set(title=f"e_N = {e_n:g}", xlabel="v_y (m/s)", ylim=(0.05, 5))
        axes.legend(fontsize=6)
    panels[0][0].set_ylabel("loss of axial velocity (m/s)")
    return figure
