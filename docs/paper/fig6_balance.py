"""The argument behind Fig. 6: where single impacts on the wall balance gravity, eq. (9), beside the measured states.

g = n_dot dv_y needs of each visit to the wall the loss g / n_dot. The curve of single impacts (Fig. 5) at the
grains' v_x says at which v_y they lose that much: a state is stable where the curve rises through it. Which v_x that is:
sigma_vx of the whole tube, as in the paper; sigma_vx of the wall layer; the mean v_x of grains of that layer as they
come to the wall, (pi/2)^(1/2) sigma_vx for a Maxwellian, as faster ones come more often; or the one that is inferred from
how visits change v_x.
"""
from statistics import mean

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from impacts import curves_of
from results import print_table, rows_of, save
from tube import at_default_spacing, grouped, mean_text, runs_of

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
    """A measured state, seeds together, and what single impacts predict of it."""

    def __init__(self, e_n, runs, impacts):
        self.e_n, self.runs, self.impacts = e_n, runs, impacts
        self.slip, self.visit_rate, dv_x = (self.mean(name) for name in ("entry_slip", "visit_rate", "visit_dv_x"))
        self.needed = GRAVITY / self.visit_rate
        at_wall = self.mean("sigma_vx_wall")
        self.v_x = {"sigma_vx": self.mean("sigma_vx"), "sigma_vx at the wall": at_wall,
                    "arrival": np.sqrt(np.pi / 2) * at_wall, "inferred": impacts.v_x_of(dv_x, self.slip)}

    def mean(self, name):
        return mean(getattr(run, name) for run in self.runs)

    def text(self, name):
        return mean_text(name, self.runs)


def settled_states(tables):
    """Of 2000 N/m: seeds of slow starts that stay, and the fast starts that have settled."""
    slow = [run for run in runs_of(tables / "fig6_slow.csv") if run.stays]
    fast = [run for run in runs_of(tables / "fig6_fast.csv") if run.lost and run.settled]
    return [run for run in at_default_spacing(slow + fast) if run.k_n == 2000]


def cases_of(tables, sweep):
    impacts = impacts_of(sweep)
    states = [run for run in settled_states(tables) if run.e_n in impacts]
    return [Case(e_n, runs, impacts[e_n]) for (e_n, _), runs in sorted(grouped(states, "e_n", "lost"))]


def crossings_text(crossings):
    return ", ".join(f"{v:.3g} {'stable' if stable else 'unstable'}" for v, stable in crossings) or "none"


def fig6_balance(sweeps, tables, out, plt):
    cases = cases_of(tables, sweeps / "fig6_curves")
    print_table("Fig. 6, measured states, 2000 N/m, velocities in m/s; g / n_dot is what a visit must lose",
                ("e_N", "runs", "mean v_y", "slip at the wall", "n_dot (1/s)", "g / n_dot", "dv_y of a visit",
                 "of a single impact"),
                [(c.e_n, len(c.runs), c.text("velocity"), c.text("entry_slip"), c.text("visit_rate"), c.needed,
                  c.text("visit_dv_y"), float(c.impacts.dv_y(c.v_x["inferred"], c.slip))) for c in cases])
    print_table("Fig. 6, v_x in m/s: sigma_vx in the tube, in its core and at its wall, and what comes to the wall",
                ("e_N", "slip at the wall", "sigma_vx", "in the core", "at the wall", "arrival", "inferred"),
                [(c.e_n, c.slip, c.text("sigma_vx"), c.text("sigma_vx_core"), c.text("sigma_vx_wall"),
                  c.v_x["arrival"], c.v_x["inferred"]) for c in cases])
    print_table("Fig. 6, predicted states: v_y at which single impacts lose g / n_dot, m/s, with four choices of v_x",
                ("e_N", "slip at the wall", *cases[0].v_x),
                [(c.e_n, c.slip, *(crossings_text(c.impacts.crossings(v_x, c.needed)) for v_x in c.v_x.values()))
                 for c in cases])
    save(draw_balance(plt, cases), out / "fig6_balance.svg")
    save(draw_profiles(plt, cases, rows_of(tables / "fig6_profiles.csv")), out / "fig6_profiles.svg")


def draw_balance(plt, cases):
    """A panel for each state: the curves, what is needed, and what is measured."""
    figure, panels = plt.subplots(1, len(cases), figsize=(2.6 * len(cases), 3.2), sharey=True, squeeze=False)
    for axes, c in zip(panels[0], cases):
        v_y = c.impacts.v_y
        for name, v_x in c.v_x.items():
            axes.loglog(v_y, c.impacts.dv_y(v_x, v_y), label=f"v_x: {name}")
        axes.axhline(c.needed, color="0.3", linestyle=":", label="g / n_dot")
        axes.plot(c.slip, c.mean("visit_dv_y"), "ko", label="measured")
        axes.set(title=f"e_N = {c.e_n:g}, {c.mean('velocity'):.3g} m/s", xlabel="v_y (m/s)", ylim=(0.05, 5))
    panels[0][0].set_ylabel("loss of axial velocity (m/s)")
    panels[0][-1].legend(fontsize=6)
    return figure


def draw_profiles(plt, cases, strips):
    """sigma_vx across the tube, a line for each run; dashed what it is in the whole tube, dotted the inferred v_x."""
    figure, panels = plt.subplots(1, len(cases), figsize=(2.6 * len(cases), 3.0), sharey=True, squeeze=False)
    for axes, c in zip(panels[0], cases):
        for run in c.runs:
            of_run = [strip for strip in strips if strip["point"] == run.point]
            axes.semilogy([1e3 * float(strip["x"]) for strip in of_run],
                          [float(strip["sigma_vx"] or "nan") for strip in of_run], color="C0")
        axes.axhline(c.v_x["sigma_vx"], color="C1", linestyle="--", label="whole tube")
        axes.axhline(c.v_x["inferred"], color="C3", linestyle=":", label="inferred v_x")
        axes.set(title=f"e_N = {c.e_n:g}, {c.mean('velocity'):.3g} m/s", xlabel="x (mm)")
    panels[0][0].set_ylabel("sigma_vx (m/s)")
    panels[0][-1].legend(fontsize=6)
    return figure
