"""Fig. 6: what the paper leaves open, the fast branch, and where the slow branch ends."""
import numpy as np

from results import print_table, save
from tube import at_default_spacing, groups_of, mean_of_seeds, plus_minus, runs_of


def state_cell(group):
    """The velocity if it is one, else how far the fall has come in the last fifth of the run."""
    if group.is_settled:
        return plus_minus(*group.mean("velocity"))
    if not group.settled_runs:
        return f"falls: {group.last('velocity'):.3g}, wall {group.last('share'):.2f}"
    return f"{len(group.settled_runs)} of {len(group.runs)}: {plus_minus(*group.mean('velocity'))}"


# --- The map: what the paper leaves open ---

def fig6_map(tables, out, plt):
    """A row per tube and start, a column per e_N. One seed each."""
    groups = groups_of(runs_of(tables / "fig6_map.csv"), "width", "length", "spacing", "branch", "e_n")
    e_ns = sorted({group.e_n for group in groups})
    rows = {}
    for group in groups:
        tube = (1e3 * group.width, 1e3 * group.length, 1e3 * group.spacing, group.branch)
        rows.setdefault(tube, {})[group.e_n] = state_cell(group)
    print_table("Fig. 6, map: velocity after the transient, or in the last fifth of the run with the wall's share of the weight, 2000 N/m",
                ("W (mm)", "L (mm)", "spacing (mm)", "start", *(f"e_N = {e_n:g}" for e_n in e_ns)),
                [(*tube, *(cells.get(e_n, "") for e_n in e_ns)) for tube, cells in rows.items()])
    save(draw_map(plt, groups), out / "fig6_map.svg")


def draw_map(plt, groups):
    """Share of the weight that the wall carries at the end, over e_N and spacing."""
    tubes = list(dict.fromkeys((group.width, group.branch) for group in groups))
    figure, panels = plt.subplots(1, len(tubes), figsize=(3.0 * len(tubes) + 1, 3.2), sharey=True, squeeze=False)
    for axes, (width, branch) in zip(panels[0], tubes):
        of_these = [g for g in groups if (g.width, g.branch) == (width, branch)]
        dots = axes.scatter([g.e_n for g in of_these], [1e3 * g.spacing for g in of_these],
                            c=[g.last("share") for g in of_these], vmin=0, vmax=1, cmap="viridis", s=60, marker="s")
        axes.set(title=f"W = {1e3 * width:g} mm, {branch} start", xlabel="e_N", xlim=(0.55, 1))
    panels[0][0].set_ylabel("spacing (mm)")
    figure.colorbar(dots, ax=panels[0][-1], label="share of the weight")
    return figure


# --- The fast branch ---

WINDOWS = range(1, 6)  # of keep.py


def fast_row(group):
    return (group.k_n, group.e_n, group.start, group.time, len(group.runs), group.states,
            plus_minus(*group.mean("velocity")) if group.is_settled else f"{group.last('velocity'):.4g} at the end",
            plus_minus(*group.mean("share")) if group.is_settled else f"{group.last('share'):.2f} at the end",
            plus_minus(*group.mean("sigma_vx")) if group.is_settled else f"{group.last('sigma_vx'):.2g} at the end",
            max(run.brake_failure for run in group.runs), group.worst_verdict)


def fig6_fast(tables, out, plt):
    runs = runs_of(tables / "fig6_fast.csv")
    print_table("Fig. 6, fast branch",
                ("k_N (N/m)", "e_N", "start (m/s)", "time (s)", "seeds", "verdict on the mean", "mean v_y (m/s)", "n_dot dv_y / g",
                 "sigma_vx (m/s)", "brake failure", "verdict on the physics"),
                [fast_row(group) for group in groups_of(runs, "k_n", "e_n", "start")])
    falls = [run for run in at_default_spacing(runs_of(tables / "fig6_map.csv")) if run.branch == "fast"]
    save(draw_fast(plt, runs + falls), out / "fig6_fast.svg")


def draw_fast(plt, runs):
    """How much of the weight the wall carries at which velocity, in five windows of each run: where it passes 1 upwards
    there is a stable state."""
    stiffnesses = sorted({run.k_n for run in runs})
    figure, panels = plt.subplots(1, len(stiffnesses), figsize=(4.5 * len(stiffnesses), 3.5), squeeze=False)
    colors = {e_n: f"C{i}" for i, e_n in enumerate(sorted({run.e_n for run in runs}))}
    for axes, k_n in zip(panels[0], stiffnesses):
        for run in (run for run in runs if run.k_n == k_n):
            axes.plot([getattr(run, f"velocity_{i}") for i in WINDOWS], [getattr(run, f"share_{i}") for i in WINDOWS],
                      "o-", markersize=3, color=colors[run.e_n])
        axes.axhline(1, color="0.5", linewidth=0.8)
        axes.set(title=f"k_N = {k_n:g} N/m", xlabel="mean axial velocity (m/s)", xscale="log", ylim=(0, 3))
    panels[0][0].set_ylabel("the wall's share of the weight")
    for e_n, color in colors.items():
        panels[0][0].plot([], [], "o-", markersize=3, color=color, label=f"e_N = {e_n:g}")
    panels[0][0].legend(fontsize=7)
    return figure


# --- Where the slow branch ends ---

def slow_row(group):
    stay = [run for run in group.runs if run.stays_slow]
    if not stay:
        return (group.k_n, group.e_n, f"0 of {len(group.runs)}", group.states, *3 * ("",))
    means = [plus_minus(*mean_of_seeds([getattr(r, name) for r in stay], [getattr(r, f"{name}_error") for r in stay]))
             for name in ("velocity", "share", "sigma_vx")]
    return (group.k_n, group.e_n, f"{len(stay)} of {len(group.runs)}", group.states, *means)


def threshold_row(groups):
    """Where the seeds stop to run away. Half of them stay at the threshold of Spearman and Kaerber; its error has the scatter of
    the seeds and a place unknown within a step of the grid."""
    groups = sorted(groups, key=lambda group: group.e_n)
    e_n = np.array([group.e_n for group in groups])
    stay = np.array([np.mean([run.stays_slow for run in group.runs]) for group in groups])
    if stay[0] > 0 or stay[-1] < 1:
        return groups[0].k_n, "", "", "not enclosed"
    n = np.array([len(group.runs) for group in groups])
    middle = np.sum(np.diff(stay) * (e_n[1:] + e_n[:-1]) / 2)
    scatter = np.sum(np.gradient(e_n)**2 * stay * (1 - stay) / np.maximum(n - 1, 1))
    step = np.diff(e_n)[np.diff(stay) != 0].max()
    return groups[0].k_n, e_n[stay < 1].max(), e_n[stay > 0].min(), plus_minus(middle, np.sqrt(scatter + step**2 / 12))


def fig6_slow(tables, out, plt):
    groups = groups_of(runs_of(tables / "fig6_slow.csv"), "k_n", "e_n")
    print_table("Fig. 6, slow branch",
                ("k_N (N/m)", "e_N", "stay slow", "verdict on the mean", "mean v_y (m/s)", "n_dot dv_y / g", "sigma_vx (m/s)"),
                [slow_row(group) for group in groups])
    stiffnesses = dict.fromkeys(group.k_n for group in groups)
    print_table("Fig. 6, ends of the slow branch",
                ("k_N (N/m)", "a seed runs away at", "a seed stays at", "threshold"),
                [threshold_row([group for group in groups if group.k_n == k_n]) for k_n in stiffnesses])
