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


class TubePicture:
    """Lengths in m: positions as (x, y), y along the fall."""

    def __init__(self, width, length, wall_positions, wall_radii, radii, swing=0.0):
        """`swing`: how far walls go beyond their lines."""
        height = 1.3 + 9.4 * width / length  # of the figure; its width is 11
        even_pixels = 0.2  # films want them
        self.figure, self._axes = plt.subplots(figsize=(11, round(height / even_pixels) * even_pixels), dpi=130)
        self._walls = self._discs(wall_positions, wall_radii, facecolor="0.55")
        self._grains = self._discs(np.zeros((len(radii), 2)), radii, cmap="viridis", linewidth=0)
        self._axes.set(xlim=(0, length * MM), ylim=(-1 - swing * MM, (width + swing) * MM + 1), aspect="equal",
                       xlabel="y along the fall (mm)", ylabel="x (mm)")
        self.figure.colorbar(self._grains, label="axial velocity (m/s)", pad=0.02, fraction=0.012)
        self._axes.set_title("t")  # so that there is room for one
        self.figure.tight_layout()

    def _discs(self, positions, radii, **style):
        diameters = 2 * MM * radii
        circles = EllipseCollection(diameters, diameters, 0 * diameters, units="xy",
                                    offsets=positions[:, ::-1] * MM, transOffset=self._axes.transData, **style)
        return self._axes.add_collection(circles)

    def move_walls(self, positions):
        self._walls.set_offsets(positions[:, ::-1] * MM)

    def show(self, positions, axial_velocities, velocity_range=None, title=""):
        """`velocity_range`: what the colours span; by default that of the grains."""
        self._grains.set_offsets(positions[:, ::-1] * MM)
        self._grains.set_array(axial_velocities)
        self._grains.set_clim(*(velocity_range or (axial_velocities.min(), axial_velocities.max())))
        self._axes.set_title(title)


def wall_grains(final):
    """[[x, y, radius]] in m of all wall grains where the walls are at the end."""
    time = final.attrs["step"] * final.attrs["time_step"]
    length = final.attrs["box_length"]
    grains = [np.empty((0, 3))]
    walls = final["walls"]
    for i, count in enumerate(walls["count"][:]):
        line, radius, velocity, amplitude_x, amplitude_y, frequency, phase, start = (
            walls[name][i] for name in ("line", "radius", "velocity", "amplitude_x", "amplitude_y", "frequency",
                                        "phase", "start"))
        swing = np.sin(phase + 2 * np.pi * frequency * time)
        way = start * 2.0**-64 * length + velocity * time + amplitude_y * swing
        y = (np.arange(count) * length / max(count, 1) + way) % length
        grains.append(np.column_stack([np.full(count, line + amplitude_x * swing), y, np.full(count, radius)]))
    return np.concatenate(grains)


def draw(run_file: Path, picture: Path) -> None:
    with h5py.File(run_file) as file:
        final = file["final"]
        walls = wall_grains(final)
        swing = max(abs(final["walls"]["amplitude_x"][:]))
        tube = TubePicture(final.attrs["box_width"], final.attrs["box_length"], walls[:, :2], walls[:, 2],
                           final["radius"][:], swing)
        tube.show(final["position"][:], final["velocity"][:, 1])
    tube.figure.savefig(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(Path(sys.argv[1]) / "run.h5", Path(sys.argv[2]))
