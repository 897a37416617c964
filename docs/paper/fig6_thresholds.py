"""Fig. 6: where the slow branch ends, and what spacing, width and length of the tube have to do with it."""
from results import print_table, save
from tube import WINDOWS, grouped, runs_of_all, stay_cells

TABLES = ("fig6_slow", "fig6_spacing", "fig6_narrow", "fig6_length", "fig6_choices", "fig6_clipped", "fig6_map")


class Threshold:
    """The end of the slow branch in tubes that differ in e_N and seed only."""

    def __init__(self, runs):
        by_e_n = sorted(grouped(runs, "e_n"))
        lost = [e_n for (e_n,), at_this in by_e_n if all(run.lost for run in at_this)]
        stay = [e_n for (e_n,), at_this in by_e_n if all(run.stays for run in at_this)]
        self.above = max(lost, default=None)
        self.below = min((e_n for e_n in stay if e_n > max(lost, default=0.0)), default=None)
        self.seeds = [len(at_this) for (e_n,), at_this in by_e_n if e_n in (self.above, self.below)]

    @property
    def text(self):
        if self.below is None:
            return f"above {self.above:g}"
        return f"below {self.below:g}" if self.above is None else f"{self.above:g} to {self.below:g}"


def thresholds(tables):
    """[((k_n, width, length, spacing, attraction), Threshold)], lengths in mm and rounded."""
    runs = [run for run in runs_of_all(tables, TABLES) if run.branch != "fast"]
    for run in runs:  # older tables have no column for the attraction
        run.attraction = getattr(run, "attraction", "") or "keep"
        run.spacing_mm, run.width_mm, run.length_mm = 1e3 * run.spacing, round(1e3 * run.width), round(1e3 * run.length)
    return [(place, Threshold(of_this))
            for place, of_this in grouped(runs, "k_n", "width_mm", "length_mm", "spacing_mm", "attraction")]


def fig6_thresholds(tables, out, plt):
    found = sorted(thresholds(tables), key=lambda item: item[0])
    print_table("Fig. 6, end of the slow branch",
                ("k_N (N/m)", "W (mm)", "L (mm)", "spacing (mm)", "attraction", "ends at e_N =", "seeds"),
                [(*place, threshold.text,
                  ", ".join(map(str, threshold.seeds))) for place, threshold in found])
    print_hysteresis(runs_of_all(tables, ["fig6_hysteresis"]))
    print_lifetimes(runs_of_all(tables, ["fig6_lifetimes"]))
    save(draw_thresholds(plt, found), out / "fig6_thresholds.svg")


def draw_thresholds(plt, found):
    """Bars from where all seeds are lost to where all stay, over the spacing; 2000 N/m."""
    figure, axes = plt.subplots(figsize=(6, 3.4))
    shifts = {24: -0.008, 48: 0.0, 95: 0.008, 96: 0.008}
    for (k_n, width, length, spacing, attraction), threshold in found:
        if k_n != 2000 or attraction != "keep" or threshold.above is None:
            continue
        high = threshold.below or 1.0
        axes.errorbar(spacing + shifts.get(length, 0.0), (threshold.above + high) / 2, (high - threshold.above) / 2,
                      color={10: "C1", 20: "C0"}[width], marker="s" if length > 60 else "v" if length < 40 else "o",
                      markersize=4, capsize=3)
    axes.axhline(0.85, color="0.5", linestyle=":", linewidth=0.8)
    for width, color in ((20, "C0"), (10, "C1")):
        axes.plot([], [], "o", color=color, label=f"W = {width} mm")
    for marker, length in (("v", 24), ("o", 48), ("s", 96)):
        axes.plot([], [], marker, color="0.5", label=f"L = {length} mm")
    axes.set(xlabel="spacing of the wall grains (mm)", ylabel="e_N where the slow branch ends", ylim=(0.68, 1.01))
    axes.legend(fontsize=7)
    return figure


# --- The way there ---

def print_hysteresis(runs):
    rows = []
    for (e_n,), at_this in sorted(grouped(runs, "e_n"), reverse=True):
        cells = []
        for leg in ("forward", "backward"):
            of_leg = [run for run in at_this if run.leg == leg]
            cells += stay_cells(of_leg) if of_leg else ("", "")
        rows.append((e_n, *cells))
    print_table("Fig. 6, the slow branch of 2000 N/m followed down and up",
                ("e_N", "stay on the way down", "mean v_y (m/s)", "stay on the way up", "mean v_y (m/s)"), rows)


# --- How long it lives ---

def lost_by(run):
    """s, the end of the first window in which the wall carries less than half of the weight, or None."""
    ends = (run.time * i / WINDOWS for i, share in enumerate(run.windows("share"), start=1) if share < 0.5)
    return next(ends, None)


def print_lifetimes(runs):
    rows = []
    for (e_n,), of_this in grouped(runs, "e_n"):
        ends = sorted(filter(None, map(lost_by, of_this)))
        rows.append((e_n, *stay_cells(of_this), ", ".join(f"{end:.3g}" for end in ends)))
    print_table("Fig. 6, the slow branch of 2000 N/m near its end, for 12 s",
                ("e_N", "stay", "mean v_y (m/s)", "the others are lost by (s)"), rows)
