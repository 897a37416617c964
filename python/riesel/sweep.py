"""The directory of a sweep."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from .run import Run
from .table import NotThere, Table, opened, part, table_of


@dataclass(frozen=True)
class Point:
    """One run of a sweep as its manifest has it. `status`, `attempts` and `reason` are those of the
    moment in which the manifest was written; `run.is_done` looks at the directory itself."""

    directory: pathlib.Path
    name: str
    settings: Mapping[str, float | str | None]  #: those that vary, in SI units
    branch: str  #: or ""
    leg: str  #: of a continuation: forward, backward, or ""
    parent: str  #: name of the point that it continues, or ""
    status: str  #: waiting, running, interrupted, done or failed
    attempts: int
    reason: str  #: why it failed or waits, or ""

    @property
    def run(self) -> Run:
        """The run itself."""
        return Run(self.directory)


class Sweep:
    """What `riesel sweep` has left in its directory."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = pathlib.Path(directory)
        manifest = self.directory / "manifest.json"
        if not manifest.exists():
            raise NotThere(f"{manifest}: is not there; give the directory of a sweep")
        self._manifest: dict[str, Any] = json.loads(manifest.read_text(encoding="utf-8"))

    def __repr__(self) -> str:
        return f"Sweep({str(self.directory)!r})"

    @cached_property
    def varied(self) -> Mapping[str, str]:
        """The settings in which the points differ, with their units."""
        return {setting["key"]: setting["unit"] for setting in self._manifest["varied"]}

    @cached_property
    def points(self) -> list[Point]:
        """In the order of the sweep file; equal points stand in the list as often as in it."""
        return [self._point(entry) for entry in self._manifest["points"]]

    @cached_property
    def table(self) -> Table:
        """The table of `riesel collect`: a row per point, done or not, with its settings and all
        single values of its summary, NaN or "" where there is none."""
        remedy = f"make it by 'riesel collect {self.directory}'"
        with opened(self.directory / "sweep.h5", remedy) as file:
            return table_of(part(file, "points", remedy))

    def _point(self, entry: Mapping[str, Any]) -> Point:
        return Point(directory=self.directory / "points" / entry["name"], name=entry["name"],
                     settings=entry["settings"], branch=entry["branch"], leg=entry["leg"],
                     parent=entry["parent"], status=entry["status"], attempts=entry["attempts"],
                     reason=entry["reason"])
