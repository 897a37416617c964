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
from .files import NotThere, Unreadable, call, members, part
from .run import Run
from .table import Table, table_of


@dataclass(frozen=True)
class Point:
    """One run of a sweep as listed in the manifest. `status`, `attempts` and `reason` are as they
    were when the manifest was written; `is_done` looks at the directory itself."""

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
        """The run itself. Raises NotThere if its directory was removed (to start it afresh)."""
        return Run(self.directory)

    @property
    def is_done(self) -> bool:
        """Whether its run has come to its end and is still there."""
        return self.directory.is_dir() and self.run.is_done


@dataclass(frozen=True)
class _OfRuns:
    """A result over runs of a sweep that differ in one setting only, such as the seed."""

    settings: Mapping[str, float | str | None]  #: the other settings that vary, in SI units
    branch: str  #: or ""
    leg: str  #: or ""
    runs: int  #: how many the mean is over
    steady: int  #: how many of them are steady flows; impacts never are
    valid: int  #: how many of them have the verdict valid: check before using the mean


@dataclass(frozen=True)
class Mean(_OfRuns):
    """The mean of a column of the table, over the runs that have a number there."""

    value: float
    error: float  #: 68 %, from the scatter of the runs, see mean_of(); NaN for a single run

    def __str__(self) -> str:
        counts = f"{self.runs} runs, {self.steady} steady, {self.valid} valid"
        return f"{Estimate(self.value, self.error)} ({counts})"


@dataclass(frozen=True)
class MeanProfiles(_OfRuns):
    """The means of the profiles, over the runs that are done."""

    profiles: Table  #: as Run.profiles, with errors from the scatter; no columns if none is done


class Sweep:
    """What `riesel sweep` has left in its directory."""

    varied: Mapping[str, str]  #: the settings in which the points differ, with their units
    points: list[Point]  #: in the order of the sweep file; equal ones as often as it has them

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = pathlib.Path(directory)
        file = self.directory / "manifest.json"
        anew = "run 'riesel sweep' with its sweep file: it writes a new one and keeps the results"
        manifest = members(file, json.loads, "give the directory of a sweep", anew)
        try:
            self.varied = {setting["key"]: setting["unit"] for setting in manifest["varied"]}
            self.points = [self._point(entry) for entry in manifest["points"]]
        except (KeyError, TypeError) as error:
            raise Unreadable(f"{file}: is not a manifest of a sweep ({error!r}); {anew}") from error

    def __repr__(self) -> str:
        return f"Sweep({str(self.directory)!r})"

    @cached_property
    def table(self) -> Table:
        """The table of the last `riesel sweep` or `riesel collect`: a row per point, done or not,
        with its settings and all single values of its summary, NaN or "" where there is none. It
        does not know what points have become since, by `riesel resume` for one."""
        remedy = f"make it with '{call('collect', self.directory)}'"
        with part(self.directory / "sweep.h5", "points", remedy, remedy, remedy) as group:
            return table_of(group)

    def groups(self, over: str = "seed") -> list[list[Point]]:
        """The points in groups that differ only in the setting `over`, each point once, in the
        order of the sweep file. Raises NotThere if the sweep does not vary it."""
        if over not in self.varied:
            raise NotThere(f"{self.directory}: does not vary {over}; "
                           f"choose one of {', '.join(self.varied)}")
        groups: dict[tuple[Any, ...], dict[str, Point]] = {}
        for point in self.points:
            others = tuple(item for item in point.settings.items() if item[0] != over)
            groups.setdefault((others, point.branch, point.leg), {})[point.name] = point
        return [list(group.values()) for group in groups.values()]

    def means(self, column: str, over: str = "seed") -> list[Mean]:
        """The means of a column of `table` over the points that differ only in the setting `over`,
        in the order of the sweep file. All runs count; each mean tells how many are steady and how
        many are valid, and whether the others may count is for you to decide."""
        groups = self.groups(over)
        table = self.table
        if column not in table or table[column].dtype.kind != "f":
            raise NotThere(f"{self.directory}: no run has a numeric column {column}; "
                           "list(sweep.table) shows the columns")
        unknown = np.full(len(table[column]), "")
        states, verdicts = table.get("state", unknown), table.get("validity.verdict", unknown)
        row_of = {name: row for row, name in enumerate(table["point"])}
        means = []
        for group in groups:
            if any(point.name not in row_of for point in group):
                raise NotThere(f"{self.directory}: its table lacks a point; make it again with "
                               f"'{call('collect', self.directory)}'")
            rows = [row for point in group
                    if math.isfinite(table[column][row := row_of[point.name]])]
            mean = mean_of([float(value) for value in table[column][rows]])
            means.append(Mean(**_common(group[0], over), runs=len(rows),
                              steady=sum(states[row] == "steady" for row in rows),
                              valid=sum(verdicts[row] == "valid" for row in rows),
                              value=mean.value, error=mean.error))
        return means

    def mean_profiles(self, over: str = "seed") -> list[MeanProfiles]:
        """The means of the profiles, strip by strip, over the points that differ only in the
        setting `over`, otherwise as means(). Raises ValueError if their strips differ."""
        found = []
        for group in self.groups(over):
            done = [point.run for point in group if point.is_done]
            states = [run.summary.get("state") for run in done]
            verdicts = [run.summary.get("validity.verdict") for run in done]
            found.append(MeanProfiles(**_common(group[0], over), runs=len(done),
                                      steady=states.count("steady"), valid=verdicts.count("valid"),
                                      profiles=_mean_of_profiles(done)))
        return found

    def _point(self, entry: Mapping[str, Any]) -> Point:
        if not isinstance(entry["settings"], dict):
            raise TypeError("a point without settings")
        return Point(directory=self.directory / "points" / entry["name"], name=entry["name"],
                     settings=entry["settings"], branch=entry["branch"], leg=entry["leg"],
                     parent=entry["parent"], status=entry["status"], attempts=entry["attempts"],
                     reason=entry["reason"])


def _common(point: Point, over: str) -> dict[str, Any]:
    """What a group of points has in common, taken from one of them."""
    return {"settings": {key: value for key, value in point.settings.items() if key != over},
            "branch": point.branch, "leg": point.leg}


def _mean_of_profiles(runs: list[Run]) -> Table:
    if not runs:
        return Table({}, {}, {})
    first = runs[0].profiles
    for run in runs:
        if not np.array_equal(run.profiles["x"], first["x"]):
            raise ValueError(f"{run.directory}: its strips differ from those of "
                             f"{runs[0].directory}; average runs of equal strips only")
    columns = {"x": first["x"]}
    for name in first:
        if f"{name}_error" not in first:
            continue
        strips = [mean_of([value for value in strip if math.isfinite(value)])
                  for strip in zip(*(run.profiles[name].tolist() for run in runs))]
        columns[name] = np.array([mean.value for mean in strips])
        columns[f"{name}_error"] = np.array([mean.error for mean in strips])
    return Table(columns, first.unit, first.doc)
