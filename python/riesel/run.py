"""The directory of one run."""

from __future__ import annotations

import json
import math
import os
import pathlib
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import yaml
from numpy.typing import NDArray

from .estimate import Estimate
from .files import RESTORE, NotThere, Unreadable, call, members, part
from .names import there_is
from .table import Table, table_of, text
from .trajectory import Trajectory
from .tree import Tree

_SUMMARY_FORMAT = 2  # summary_format of io/summary.hpp


class Finding(NamedTuple):
    """One of the findings that validity rests on (docs/validity.md)."""

    name: str
    value: float | None
    suspect: float | None
    unphysical: float | None
    bad_if: str
    verdict: str


class Validity(NamedTuple):
    """`verdict`: valid, suspect or unphysical."""

    verdict: str
    findings: list[Finding]

    def reasons(self) -> list[Finding]:
        """The findings whose verdict is not valid."""
        return [finding for finding in self.findings if finding.verdict != "valid"]


@dataclass(frozen=True, eq=False)
class Histogram:
    """Contacts or visits by one of their properties, in four equal bins per octave: `rate` is how
    many per second ended in each bin after the transient, `count` how many since the start."""

    lower_edge: NDArray[np.float64]
    count: NDArray[np.int64]
    rate: NDArray[np.float64]
    rate_error: NDArray[np.float64]
    unit: str  #: of the edges
    doc: str

    @property
    def edges(self) -> NDArray[np.float64]:
        """One more than there are bins, as matplotlib's `stairs` expects them."""
        end_of_last_octave = 2.0 * self.lower_edge[-4]
        return np.append(self.lower_edge, end_of_last_octave)


@dataclass(frozen=True, eq=False)
class FinalState:
    """The grains, contacts and walls at one moment: m, m/s, kg, N. Grains are in the order of their
    ids; columns of vectors have the shape (grains, 2), x across and y along the tube. A contact is
    that of `grain` with `partner`, another grain (`wall` is -1) or one of a wall, and `force` is
    on `grain` (in runs of riesel 0.16 and later)."""

    time: float  #: s
    step: int
    width: float  #: m, across
    length: float  #: m, the period
    grains: Table
    contacts: Table
    walls: Table


class Run:
    """What a run has left in its directory. Missing parts raise NotThere, damaged files Unreadable.
    What has been read is kept: to see what a run in progress has written since, make a new Run."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = pathlib.Path(directory)
        if not self.directory.is_dir():
            raise NotThere(f"{self.directory}: is not a directory; give that of a run")

    def __repr__(self) -> str:
        return f"Run({str(self.directory)!r})"

    @property
    def is_done(self) -> bool:
        """Whether the run has come to its end: only then is there a summary."""
        return self._summary_file.exists()

    @cached_property
    def settings(self) -> Tree:
        """Every setting used, defaults included, in SI units: settings["contact.friction"]."""
        return Tree(members(self.directory / "effective.yaml", yaml.safe_load,
                            "give the directory of a run"))

    @cached_property
    def summary(self) -> Tree:
        """summary.json: summary["balance.n_dot"]. Values that are unknown are None."""
        summary = Tree(members(self._summary_file, json.loads, self._go_on,
                               self._restored_summary))
        number = summary.get("format", 1)  # files of format 1 do not say
        if number != _SUMMARY_FORMAT:
            version = summary.get("version", "?")
            raise Unreadable(f"{self._summary_file}: has format {number} of riesel {version}, but "
                             f"this package reads {_SUMMARY_FORMAT}; use the package of that "
                             "riesel, or make the run again")
        return summary

    def estimate(self, name: str) -> Estimate:
        """A value of the summary with its error: estimate("mean_axial_velocity"). For
        estimate("balance.n_dot") the error is among those of the balance. Raises KeyError."""
        section, _, last = name.rpartition(".")
        for value, error in ((f"{name}.value", f"{name}.error"),
                             (name, f"{section}.errors.{last}")):
            if value in self.summary and error in self.summary:
                return Estimate(_known(self.summary[value]), _known(self.summary[error]))
        raise KeyError(f"{name}: the summary has no such value with an error; "
                       f"{there_is(name, self._names_of_estimates())}")

    def _names_of_estimates(self) -> Iterator[str]:
        """What estimate() accepts."""
        for name in self.summary:
            if name.endswith(".error"):
                yield name.removesuffix(".error")
            elif ".errors." in name:
                yield name.replace(".errors.", ".")

    @cached_property
    def validity(self) -> Validity:
        """The verdict on a flow. The points of a curve have one each, in the table `curve`."""
        if "validity.verdict" not in self.summary:
            raise NotThere(f"{self.directory}: impacts and columns of beads have no verdict of the "
                           "whole run; see curve['verdict']")
        try:
            findings = [Finding(*(finding[name] for name in Finding._fields))
                        for finding in self.summary["validity.findings"]]
        except (KeyError, TypeError) as error:
            raise Unreadable(f"{self._summary_file}: is damaged (its findings: {error!r}); "
                             f"{self._restored_summary}") from error
        return Validity(self.summary["validity.verdict"], findings)

    @cached_property
    def series(self) -> Table:
        """Of a flow: one row per output.interval; while it runs, up to the last checkpoint."""
        with self._part("series", "only flows have one") as group:
            return table_of(group)

    @cached_property
    def profiles(self) -> Table:
        """Profiles across the tube: "x", the middle of each strip, and NAME with NAME_error."""
        with self._part("profiles", self._written_at_the_end) as group:
            return table_of(group)

    @cached_property
    def histograms(self) -> Mapping[str, Histogram]:
        """Histograms of contacts and of visits to walls, by name."""
        with self._part("histograms", self._written_at_the_end) as group:
            return {name: _histogram(item) for name, item in group.items()}

    @cached_property
    def final(self) -> FinalState:
        """Of a flow, the state at its last checkpoint: its end if `is_done`, and of a run that
        failed, the state in which it failed. `step` and `time` tell which it is."""
        with self._part("final",
                        "only flows have one, from their first checkpoint on") as group:
            return FinalState(time=float(group.attrs["time"]), step=int(group.attrs["step"]),
                              width=float(group.attrs["box_width"]),
                              length=float(group.attrs["box_length"]), grains=table_of(group),
                              contacts=table_of(group["contacts"]), walls=table_of(group["walls"]))

    @cached_property
    def trajectory(self) -> Trajectory:
        """The frames of trajectory.h5, if the run was told to write them."""
        return Trajectory(self.directory / "trajectory.h5")

    @cached_property
    def curve(self) -> Table:
        """Of an impact scenario or bead_column: a row per point, as in docs/files.md; "verdict" is
        0 for valid, 1 for suspect, 2 for unphysical."""
        with self._part("curve", "only impact scenarios and bead_column have one") as group:
            return table_of(group)

    @cached_property
    def provenance(self) -> Mapping[str, str]:
        """Version, commit, machine, command line, ... of the start of the run."""
        return self._provenances[0]

    @cached_property
    def resumptions(self) -> list[Mapping[str, str]]:
        """The same for each time the run was resumed."""
        return self._provenances[1:]

    @cached_property
    def _provenances(self) -> list[Mapping[str, str]]:
        with self._part("provenance", "give the directory of a run") as group:
            resumed = sorted((name for name in group if name.startswith("resume_")),
                             key=lambda name: int(name.removeprefix("resume_")))
            return [_texts(group), *(_texts(group[name]) for name in resumed)]

    def _part(self, name: str, if_without: str) -> AbstractContextManager[Any]:
        return part(self.directory / "run.h5", name, self._go_on, if_without, sealed=True)

    @property
    def _summary_file(self) -> pathlib.Path:
        return self.directory / "summary.json"

    @property
    def _restored_summary(self) -> str:
        """What to do about a damaged one."""
        if (self.directory / "checkpoint.h5").exists():
            return f"restore the file, or make it anew by '{call('resume', self.directory)}'"
        return RESTORE

    @property
    def _go_on(self) -> str:
        checkpoints = ("checkpoint.h5", "checkpoint.h5.previous")
        if any((self.directory / name).exists() for name in checkpoints):
            return f"let the run come to its end, or see '{call('resume', self.directory)}'"
        # Impacts and columns of beads write no checkpoints, nor has a flow that has just begun.
        return "let the run come to its end, or start it again if it was stopped"

    _written_at_the_end = "only flows have them, when they have come to their end"


def _known(value: float | None) -> float:
    return math.nan if value is None else float(value)


def _histogram(group: Any) -> Histogram:
    columns = table_of(group)
    return Histogram(lower_edge=columns["lower_edge"], count=columns["count"],
                     rate=columns["rate"], rate_error=columns["rate_error"],
                     unit=columns.unit["lower_edge"], doc=text(group.attrs.get("doc", "")))


def _texts(group: Any) -> Mapping[str, str]:
    return {name: str(column) for name, column in table_of(group).items()}
