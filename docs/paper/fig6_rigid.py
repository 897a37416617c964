"""Fig. 6 with rigid grains, of which a program of its own tells (bench/rigid), beside ever stiffer ones."""
from results import print_table, save
from tube import grouped, mean_of_runs, mean_text, plus_minus, runs_of, stay_cells, still_gains

USUAL = 1e-7  # s, the shortest interval between two impacts that lose energy
SLOW, FAST = 1.0, 100.0  # m/s, the starts
RULE = 0.46  # soft grains are faster by this times the square of slip / v_crit, below 0.7 and at e_N of 0.76 and more
STIFFNESSES = {2e7: ("20 MN/m", "C1"), 2e6: ("2 MN/m", "C4"), 2e5: ("200 kN/m", "C3"), 2e4: ("20 kN/m", "C2"),
               2e3: ("2 kN/m", "C0")}


def cell(runs):
    """The mean of the runs that have settled, and how many if not all."""
    settled = [run for run in runs if run.settled]
    if not settled:
        return "lost" if runs else ""
    return mean_text("velocity", settled) + ("" if len(settled) == len(runs) else f" ({len(settled)} of {len(runs)})")


def slow_cell(runs):
    """The same, of those that stay on the slow branch."""
    return stay_cells(runs)[1] or ("lost" if runs else "")


def fig6_rigid(tables, out, plt):
    all_rigid = runs_of(tables / "fig6_rigid.csv")
    rigid = [run for run in all_rigid if run.shortest_interval == USUAL]
    slow, stiffer = runs_of(tables / "fig6_slow.csv"), runs_of(tables / "fig6_stiffer.csv")
    e_ns = sorted({run.e_n for run in rigid}, reverse=True)

    def of_rigid(start, e_n):
        return cell([run for run in rigid if (run.start, run.e_n) == (start, e_n)])

    def of_soft(runs, k_n, start, e_n):
        return slow_cell([run for run in runs if (run.k_n, run.start, run.e_n) == (k_n, start, e_n)])

    print_table("Fig. 6, rigid grains beside soft ones",
                ("e_N", "rigid, 1 m/s", "rigid, 100 m/s", "20 MN/m, 1 m/s", "20 MN/m, 100 m/s", "2 MN/m, 1 m/s",
                 "200 kN/m, 1 m/s", "2 kN/m, 1 m/s", "200 N/m, 1 m/s"),
                [(e_n, of_rigid(SLOW, e_n), of_rigid(FAST, e_n), of_soft(stiffer, 2e7, SLOW, e_n),
                  of_soft(stiffer, 2e7, FAST, e_n), of_soft(stiffer, 2e6, SLOW, e_n), of_soft(slow, 2e5, SLOW, e_n),
                  of_soft(slow, 2e3, SLOW, e_n), of_soft(slow, 200.0, SLOW, e_n)) for e_n in e_ns])
    excesses = [Excess(runs, rigid) for _, runs in sorted(grouped(
        [run for run in stiffer if not still_gains(run)], "k_n", "e_n", "start"))]
    print_table("Fig. 6, how much faster than rigid grains soft ones are, by their speed along the wall",
                ("k_N (N/m)", "e_N", "start (m/s)", "mean v_y (m/s)", "slip at the wall / v_crit", "faster than rigid by"),
                [(x.k_n, x.e_n, x.start, mean_text("velocity", x.runs), f"{x.wall_speed:.3f}",
                  f"{plus_minus(100 * x.value, 100 * x.error)} %") for x in excesses])
    print_table("Fig. 6, rigid grains: impacts, by the shortest interval between two of a grain that lose energy",
                ("e_N", "start (m/s)", "interval (s)", "mean v_y (m/s)", "sigma_vx (m/s)", "impacts per grain and s",
                 "with the wall", "made elastic"),
                [(e_n, start, f"{interval:.0e}", mean_text("velocity", runs), mean_text("sigma_vx", runs),
                  mean_text("impact_rate", runs), mean_text("wall_impact_rate", runs), mean_text("elastic", runs))
                 for (e_n, start, interval), runs in sorted(grouped(all_rigid, "e_n", "start", "shortest_interval"))])
    save(draw(plt, rigid, slow + stiffer, excesses), out / "fig6_rigid.svg")


class Excess:
    """By what part runs of one stiffness and e_N are faster than rigid grains; its error is that of both means."""

    def __init__(self, runs, rigid):
        self.runs, first = runs, runs[0]
        self.k_n, self.e_n, self.start = first.k_n, first.e_n, first.start
        self.wall_speed = mean_of_runs("wall_speed", runs)[0]
        velocity, error = mean_of_runs("velocity", runs)
        of_rigid, error_of_rigid = mean_of_runs("velocity", [run for run in rigid if run.e_n == self.e_n])
        ratio = velocity / of_rigid
        self.value = ratio - 1
        self.error = ratio * ((error / velocity) ** 2 + (error_of_rigid / of_rigid) ** 2) ** 0.5


def draw(plt, rigid, soft, excesses):
    figure, (states, excess) = plt.subplots(1, 2, figsize=(10, 4))
    groups = sorted(grouped([run for run in rigid if run.settled], "e_n"))
    draw_means(states, groups, color="k", marker="s", markersize=4, label="rigid")
    for k_n, (label, color) in STIFFNESSES.items():
        groups = sorted(grouped([run for run in soft if run.k_n == k_n and run.stays and not still_gains(run)], "e_n"))
        draw_means(states, groups, color=color, marker="o", linestyle="none", markerfacecolor="none", label=label)
        of_this = [x for x in excesses if x.k_n == k_n]
        excess.errorbar([x.wall_speed for x in of_this], [100 * x.value for x in of_this], [100 * x.error for x in of_this],
                        color=color, marker="o", linestyle="none", markerfacecolor="none", capsize=2)
    states.set(xlabel="e_N", ylabel="mean axial velocity (m/s)", yscale="log")
    states.legend(fontsize=8, title="slow branch")
    ratios = [0.01 * i for i in range(71)]
    excess.plot(ratios, [100 * RULE * ratio**2 for ratio in ratios], color="0.5", linewidth=0.8)
    excess.axhline(0, color="0.5", linewidth=0.8)
    excess.set(xlabel="slip at the wall / v_crit", ylabel="faster than rigid grains by (%)", xlim=(0, 0.85), ylim=(-4, 42))
    return figure


def draw_means(axes, groups, **style):
    means = [mean_of_runs("velocity", runs) for _, runs in groups]
    axes.errorbar([e_n for (e_n,), _ in groups], [value for value, _ in means], [error for _, error in means], capsize=2,
                  **style)
