"""Fig. 6: slow and fast starts over the spacing of the wall grains."""
from statistics import mean

from results import print_table, save
from tube import grouped, mean_text, runs_of


def state_cell(runs):
    """The velocity if all seeds have one, else how far their fall has come in the last window."""
    if all(run.settled for run in runs):
        return mean_text("velocity", runs)
    return f"falls: {mean(run.velocity_5 for run in runs):.3g}, wall {mean(run.share_5 for run in runs):.2f}"


def fig6_map(tables, out, plt):
    """A row per spacing and start, a column per e_N."""
    runs = runs_of(tables / "fig6_map.csv")
    e_ns = sorted({run.e_n for run in runs})
    rows = []
    for (spacing, branch), of_start in grouped(runs, "spacing", "branch"):
        cells = {e_n: state_cell(of_this) for (e_n,), of_this in grouped(of_start, "e_n")}
        rows.append((1e3 * spacing, branch, *(cells[e_n] for e_n in e_ns)))
    print_table("Fig. 6, spacing of the wall grains, 2000 N/m",
                ("spacing (mm)", "start", *(f"e_N = {e_n:g}" for e_n in e_ns)), rows)
    save(draw_map(plt, runs), out / "fig6_map.svg")


def draw_map(plt, runs):
    """The wall's share of the weight in the last window, mean over the seeds, over e_N and spacing."""
    places = grouped(runs, "branch", "e_n", "spacing")
    branches = list(dict.fromkeys(run.branch for run in runs))
    figure, panels = plt.subplots(1, len(branches), figsize=(7, 3.2), sharey=True)
    for axes, branch in zip(panels, branches):
        of_this = [(e_n, spacing, mean(run.share_5 for run in at))
                   for (start, e_n, spacing), at in places if start == branch]
        dots = axes.scatter([e_n for e_n, _, _ in of_this], [1e3 * spacing for _, spacing, _ in of_this],
                            c=[share for _, _, share in of_this], vmin=0, vmax=1, s=60, marker="s")
        axes.set(title=f"{branch} start", xlabel="e_N", xlim=(0.55, 1))
    panels[0].set_ylabel("spacing (mm)")
    figure.colorbar(dots, ax=panels[-1], label="share of the weight")
    return figure
