"""Fig. 6: the slow and the fast branch of three stiffnesses, seeds together."""
from statistics import mean

from results import print_table, save
from tube import grouped, mean_of_runs, mean_text, runs_of, runs_of_all, stay_cells, steady_of, still_gains

LONG_ENOUGH = 3.0  # s, for a fast run to settle
SAME = 0.05  # part of a velocity by which runs may differ that approach the same state
COLORS = {200.0: "C2", 2000.0: "C0", 2e5: "C3"}


# --- The slow branch ---

def slow_row(k_n, e_n, runs):
    stay, velocity = stay_cells(runs)
    return (k_n, e_n, stay, f"{sum(run.lost for run in runs)} of {len(runs)}", velocity,
            steady_of(run for run in runs if run.stays), f"{max(run.brake_failure for run in runs):.1g}")


def fig6(tables, out, plt):
    slow = runs_of(tables / "fig6_slow.csv")
    print_table("Fig. 6, slow starts, spacing 1.2 mm, W = 20 mm, L = 48 mm, 3 s",
                ("k_N (N/m)", "e_N", "stay", "lost", "mean v_y of those that stay (m/s)", "steady", "brake failure, worst"),
                [slow_row(*place, runs) for place, runs in grouped(slow, "k_n", "e_n")])
    save(draw_fig6(plt, slow, fast_states(tables)), out / "fig6.svg")


def draw_fig6(plt, slow, fast):
    """Full: the slow branch, mean of the seeds that stay. Open: the fast states."""
    figure, panels = plt.subplots(1, len(COLORS), figsize=(10, 3.4), sharey=True)
    for axes, (k_n, color) in zip(panels, COLORS.items()):
        for (e_n,), runs in grouped([run for run in slow if run.k_n == k_n and run.stays and not still_gains(run)],
                                      "e_n"):
            draw_state(axes, e_n, runs, color, marker="o")
        for state in (state for state in fast if state.k_n == k_n):
            for runs in state.states:
                draw_state(axes, state.e_n, runs, color, marker="^", markerfacecolor="none")
        axes.set(xlabel="e_N", title=f"k_N = {k_n:g} N/m", yscale="log", xlim=(0.55, 1), ylim=(1, 1000))
    panels[0].set_ylabel("mean axial velocity (m/s)")
    panels[0].plot([], [], "ko", label="slow branch")
    panels[0].plot([], [], "k^", markerfacecolor="none", label="fast branch")
    panels[0].legend(fontsize=7)
    return figure


def draw_state(axes, e_n, runs, color, **symbol):
    """The mean of several seeds with its error; of a single one the point."""
    value, error = mean_of_runs("velocity", runs)
    axes.errorbar(e_n, value, error if len(runs) > 1 else None, color=color, capsize=2, **symbol)


# --- The fast branch ---

class FastState:
    """All fast starts at one stiffness and e_N. In a short run the grains hardly leave the velocity of their start, so that it
    settles nothing."""

    def __init__(self, k_n, e_n, runs):
        self.k_n, self.e_n, self.runs = k_n, e_n, runs
        self.settled = [run for run in runs if run.lost and run.settled and run.time >= LONG_ENOUGH]

    @property
    def states(self):
        """Of the settled runs those that lasted longest, each list of one state: starts that have not come to the same
        velocity are of two."""
        if not self.settled:
            return []
        longest = [run for run in self.settled if run.time == max(run.time for run in self.settled)]
        starts = [of_this for _, of_this in grouped(longest, "start")]
        means = [mean(run.velocity for run in start) for start in starts]
        return starts if max(means) > (1 + SAME) * min(means) else [longest]

    @property
    def text(self):
        return " and ".join(mean_text("velocity", runs) for runs in self.states)


def fast_states(tables):
    runs = runs_of_all(tables, ("fig6_fast", "fig6_fast_long", "fig6_stiff"))
    return [FastState(*place, of_this) for place, of_this in sorted(grouped(runs, "k_n", "e_n"))]


def states_of(runs):
    return ", ".join(dict.fromkeys(run.state.replace("_", " ") for run in runs))


def fast_row(k_n, e_n, start, runs):
    return (k_n, e_n, start, runs[0].time, len(runs), mean_text("velocity_5", runs), mean_text("share_5", runs),
            states_of(runs), f"{max(run.brake_failure for run in runs):.2g}",
            f"{min(run.steps_per_contact for run in runs):.2g}")


def fig6_fast(tables, out, plt):
    states = fast_states(tables)
    print_table("Fig. 6, fast branch: the states", ("k_N (N/m)", "e_N", "fast state (m/s)", "settled", "steady"),
                [(s.k_n, s.e_n, s.text, f"{len(s.settled)} of {len(s.runs)}", steady_of(s.settled)) for s in states])
    print_table("Fig. 6, fast branch: the runs; in the last fifth of each",
                ("k_N (N/m)", "e_N", "start (m/s)", "time (s)", "seeds", "v_y at the end (m/s)", "n_dot dv_y / g", "state",
                 "brake failure", "steps per contact"),
                [fast_row(s.k_n, s.e_n, start, runs) for s in states for (start,), runs in grouped(s.runs, "start")])
    save(draw_fast(plt, [run for s in states for run in s.runs]), out / "fig6_fast.svg")


def draw_fast(plt, runs):
    """How much of the weight the wall carries at which velocity, in the windows of each run: where it passes 1 upwards
    there is a stable state."""
    figure, panels = plt.subplots(1, len(COLORS), figsize=(10, 3.5), sharey=True)
    colors = {e_n: f"C{i}" for i, e_n in enumerate(sorted({run.e_n for run in runs}))}
    for axes, k_n in zip(panels, COLORS):
        for run in (run for run in runs if run.k_n == k_n):
            axes.plot(run.windows("velocity"), run.windows("share"), "o-", markersize=3, color=colors[run.e_n])
        axes.axhline(1, color="0.5", linewidth=0.8)
        axes.set(xlabel="mean axial velocity (m/s)", title=f"k_N = {k_n:g} N/m", ylim=(0, 3))
    for e_n, color in colors.items():
        panels[0].plot([], [], "o-", markersize=3, color=color, label=f"e_N = {e_n:g}")
    panels[0].set_ylabel("the wall's share of the weight")
    panels[0].legend(fontsize=7)
    return figure
