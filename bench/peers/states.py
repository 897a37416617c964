"""The state in a riesel checkpoint, as other codes can be told it."""

from typing import NamedTuple

import h5py
import numpy as np


class State(NamedTuple):
    """SI units; position, velocity and acceleration have a row for each grain, ordered by id; y is in [0, length)."""
    width: float
    length: float
    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    radius: np.ndarray
    mass: np.ndarray
    wall_position: np.ndarray
    wall_radius: np.ndarray
    touching: np.ndarray  # a row for each contact: its two bodies, free grains first and then those of walls
    spring: np.ndarray  # m, the tangential spring of each


def wall_grains(walls, length):
    """Positions and radii of all wall grains: grain k of a wall stands at y = k length / count."""
    lines, radii, counts = walls["line"][:], walls["radius"][:], walls["count"][:]
    places = [np.column_stack([np.full(n, line), np.arange(n) * (length / n)]) for line, n in zip(lines, counts)]
    return np.concatenate(places), np.repeat(radii, counts)


def bodies_in_contact(contacts, grains, walls):
    """Rows of two: the number of a free grain among `grains` of them, and of its partner; those of walls follow."""
    first_of_wall = grains + np.concatenate([[0], np.cumsum(walls["count"][:])])
    wall = contacts["wall"][:]  # -1: between free grains
    partner = contacts["partner"][:] + np.where(wall < 0, 0, first_of_wall[wall])
    return np.column_stack([contacts["grain"][:], partner])


def read_state(path):
    """The state in a checkpoint; engine/state.hpp tells what the integers mean."""
    with h5py.File(path) as file:
        grains = file["grains"]
        qx, qy = grains.attrs["quantum_x"], grains.attrs["quantum_y"]
        dt = file.attrs["time_step"]
        fall = np.int64(np.rint(file.attrs["gravity_y"] * dt * dt / qy))
        with np.errstate(over="ignore"):  # integers wrap, as they do in the engine
            falling = grains["uy"][:] + fall * np.int64(file.attrs["step"])
        half_step_velocity = np.column_stack([grains["ux"][:] * (qx / dt), falling * (qy / dt)])
        acceleration = np.column_stack([grains["kick_x"][:] * (qx / dt**2), (grains["kick_y"][:] + fall) * (qy / dt**2)])
        length = float(file.attrs["box_length"])
        wall_position, wall_radius = wall_grains(file["walls"], length)
        return State(
            width=float(file.attrs["box_width"]),
            length=length,
            position=np.column_stack([grains["x"][:] * qx, grains["y"][:].astype(np.uint64) * qy % length]),
            velocity=half_step_velocity + 0.5 * dt * acceleration,
            acceleration=acceleration,
            radius=grains["radius"][:],
            mass=grains["mass"][:],
            wall_position=wall_position,
            wall_radius=wall_radius,
            touching=bodies_in_contact(file["contacts"], len(grains["radius"]), file["walls"]),
            spring=file["contacts"]["spring"][:])
