"""Fig. 6: slow and fast starts over the spacing of the wall grains."""
from results import print_table, save
from tube import runs_of


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
    save(draw_map(plt, runs), out / "fig6_map.svg")


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
