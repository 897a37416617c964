"""Fig. 6: what the spacing of the wall grains does, and where the fast branch is."""
from results import print_table, save
from tube import WINDOWS, at_default_spacing, runs_of


# --- The spacing ---

def state_cell(run):
    """The velocity if it is one, else how far the fall has come in the last window."""
    return run.with_error("velocity") if run.settled else f"falls: {run.velocity_5:.3g}, wall {run.share_5:.2f}"


def fig6_map(tables, out, plt):
    """A row per spacing and start, a column per e_N."""
    runs = runs_of(tables / "fig6_map.csv")
    e_ns = sorted({run.e_n for run in runs})
    rows = {}
    for run in runs:
        rows.setdefault((1e3 * run.spacing, run.branch), {})[run.e_n] = state_cell(run)
    print_table("Fig. 6, spacing of the wall grains, 2000 N/m",
                ("spacing (mm)", "start", *(f"e_N = {e_n:g}" for e_n in e_ns)),
                [(*place, *(cells[e_n] for e_n in e_ns)) for place, cells in rows.items()])
    print_end(runs_of(tables / "fig6_end.csv"))
    save(draw_map(plt, runs), out / "fig6_map.svg")


def print_end(runs):
    """Slow starts around the end of the slow branch: a row per e_N, a column per seed."""
    cells = {(run.e_n, run.seed): state_cell(run) for run in runs}
    seeds = sorted({run.seed for run in runs})
    print_table("Fig. 6, end of the slow branch, 2000 N/m, spacing 1.2 mm",
                ("e_N", *(f"seed {seed:g}" for seed in seeds)),
                [(e_n, *(cells.get((e_n, seed), "not run") for seed in seeds))
                 for e_n in sorted({run.e_n for run in runs})])


def draw_map(plt, runs):
    """The wall's share of the weight in the last window, over e_N and spacing."""
    branches = list(dict.fromkeys(run.branch for run in runs))
    figure, panels = plt.subplots(1, len(branches), figsize=(7, 3.2), sharey=True)
    for axes, branch in zip(panels, branches):
        of_this = [run for run in runs if run.branch == branch]
        dots = axes.scatter([run.e_n for run in of_this], [1e3 * run.spacing for run in of_this],
                            c=[run.share_5 for run in of_this], vmin=0, vmax=1, s=60, marker="s")
        axes.set(title=f"{branch} start", xlabel="e_N", xlim=(0.55, 1))
    panels[0].set_ylabel("spacing (mm)")
    figure.colorbar(dots, ax=panels[-1], label="share of the weight")
    return figure


# --- The fast branch ---

def fast_row(run):
    if run.settled:
        seen = [run.with_error(name) for name in ("velocity", "share", "sigma_vx")]
    else:
        seen = [f"{getattr(run, f'{name}_5'):.3g} at the end" for name in ("velocity", "share", "sigma_vx")]
    return (run.e_n, run.start, run.time, run.state.replace("_", " "), *seen, run.brake_failure,
            run.steps_per_contact, run.verdict)


def fig6_fast(tables, out, plt):
    runs = runs_of(tables / "fig6_fast.csv")
    print_table("Fig. 6, fast branch, 2000 N/m",
                ("e_N", "start (m/s)", "time (s)", "state", "mean v_y (m/s)", "n_dot dv_y / g", "sigma_vx (m/s)",
                 "brake failure", "steps per contact", "verdict"), [fast_row(run) for run in runs])
    falls = [run for run in at_default_spacing(runs_of(tables / "fig6_map.csv")) if run.branch == "fast"]
    save(draw_fast(plt, falls + runs), out / "fig6_fast.svg")


def draw_fast(plt, runs):
    """How much of the weight the wall carries at which velocity, in the windows of each run: where it passes 1 upwards
    there is a stable state."""
    figure, axes = plt.subplots(figsize=(6, 3.5))
    colors = {e_n: f"C{i}" for i, e_n in enumerate(sorted({run.e_n for run in runs}))}
    windows = range(1, WINDOWS + 1)
    for run in runs:
        axes.semilogx([getattr(run, f"velocity_{i}") for i in windows], [getattr(run, f"share_{i}") for i in windows],
                      "o-", markersize=3, color=colors[run.e_n])
    for e_n, color in colors.items():
        axes.plot([], [], "o-", markersize=3, color=color, label=f"e_N = {e_n:g}")
    axes.axhline(1, color="0.5", linewidth=0.8)
    axes.set(xlabel="mean axial velocity (m/s)", ylabel="the wall's share of the weight", ylim=(0, 3))
    axes.legend(fontsize=7)
    return figure
