#!/usr/bin/env python3
"""Writes the state of a riesel checkpoint as a data file for LAMMPS: python3 lammps_data.py CHECKPOINT.h5 OUT.data

Free grains are atoms 1 ... N of type 1, the wall grains follow as type 2. LAMMPS knows spheres only, so each grain gets the
density that gives it its mass.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np


class State(NamedTuple):
    """SI units; position and velocity have a row for each grain, ordered by id."""
    width: float
    length: float
    position: np.ndarray
    velocity: np.ndarray
    radius: np.ndarray
    mass: np.ndarray
    wall_position: np.ndarray
    wall_radius: np.ndarray


def wall_grains(walls, length):
    """Positions and radii of all wall grains: grain k of a wall stands at y = k length / count."""
    lines, radii, counts = walls["line"][:], walls["radius"][:], walls["count"][:]
    places = [np.column_stack([np.full(n, line), np.arange(n) * (length / n)]) for line, n in zip(lines, counts)]
    return np.concatenate(places), np.repeat(radii, counts)


def read_state(path):
    """The state in a checkpoint; engine/state.hpp tells what the integers mean."""
    with h5py.File(path) as file:
        grains = file["grains"]
        qx, qy = grains.attrs["quantum_x"], grains.attrs["quantum_y"]
        dt = file.attrs["time_step"]
        fall = np.int64(np.rint(file.attrs["gravity_y"] * dt * dt / qy))
        with np.errstate(over="ignore"):  # integers wrap, as they do in the engine
            falling = grains["uy"][:] + fall * np.int64(file.attrs["step"])
        length = float(file.attrs["box_length"])
        wall_position, wall_radius = wall_grains(file["walls"], length)
        return State(
            width=float(file.attrs["box_width"]),
            length=length,
            position=np.column_stack([grains["x"][:] * qx, grains["y"][:].astype(np.uint64) * qy]),
            velocity=np.column_stack([(grains["ux"][:] + 0.5 * grains["kick_x"][:]) * (qx / dt),
                                      (falling + 0.5 * (grains["kick_y"][:] + fall)) * (qy / dt)]),
            radius=grains["radius"][:],
            mass=grains["mass"][:],
            wall_position=wall_position,
            wall_radius=wall_radius)


def write_lammps_data(state, path):
    """Atoms as `atom_style sphere` wants them: id, type, diameter, density, x, y, z."""
    free, walls = len(state.radius), len(state.wall_radius)
    radius = np.concatenate([state.radius, state.wall_radius])
    mass = np.concatenate([state.mass, np.full(walls, state.mass.mean())])  # of frozen grains: of no consequence
    position = np.concatenate([state.position, state.wall_position])
    position[:, 1] %= state.length
    ids, zeros = np.arange(1, free + walls + 1), np.zeros(free + walls)
    margin = 2.0 * radius.max()  # across the tube, where the box ends beyond the walls
    with open(path, "w", encoding="ascii") as file:
        file.write(f"tube\n\n{free + walls} atoms\n2 atom types\n\n"
                   f"{-margin:.17g} {state.width + margin:.17g} xlo xhi\n0 {state.length:.17g} ylo yhi\n"
                   f"{-margin:.17g} {margin:.17g} zlo zhi\n\nAtoms # sphere\n\n")
        density = mass / (4.0 / 3.0 * np.pi * radius**3)
        kind = np.where(ids <= free, 1, 2)
        np.savetxt(file, np.column_stack([ids, kind, 2.0 * radius, density, position, zeros]),
                   fmt="%d %d %.17g %.17g %.17g %.17g %g")
        file.write("\nVelocities\n\n")
        velocity = np.concatenate([state.velocity, np.zeros((walls, 2))])
        np.savetxt(file, np.column_stack([ids, velocity, zeros, zeros, zeros, zeros]), fmt="%d %.17g %.17g %g %g %g %g")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write_lammps_data(read_state(Path(sys.argv[1])), Path(sys.argv[2]))
