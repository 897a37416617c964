"""The frames of a run, read one at a time: all of them may not fit into memory."""

from __future__ import annotations

import pathlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import h5py
import numpy as np
from numpy.typing import NDArray

from .files import opened

_REMEDY = "only flows have one, if they are given a setting output.trajectory_interval"


@dataclass(frozen=True, eq=False, repr=False)
class Frame:
    """Grains at one moment, in the order of their ids: arrays of the shape (grains, 2), x across
    and y along the tube, in [0, length)."""

    time: float  #: s
    step: int
    position: NDArray[np.float32]  #: m
    velocity: NDArray[np.float32]  #: m/s
    spin: NDArray[np.float32] | None  #: rad/s, of shape (grains,); None where grains do not rotate
    wall_position: NDArray[np.float32]  #: m, of wall grains

    def __repr__(self) -> str:
        return f"<Frame at {self.time:g} s of {len(self.position)} grains>"


class Trajectory(Sequence[Frame]):
    """trajectory.h5 as a sequence of frames, each of which is read when it is asked for."""

    def __init__(self, path: pathlib.Path) -> None:
        self._path = path
        with opened(path, _REMEDY) as file:
            grains = file["particles/grains"]
            self.time: NDArray[np.float64] = grains["position/time"][()]  #: s, of all frames
            self.step: NDArray[np.int64] = grains["position/step"][()]
            self.radius: NDArray[np.float64] = grains["radius"][()]  #: m
            self.mass: NDArray[np.float64] = grains["mass"][()]  #: kg
            walls = file["particles/walls"]
            self.walls_move: bool = isinstance(walls["position"], h5py.Group)
            self.wall_radius: NDArray[np.float64] = walls["radius"][()]  #: m

    def __len__(self) -> int:
        return len(self.time)

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        index = range(len(self))[index]
        # Opened anew for each frame, even in a loop: a run in progress overwrites what HDF5 has
        # read of the file (its outline, io/trajectory_file.hpp).
        with opened(self._path, _REMEDY) as file:
            grains, walls = file["particles/grains"], file["particles/walls/position"]
            return Frame(time=float(self.time[index]), step=int(self.step[index]),
                         position=grains["position/value"][index, :, :2],
                         velocity=grains["velocity/value"][index, :, :2],
                         spin=grains["spin/value"][index] if "spin" in grains else None,
                         wall_position=walls["value"][index, :, :2] if self.walls_move
                         else walls[:, :2])
