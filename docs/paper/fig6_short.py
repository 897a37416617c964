"""Fig. 6 in a tube of 100 mm: three stiffnesses and one seed, read from the kept table of the sweep as it is."""
from results import print_table, rows_of, save
from tube import is_settled, plus_minus

MARKERS = {"slow": ("o", "C0"), "fast": ("^", "C3")}


def cell_of(row):
    """The mean velocity if the wall carries the weight within two error bars and three per cent, else its share."""
    velocity, error, share, share_error, gravity = (float(row[key] or "nan") for key in (
        "mean_axial_velocity.value", "mean_axial_velocity.error", "balance.n_dot_dv_y", "balance.errors.n_dot_dv_y",
        "balance.gravity"))
    settled = is_settled(row["state"], share / gravity, share_error / gravity)
    return plus_minus(velocity, error) if settled else f"wall {share / gravity:.2f}"


def fig6_short(tables, out, plt):
    rows = [row for row in rows_of(tables / "fig6_short.csv") if row["status"] == "done"]
    e_ns = sorted({float(row["contact.restitution"]) for row in rows})
    table = {}
    for row in rows:
        place = (float(row["contact.stiffness"]), row["branch"])
        table.setdefault(place, {})[float(row["contact.restitution"])] = cell_of(row)
    print_table("Fig. 6, L = 100 mm, one seed, 3 s",
                ("k_N (N/m)", "start", *(f"e_N = {e_n:g}" for e_n in e_ns)),
                [(*place, *(cells[e_n] for e_n in e_ns)) for place, cells in table.items()])
    save(draw_short(plt, rows), out / "fig6_short.svg")


def draw_short(plt, rows):
    """A panel for each stiffness. An arrow: still accelerating."""
    stiffnesses = list(dict.fromkeys(float(row["contact.stiffness"]) for row in rows))
    figure, panels = plt.subplots(1, len(stiffnesses), figsize=(10, 3.3), sharey=True)
    for axes, k_n in zip(panels, stiffnesses):
        for row in (row for row in rows if float(row["contact.stiffness"]) == k_n):
            marker, color = MARKERS[row["branch"]]
            e_n, velocity = float(row["contact.restitution"]), float(row["mean_axial_velocity.value"])
            error = row["mean_axial_velocity.error"]
            axes.errorbar(e_n, velocity, float(error) if error else None, color=color, marker=marker, capsize=2,
                          markerfacecolor=color if row["state"] == "steady" else "none")
            if row["state"] == "accelerating":
                axes.annotate("", (e_n, 1.45 * velocity), (e_n, 1.1 * velocity),
                              arrowprops={"arrowstyle": "->", "color": color})
        axes.set(xlabel="e_N", title=f"k_N = {k_n:g} N/m", yscale="log", xlim=(0.55, 1), ylim=(1, 80))
    panels[0].set_ylabel("mean axial velocity (m/s)")
    for branch, (marker, color) in MARKERS.items():
        panels[0].plot([], [], marker=marker, color=color, linestyle="none", label=f"{branch} start")
    panels[0].legend(fontsize=7)
    return figure
