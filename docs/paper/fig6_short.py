"""Fig. 6 in short: three stiffnesses and one seed, read from the kept table of the sweep as it is."""
from typing import NamedTuple

import numpy as np

from results import print_table, rows_of, save

MARKERS = {"slow": ("o", "C0"), "fast": ("^", "C3")}


class Point(NamedTuple):
    """A run of the tube, SI."""
    k_n: float
    branch: str
    e_n: float
    velocity: float
    error: float
    state: str
    verdict: str
    failure: float
    balance: float  # n_dot dv_y / g
    balance_error: float


def point_of(row):
    number = {key: float(row[key]) if row[key] else np.nan for key in (
        "contact.stiffness", "contact.restitution", "mean_axial_velocity.value", "mean_axial_velocity.error",
        "validity.brake_failure_fraction", "balance.n_dot_dv_y", "balance.errors.n_dot_dv_y", "balance.gravity")}
    return Point(k_n=number["contact.stiffness"], branch=row["branch"], e_n=number["contact.restitution"],
                 velocity=number["mean_axial_velocity.value"], error=number["mean_axial_velocity.error"],
                 state=row["state"], verdict=row["validity.verdict"],
                 failure=number["validity.brake_failure_fraction"],
                 balance=number["balance.n_dot_dv_y"] / number["balance.gravity"],
                 balance_error=number["balance.errors.n_dot_dv_y"] / number["balance.gravity"])


def fig6_short(table, out, plt):
    rows = rows_of(table)
    points = [point_of(row) for row in rows if row["status"] == "done"]
    print(f"\n{len(points)} of {len(rows)} points are done")
    print_table("Fig. 6", ("k_N (N/m)", "start", "e_N", "mean v_y (m/s)", "state", "n_dot dv_y / g", "verdict",
                           "brake failure"),
                [(p.k_n, p.branch, p.e_n, f"{p.velocity:.4g} ± {p.error:.2g}", p.state.replace("_", " "),
                  f"{p.balance:.3f} ± {p.balance_error:.3f}", p.verdict, f"{p.failure:.1g}") for p in points])
    save(draw_fig6(plt, points), out / "fig6_short.svg")


def draw_fig6(plt, points):
    """A panel for each stiffness. Filled: steady. An arrow: still accelerating."""
    stiffnesses = list(dict.fromkeys(p.k_n for p in points))
    figure, panels = plt.subplots(1, len(stiffnesses), figsize=(10, 3.3), sharey=True)
    for axes, k_n in zip(panels, stiffnesses):
        for p in (p for p in points if p.k_n == k_n):
            marker, color = MARKERS[p.branch]
            axes.errorbar(p.e_n, p.velocity, p.error, color=color, marker=marker, capsize=2,
                          markerfacecolor=color if p.state == "steady" else "none")
            if p.state == "accelerating":
                axes.annotate("", (p.e_n, 1.45 * p.velocity), (p.e_n, 1.1 * p.velocity),
                              arrowprops={"arrowstyle": "->", "color": color})
        axes.set(xlabel="e_N", title=f"k_N = {k_n:g} N/m", yscale="log", xlim=(0.55, 1), ylim=(1, 80))
    panels[0].set_ylabel("mean axial velocity (m/s)")
    for branch, (marker, color) in MARKERS.items():
        panels[0].plot([], [], marker=marker, color=color, linestyle="none", label=f"{branch} start")
    panels[0].legend(fontsize=7)
    return figure
