"""Fig. 6: what the time step makes of the fast branch, and the pull of the dashpot."""
from statistics import mean

from fig6 import fast_states, states_of
from results import print_table, save
from tube import grouped, mean_text, runs_of


def fig6_steps(tables, out, plt):
    print_checks([run for name in ("fig6_checks", "fig6_clipped_fast") for run in runs_of(tables / f"{name}.csv")])
    print_rhythm([run for state in fast_states(tables) for run in state.settled])
    locking = runs_of(tables / "fig6_locking.csv")
    print_locking(locking)
    save(draw_locking(plt, locking), out / "fig6_steps.svg")


def check_row(place, runs):
    return (*place, *(mean_text(name, runs) for name in ("velocity_5", "share_5", "sigma_vx_5")),
            f"{min(run.steps_per_contact for run in runs):.2g}", states_of(runs))


def print_checks(runs):
    print_table("Fig. 6, fast branch: time step and attraction; in the last fifth of each",
                ("k_N (N/m)", "e_N", "start (m/s)", "steps per collision", "attraction", "time (s)", "v_y at the end (m/s)",
                 "n_dot dv_y / g", "sigma_vx (m/s)", "steps per contact", "state"),
                [check_row(place, of_this)
                 for place, of_this in grouped(runs, "k_n", "e_n", "start", "steps", "attraction", "time")])


# --- Do the grains keep step with the wall? ---

def steps_per_spacing(run):
    """How many time steps a grain of the outermost strips takes from one wall grain to the next."""
    return run.spacing / (run.velocity_wall * run.time_step)


def rhythm_row(place, runs):
    means = (mean(run.velocity for run in runs), mean(run.velocity_wall for run in runs), mean(map(steps_per_spacing, runs)))
    return (*place, *(f"{value:.2f}" for value in means))


def print_rhythm(runs):
    print_table("Fig. 6, fast branch: steps for the way from one wall grain to the next, t_col / 50",
                ("k_N (N/m)", "e_N", "start (m/s)", "v_y (m/s)", "v_y at the wall (m/s)", "steps per spacing"),
                [rhythm_row(*group) for group in grouped(runs, "k_n", "e_n", "start")])


def print_locking(runs):
    print_table("Fig. 6, fast branch of 2000 N/m, e_N = 0.90, with other time steps",
                ("steps per collision", "start (m/s)", "v_y (m/s)", "v_y at the wall (m/s)", "steps per spacing",
                 "n_dot dv_y / g", "steps per contact", "state"),
                [(run.steps, run.start, run.with_error("velocity"), run.velocity_wall, f"{steps_per_spacing(run):.2f}",
                  run.with_error("share"), f"{run.steps_per_contact:.2g}", run.state.replace("_", " ")) for run in runs])


def draw_locking(plt, runs):
    """The velocity at the wall over the steps per collision; on a grey line a wall spacing takes a whole number of steps."""
    figure, axes = plt.subplots(figsize=(6, 3.6))
    most = 1.05 * max(run.steps for run in runs)
    per_step = runs[0].spacing / (runs[0].time_step * runs[0].steps)
    for whole in range(6, 40):
        axes.plot([0, most], [0, per_step * most / whole], color="0.8", linewidth=0.7, zorder=0)
    for (start,), of_start in grouped(runs, "start"):
        axes.plot([run.steps for run in of_start], [run.velocity_wall for run in of_start], "o", markersize=4,
                  label=f"start at {start:g} m/s")
    axes.set(xlabel="steps per collision", ylabel="velocity at the wall (m/s)", xlim=(35, most), ylim=(95, 160))
    axes.legend(fontsize=7)
    return figure
