#!/usr/bin/env python3
"""Draws the final state of a tube: python3 draw_tube.py RUN_DIRECTORY PICTURE.png

Grains are coloured by their axial velocity; the walls are grey. The tube is laid on its side, the fall goes to the
right.
"""
import sys
from pathlib import Path
from typing import NamedTuple

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import EllipseCollection

MM = 1e3  # per metre


class TubePicture:
    """Lengths in m: positions as (x, y), y along the fall."""

    def __init__(self, width, length, wall_positions, wall_radii, radii, walls):
        """`wall_positions`: of the grains of `walls` (Wall)."""
        swing = max(abs(wall.amplitude_x) for wall in walls)
        height = 1.3 + 9.4 * width / length  # of the figure; its width is 11
        even_pixels = 0.2  # films want them
        self.figure, self._axes = plt.subplots(figsize=(11, round(height / even_pixels) * even_pixels), dpi=130)
        self._walls = self._discs(wall_positions, wall_radii, facecolor="0.55")
        self._grains = self._discs(np.zeros((len(radii), 2)), radii, cmap="viridis", linewidth=0)
        self._axes.set(xlim=(0, length * MM), ylim=(-1 - swing * MM, (width + swing) * MM + 1), aspect="equal",
                       xlabel="y along the fall (mm)", ylabel="x (mm)")
        self._smooth_walls = [(wall, self._axes.axhline(wall.line * MM, color="0.55", linewidth=2))
                              for wall in walls if wall.count == 0]
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

    def move_smooth_walls(self, time):
        for wall, line in self._smooth_walls:
            line.set_ydata([wall.x(time) * MM] * 2)

    def show(self, positions, axial_velocities, velocity_range=None, title=""):
        """`velocity_range`: what the colours span; by default that of the grains."""
        self._grains.set_offsets(positions[:, ::-1] * MM)
        self._grains.set_array(axial_velocities)
        self._grains.set_clim(*(velocity_range or (axial_velocities.min(), axial_velocities.max())))
        self._axes.set_title(title)


class Wall(NamedTuple):
    """As in the final state of a run."""

    count: int  # of its grains; 0: it is smooth
    line: float
    radius: float
    velocity: float
    amplitude_x: float
    amplitude_y: float
    frequency: float
    phase: float
    start: int

    def swing(self, time):
        return np.sin(self.phase + 2 * np.pi * self.frequency * time)

    def x(self, time):
        return self.line + self.amplitude_x * self.swing(time)

    def grains(self, time, length):
        """[[x, y, radius]] in m."""
        way = self.start * 2.0**-64 * length + self.velocity * time + self.amplitude_y * self.swing(time)
        y = (np.arange(self.count) * length / max(self.count, 1) + way) % length
        return np.column_stack([np.full(self.count, self.x(time)), y, np.full(self.count, self.radius)])


def walls_of(final):
    columns = [final["walls"][name][:] for name in Wall._fields]
    return [Wall(*wall) for wall in zip(*columns)]


def draw(run_file: Path, picture: Path) -> None:
    with h5py.File(run_file) as file:
        final = file["final"]
        time, length = final.attrs["step"] * final.attrs["time_step"], final.attrs["box_length"]
        walls = walls_of(final)
        grains = np.concatenate([wall.grains(time, length) for wall in walls])
        tube = TubePicture(final.attrs["box_width"], length, grains[:, :2], grains[:, 2], final["radius"][:], walls)
        tube.move_smooth_walls(time)
        tube.show(final["position"][:], final["velocity"][:, 1])
    tube.figure.savefig(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(Path(sys.argv[1]) / "run.h5", Path(sys.argv[2]))
