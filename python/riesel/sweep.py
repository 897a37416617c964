"""The directory of a sweep."""

from __future__ import annotations

import json
import math
import os
import pathlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .estimate import Estimate, mean_of
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


@dataclass(frozen=True)
class Mean:
    """Of a result over the runs of a sweep that differ in one setting alone, the seed for instance."""

    settings: Mapping[str, float | str | None]  #: the others that vary, in SI units
    branch: str  #: or ""
    leg: str  #: or ""
    value: float
    error: float  #: 68 %, by the scatter of the runs, see mean_of(); NaN of a single one
    runs: int  #: that have such a result
    steady: int  #: how many of them are steady flows; of impacts none is

    def __str__(self) -> str:
        return f"{Estimate(self.value, self.error)} ({self.runs} runs, {self.steady} steady)"


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

    def means(self, column: str, over: str = "seed") -> list[Mean]:
        """The means of a column of `table` over the points that differ in the setting `over` alone, in
        the order of the sweep file. Whether runs that are not steady may count is for you to say."""
        if over not in self.varied:
            raise NotThere(f"{self.directory}: does not vary {over}; choose one of {', '.join(self.varied)}")
        table = self.table
        if column not in table or table[column].dtype.kind != "f":
            raise NotThere(f"{self.directory}: no run has a number {column}; 'list(sweep.table)' tells what they have")
        states = table.get("state", np.full(len(table[column]), ""))
        result_of = {name: (float(value), state == "steady")
                     for name, value, state in zip(table["point"], table[column], states)}
        groups: dict[tuple[Any, ...], list[Point]] = {}
        for point in self.points:
            if point.name not in result_of:
                raise NotThere(f"{self.directory}: its table lacks a point; make it anew by 'riesel collect "
                               f"{self.directory}'")
            others = tuple(item for item in point.settings.items() if item[0] != over)
            groups.setdefault((others, point.branch, point.leg), []).append(point)
        return [_mean_of([result_of[name] for name in {point.name: None for point in group}], group[0], over)
                for group in groups.values()]

    def _point(self, entry: Mapping[str, Any]) -> Point:
        return Point(directory=self.directory / "points" / entry["name"], name=entry["name"],
                     settings=entry["settings"], branch=entry["branch"], leg=entry["leg"],
                     parent=entry["parent"], status=entry["status"], attempts=entry["attempts"],
                     reason=entry["reason"])


def _mean_of(results: list[tuple[float, bool]], first: Point, over: str) -> Mean:
    there = [(value, steady) for value, steady in results if math.isfinite(value)]
    mean = mean_of([value for value, _ in there])
    return Mean(settings={key: value for key, value in first.settings.items() if key != over},
                branch=first.branch, leg=first.leg,
                value=mean.value, error=mean.error, runs=len(there), steady=sum(steady for _, steady in there))
