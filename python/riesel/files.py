"""Opening what riesel has written, and what is said where it is not there or no longer whole."""

from __future__ import annotations

import contextlib
import pathlib
from collections.abc import Callable, Iterator
from typing import Any

import h5py
import yaml

_RESTORE = "restore the file, or make the run again"


class NotThere(LookupError):
    """A file or a part of it that was not written (yet); the text tells why and what to do."""


class Unreadable(ValueError):
    """A file that is there and cannot be read as what riesel writes: it is damaged, or of another
    program or format; the text tells which file, why, and what to do."""


@contextlib.contextmanager
def opened(path: pathlib.Path, if_missing: str, if_damaged: str = _RESTORE) -> Iterator[Any]:
    """The HDF5 file, for what is read of it at once. The texts are remedies. Raises NotThere, and
    Unreadable for any flaw that h5py finds meanwhile."""
    _require(path, if_missing)
    try:
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, KeyError, IndexError, RuntimeError, ValueError) as error:
        raise Unreadable(f"{path}: cannot be read ({error}); {if_damaged}") from error


def part(file: Any, name: str, remedy: str) -> Any:
    """A group of the HDF5 file. Raises NotThere if there is none, or nothing in it: riesel makes
    that of the series for every run."""
    if not len(file.get(name, ())):
        raise NotThere(f"{file.filename}: has no {name}; {remedy}")
    return file[name]


def members(path: pathlib.Path, parse: Callable[[str], Any], if_missing: str,
            if_damaged: str = _RESTORE) -> dict[str, Any]:
    """Of the one mapping that the text file is, by json.loads or yaml.safe_load. The texts are
    remedies. Raises NotThere and Unreadable."""
    _require(path, if_missing)
    try:
        values = parse(path.read_text(encoding="utf-8"))
    except (ValueError, yaml.YAMLError) as error:
        flaw = " ".join(str(error).split())  # PyYAML tells it in several lines
        raise Unreadable(f"{path}: is damaged ({flaw}); {if_damaged}") from error
    if not isinstance(values, dict):
        raise Unreadable(f"{path}: is damaged (it has no names); {if_damaged}")
    return values


def _require(path: pathlib.Path, remedy: str) -> None:
    if not path.exists():
        raise NotThere(f"{path}: is not there; {remedy}")
