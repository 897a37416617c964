"""Fig. 6 with rigid grains, of which a program of its own tells (bench/rigid), beside ever stiffer ones."""
from results import print_table, save
from tube import grouped, mean_text, runs_of

import riesel  # by way of tube

USUAL = 1e-7  # s, the shortest interval between two impacts that lose energy
SLOW, FAST = 1.0, 100.0  # m/s, the starts


def cell(runs):
    """The mean of the runs that have settled, and how many if not all."""
    settled = [run for run in runs if run.settled]
    if not settled:
        return "lost" if runs else ""
    return mean_text("velocity", settled) + ("" if len(settled) == len(runs) else f" ({len(settled)} of {len(runs)})")


def slow_cell(runs):
    """The same, of those that stay on the slow branch."""
    return cell([run for run in runs if run.stays]) or ("lost" if runs else "")


def stiff(runs, k_n, start, e_n):
    return [run for run in runs if (run.k_n, run.start, run.e_n) == (k_n, start, e_n)]


def fig6_rigid(tables, out, plt):
    all_rigid = runs_of(tables / "fig6_rigid.csv")
    rigid = [run for run in all_rigid if run.shortest_interval == USUAL]
    soft = [run for name in ("fig6_slow", "fig6_stiffer") for run in runs_of(tables / f"{name}.csv")]
    e_ns = sorted({run.e_n for run in rigid}, reverse=True)

    def of_rigid(start, e_n):
        return [run for run in rigid if (run.start, run.e_n) == (start, e_n)]

    print_table("Fig. 6, rigid grains beside stiff ones",
                ("e_N", "rigid, 1 m/s", "rigid, 100 m/s", "20 MN/m, 1 m/s", "20 MN/m, 100 m/s", "2 MN/m, 1 m/s",
                 "200 kN/m, 1 m/s"),
                [(e_n, cell(of_rigid(SLOW, e_n)), cell(of_rigid(FAST, e_n)), slow_cell(stiff(soft, 2e7, SLOW, e_n)),
                  slow_cell(stiff(soft, 2e7, FAST, e_n)), slow_cell(stiff(soft, 2e6, SLOW, e_n)),
                  slow_cell(stiff(soft, 2e5, SLOW, e_n))) for e_n in e_ns])
    print_table("Fig. 6, rigid grains: impacts, by the shortest interval between two of a grain that lose energy",
                ("e_N", "start (m/s)", "interval (s)", "time (s)", "mean v_y (m/s)", "sigma_vx (m/s)", "impacts per grain and s",
                 "with the wall", "made elastic"),
                [(e_n, start, f"{interval:.0e}", runs[0].time, mean_text("velocity", runs), mean_text("sigma_vx", runs),
                  mean_text("impact_rate", runs), mean_text("wall_impact_rate", runs), mean_text("elastic", runs))
                 for (e_n, start, interval), runs in sorted(grouped(all_rigid, "e_n", "start", "shortest_interval"))])
    save(draw(plt, rigid, soft, e_ns), out / "fig6_rigid.svg")


def draw(plt, rigid, soft, e_ns):
    figure, axes = plt.subplots(figsize=(6, 4))
    values = [riesel.mean_of([run.velocity for run in rigid if run.e_n == e_n and run.settled]) for e_n in e_ns]
    axes.errorbar(e_ns, [value for value, _ in values], [error for _, error in values], color="k", marker="s",
                  markersize=4, capsize=2, label="rigid")
    for k_n, color, label in ((2e7, "C1", "20 MN/m"), (2e6, "C4", "2 MN/m"), (2e5, "C3", "200 kN/m"), (2e3, "C0", "2000 N/m")):
        groups = grouped([run for run in soft if run.k_n == k_n and run.stays], "e_n")
        means = [riesel.mean_of([run.velocity for run in runs]) for _, runs in groups]
        axes.errorbar([e_n for (e_n,), _ in groups], [value for value, _ in means], [error for _, error in means],
                      color=color, marker="o", linestyle="none", markerfacecolor="none", capsize=2, label=label)
    axes.set(xlabel="e_N", ylabel="mean axial velocity (m/s)", yscale="log")
    axes.legend(fontsize=8, title="slow branch")
    return figure
