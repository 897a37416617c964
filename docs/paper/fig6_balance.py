"""The argument behind Fig. 6: where single impacts on the wall balance gravity, eq. (9), beside the measured states.

g = n_dot dv_y needs of each visit to the wall the loss g / n_dot. The curve of single impacts (Fig. 5) at the
grains' v_x says at which v_y they lose that much: a state is stable where the curve rises through it.
"""
import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from impacts import curves_of
from results import print_table, save
from tube import at_default_spacing, runs_of

GRAVITY = 10.0  # m/s^2, scenarios/periodic_tube.yaml


class Impacts:
    """dv_y and dv_x of single impacts over v_x and v_y at one e_N, interpolated in logarithms."""

    def __init__(self, curves):
        self.v_x = np.array([c.v_x for c in curves])
        self.v_y = np.geomspace(*curves[0].v_y[[0, -1]], 400)[1:-1]  # where crossings are looked for
        places = (np.log(self.v_x), np.log(curves[0].v_y))
        self._dv_y = RegularGridInterpolator(places, np.log([c.dv_y for c in curves]))
        self._dv_x = RegularGridInterpolator(places, np.log([c.dv_x for c in curves]))

    def dv_y(self, v_x, v_y):
        return np.exp(self._dv_y((np.log(v_x), np.log(v_y))))

    def dv_x(self, v_x, v_y):
        return np.exp(self._dv_x((np.log(v_x), np.log(v_y))))

    def v_x_of(self, dv_x, v_y):
        """The v_x of impacts with this change of v_x."""
        return brentq(lambda v_x: self.dv_x(v_x, v_y) - dv_x, self.v_x[0], self.v_x[-1] * (1 - 1e-9))

    def crossings(self, v_x, needed):
        """[(v_y, stable)] where impacts lose what is needed."""
        over = self.dv_y(v_x, self.v_y) - needed
        places = np.flatnonzero(np.sign(over[1:]) != np.sign(over[:-1]))
        return [(brentq(lambda v: self.dv_y(v_x, v) - needed, *self.v_y[i:i + 2]), over[i] < 0) for i in places]


def impacts_of(sweep):
    """e_N: Impacts."""
    by_e_n = {}
    for curve in curves_of(sweep):
        by_e_n.setdefault(curve.setting("contact.restitution"), []).append(curve)
    return {e_n: Impacts(curves) for e_n, curves in by_e_n.items()}


class Case:
    """A measured state and what single impacts predict of it."""

    def __init__(self, run, impacts):
        self.run, self.impacts = run, impacts
        self.needed = GRAVITY / run.visit_rate
        self.v_x = impacts.v_x_of(run.visit_dv_x, run.entry_slip)


def cases_of(tables, sweep):
    impacts = impacts_of(sweep)
    runs = at_default_spacing(runs_of(tables / "fig6_map.csv")) + runs_of(tables / "fig6_fast.csv")
    return [Case(run, impacts[run.e_n]) for run in sorted(runs, key=lambda run: run.e_n) if run.settled]


def crossings_text(crossings):
    return ", ".join(f"{v:.3g} {'stable' if stable else 'unstable'}" for v, stable in crossings) or "none"


def fig6_balance(sweeps, tables, out, plt):
    cases = cases_of(tables, sweeps / "fig6_curves")
    print_table("Fig. 6, measured states, 2000 N/m, velocities in m/s; g / n_dot is what a visit must lose",
                ("e_N", "mean v_y", "sigma_vx", "slip at the wall", "v_x at the wall", "n_dot (1/s)", "g / n_dot",
                 "dv_y of a visit", "of a single impact"),
                [(c.run.e_n, c.run.with_error("velocity"), c.run.with_error("sigma_vx"), c.run.entry_slip, c.v_x,
                  c.run.visit_rate, c.needed, c.run.with_error("visit_dv_y"),
                  float(c.impacts.dv_y(c.v_x, c.run.entry_slip))) for c in cases])
    print_table("Fig. 6, predicted states: v_y at which single impacts lose g / n_dot, m/s",
                ("e_N", "slip at the wall", "with v_x = sigma_vx", "with v_x at the wall"),
                [(c.run.e_n, c.run.entry_slip, crossings_text(c.impacts.crossings(c.run.sigma_vx, c.needed)),
                  crossings_text(c.impacts.crossings(c.v_x, c.needed))) for c in cases])
    save(draw_balance(plt, cases), out / "fig6_balance.svg")


def draw_balance(plt, cases):
    """A panel for each state: the curves, what is needed, and what is measured."""
    figure, panels = plt.subplots(1, len(cases), figsize=(2.6 * len(cases), 3.2), sharey=True, squeeze=False)
    for axes, c in zip(panels[0], cases):
        v_y = c.impacts.v_y
        axes.loglog(v_y, c.impacts.dv_y(c.run.sigma_vx, v_y), label="v_x = sigma_vx")
        axes.loglog(v_y, c.impacts.dv_y(c.v_x, v_y), "--", label="v_x at the wall")
        axes.axhline(c.needed, color="0.3", linestyle=":", label="g / n_dot")
        axes.plot(c.run.entry_slip, c.run.visit_dv_y, "ko", label="measured")
        axes.set(title=f"e_N = {c.run.e_n:g}, {c.run.velocity:.3g} m/s", xlabel="v_y (m/s)", ylim=(0.05, 5))
    panels[0][0].set_ylabel("loss of axial velocity (m/s)")
    panels[0][-1].legend(fontsize=6)
    return figure
