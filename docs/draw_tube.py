#!/usr/bin/env python3
"""Draws the final state of a tube: python3 draw_tube.py RUN_DIRECTORY PICTURE.png

Grains are coloured by their axial velocity; the walls are grey. The tube is laid on its side, the fall goes to the
right.
"""
import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import EllipseCollection

MM = 1e3  # per metre


def discs(axes, x, y, diameters, **style):
    """Adds circles of the given diameters, in the units of the axes."""
    circles = EllipseCollection(diameters, diameters, 0 * diameters, units="xy",
                                offsets=np.column_stack([x, y]), transOffset=axes.transData, **style)
    return axes.add_collection(circles)


def draw(run_file: Path, picture: Path) -> None:
    with h5py.File(run_file) as file:
        final = file["final"]
        position = final["position"][:] * MM
        axial_velocity = final["velocity"][:, 1]
        radius = final["radius"][:] * MM
        length = float(final.attrs["box_length"]) * MM
        walls = final["walls"]
        lines, wall_radii, counts = walls["line"][:] * MM, walls["radius"][:] * MM, walls["count"][:]

    figure, axes = plt.subplots(figsize=(11, 3.1), dpi=130)
    for line, wall_radius, count in zip(lines, wall_radii, counts):
        places = np.arange(count) * length / count
        discs(axes, places, np.full(count, line), np.full(count, 2 * wall_radius), facecolor="0.55")
    grains = discs(axes, position[:, 1], position[:, 0], 2 * radius, array=axial_velocity,
                   cmap="viridis", linewidth=0)
    axes.set(xlim=(0, length), ylim=(lines.min() - 1, lines.max() + 1), aspect="equal",
             xlabel="y along the fall (mm)", ylabel="x (mm)")
    figure.colorbar(grains, label="axial velocity (m/s)", pad=0.01, fraction=0.012)
    figure.tight_layout()
    figure.savefig(picture)


if __name__ == "__main__":
    draw(Path(sys.argv[1]) / "run.h5", Path(sys.argv[2]))
