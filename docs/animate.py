#!/usr/bin/env python3
"""Makes a film of a run that has a trajectory: python3 animate.py RUN_DIRECTORY FILM.mp4 [--fps 25]

    riesel run scenarios/periodic_tube.yaml --out runs/film --set output.trajectory_interval='2 ms'
    python3 docs/animate.py runs/film film.mp4

Each frame of the trajectory is a picture as draw_tube.py makes them, with one scale of colours for all. Needs ffmpeg.
"""
import argparse
from pathlib import Path

import h5py
import numpy as np
from matplotlib.animation import FFMpegWriter

from draw_tube import TubePicture, walls_of


def animate(run: Path, film: Path, frames_per_second: float) -> None:
    with h5py.File(run / "run.h5") as file:
        all_walls = walls_of(file["final"])  # a trajectory has no smooth ones
    with h5py.File(run / "trajectory.h5") as file:
        grains, walls = file["particles/grains"], file["particles/walls"]
        positions, velocities = grains["position/value"], grains["velocity/value"]
        times = grains["position/time"][:]
        walls_move = isinstance(walls["position"], h5py.Group)
        wall_positions = walls["position/value"][:] if walls_move else walls["position"][:][None]
        width, length = grains["box/edges"][:2]
        tube = TubePicture(width, length, wall_positions[0][:, :2], walls["radius"][:], grains["radius"][:], all_walls)
        # Rare fast grains shall not take the colours from the others.
        sample = velocities[:: max(1, len(times) // 50)][:, :, 1]
        velocity_range = tuple(np.percentile(sample, [0.5, 99.5]))
        writer = FFMpegWriter(fps=frames_per_second, extra_args=["-pix_fmt", "yuv420p"],
                              metadata={"title": str(run)})
        with writer.saving(tube.figure, str(film), dpi=130):
            for i, time in enumerate(times):
                if walls_move:
                    tube.move_walls(wall_positions[i][:, :2])
                tube.move_smooth_walls(time)
                tube.show(positions[i][:, :2], velocities[i][:, 1], velocity_range, f"t = {time * 1e3:.1f} ms")
                writer.grab_frame()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("run", type=Path, help="directory of the run")
    parser.add_argument("film", type=Path)
    parser.add_argument("--fps", type=float, default=25.0, help="pictures per second [25]")
    options = parser.parse_args()
    if not FFMpegWriter.isAvailable():
        parser.error("ffmpeg is missing; install it")
    animate(options.run, options.film, options.fps)
