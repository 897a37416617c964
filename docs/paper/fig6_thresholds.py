"""Fig. 6: where the slow branch ends, and what spacing, width and length of the tube have to do with it."""
from itertools import pairwise

from results import print_table, save
from tube import WINDOWS, grouped, plus_minus, runs_of_all, stay_cells, steady_of

MAP = 50  # mm, length of the tubes of fig6_map, whose e_N lie far apart
TABLES = ("fig6_slow", "fig6_spacing", "fig6_narrow", "fig6_length", "fig6_choices", "fig6_clipped", "fig6_map")


class Threshold:
    """Where the slow branch ends: the mean e_N below which a start is lost, of tubes that differ in e_N and seed only.

    It is the estimate of Spearman and Kaerber: between one e_N and the next, as many starts get lost as there are less of
    those that stay. The error is that of so few seeds, and of where between two e_N they get lost (any place is as good).
    """

    def __init__(self, runs, is_lost=lambda run: run.lost):
        points = [(e_n, len(at_this), sum(map(is_lost, at_this)) / len(at_this))
                  for (e_n,), at_this in sorted(grouped(runs, "e_n"))]
        self.seeds = sorted({seeds for _, seeds, _ in points})
        self.all_lost = max((e_n for e_n, _, part in points if part == 1), default=None)
        self.none_lost = min((e_n for e_n, _, part in points if part == 0 and e_n > (self.all_lost or 0)), default=None)
        self.value, self.error = None, None
        if self.all_lost is not None and self.none_lost is not None:
            self.value, self.error = spearman_kaerber(
                [point for point in points if self.all_lost <= point[0] <= self.none_lost])

    @property
    def text(self):
        if self.value is not None:
            return plus_minus(self.value, self.error)
        if self.all_lost is None and self.none_lost is None:
            return "somewhere"  # some starts are lost everywhere, and some stay
        return f"below {self.none_lost:g}" if self.all_lost is None else f"above {self.all_lost:g}"


def spearman_kaerber(points):
    """Mean and error of [(e_N, seeds, part that is lost)], from where all are lost to where none is."""
    pairs = list(pairwise(points))
    weights = [low[2] - high[2] for low, high in pairs]
    value = sum(weight * (low[0] + high[0]) / 2 for weight, (low, high) in zip(weights, pairs))
    of_places = sum((weight * (high[0] - low[0])) ** 2 / 12 for weight, (low, high) in zip(weights, pairs))
    of_seeds = sum(((after[0] - before[0]) / 2) ** 2 * part * (1 - part) / max(1, seeds - 1)
                   for before, (_, seeds, part), after in zip(points, points[1:], points[2:]))
    return value, (of_places + of_seeds) ** 0.5


def thresholds(tables):
    """[((k_n, width, length, spacing, attraction), Threshold)], lengths in mm and rounded."""
    runs = [run for run in runs_of_all(tables, TABLES) if run.branch != "fast"]
    for run in runs:
        run.attraction = run.attraction or "keep"
        run.spacing_mm, run.width_mm, run.length_mm = 1e3 * run.spacing, round(1e3 * run.width), round(1e3 * run.length)
    return [(place, Threshold(of_this))
            for place, of_this in grouped(runs, "k_n", "width_mm", "length_mm", "spacing_mm", "attraction")]


def fig6_thresholds(tables, out, plt):
    found = sorted(thresholds(tables), key=lambda item: item[0])
    print_table("Fig. 6, end of the slow branch",
                ("k_N (N/m)", "W (mm)", "L (mm)", "spacing (mm)", "attraction", "ends at e_N =", "all are lost at",
                 "none is lost at", "seeds"),
                [(*place, end.text, cell(end.all_lost), cell(end.none_lost), ", ".join(map(str, end.seeds)))
                 for place, end in found])
    print_hysteresis(runs_of_all(tables, ["fig6_hysteresis"]))
    print_lifetimes(runs_of_all(tables, ["fig6_lifetimes"]))
    save(draw_thresholds(plt, found), out / "fig6_thresholds.svg")


def cell(e_n):
    return "" if e_n is None else f"{e_n:g}"


def draw_thresholds(plt, found):
    """The ends with their errors over the spacing, 2000 N/m; arrows where all e_N that were tried lie below."""
    figure, axes = plt.subplots(figsize=(6, 3.4))
    shifts = {24: -0.008, 96: 0.008}
    for (k_n, width, length, spacing, attraction), end in found:
        if k_n != 2000 or attraction != "keep" or length == MAP or end.all_lost is None:
            continue
        axes.errorbar(spacing + shifts.get(length, 0.0), end.value or end.all_lost, end.error or 0.006,
                      lolims=end.value is None, color={10: "C1", 20: "C0"}[width],
                      marker="s" if length > 60 else "v" if length < 40 else "o", markersize=4, capsize=3)
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
    ends = (end for end, share in zip(ends_of_windows(run), run.windows("share")) if share < 0.5)
    return next(ends, None)


def ends_of_windows(run):
    return [run.time * i / WINDOWS for i in range(1, WINDOWS + 1)]


def ends_by(runs):
    """[(s, end of the slow branch of runs that have lasted so long)]."""
    return [(time, Threshold(runs, lambda run: (lost_by(run) or float("inf")) < 1.01 * time))
            for time in ends_of_windows(runs[0])]


def print_lifetimes(runs):
    rows, ends = [], []
    for (k_n,), of_stiffness in grouped(runs, "k_n"):
        for (e_n,), of_this in grouped(of_stiffness, "e_n"):
            lost = list(filter(None, map(lost_by, of_this)))
            rows.append((k_n, e_n, *stay_cells(of_this), steady_of(run for run in of_this if run.stays),
                         *(f"{sum(end < 1.01 * time for end in lost)}" for time in ends_of_windows(of_this[0]))))
        ends.append((k_n, *(end.text for _, end in ends_by(of_stiffness))))
    times = [f"{time:.1f} s" for time in ends_of_windows(runs[0])]
    print_table("Fig. 6, the slow branch near its end, for 12 s",
                ("k_N (N/m)", "e_N", "stay", "mean v_y (m/s)", "steady", *(f"lost by {time}" for time in times)), rows)
    print_table("Fig. 6, where the slow branch ends after so long", ("k_N (N/m)", *times), ends)
