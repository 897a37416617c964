"""Opening what riesel has written, and the errors for what is missing or damaged."""

from __future__ import annotations

import contextlib
import io
import pathlib
import re
import shlex
import zlib
from collections.abc import Callable, Iterator
from typing import Any

import h5py
import yaml

_SEAL_SIZE = 512  # seal_size of io/seal.hpp, bytes
_SEAL = re.compile(rb"riesel run\nAn HDF5 file behind a block of 512 bytes\n"
                   rb"bytes in all: (?P<size>\d{1,18})\n"
                   rb"FNV-1a of those behind the block: [0-9a-f]{16}\n"
                   rb"(CRC-32 of those behind the block: (?P<crc>[0-9a-f]{8})\n)?\0*")
RESTORE = "restore the file, or make the run again"


def call(subcommand: str, directory: pathlib.Path) -> str:
    """The command, to be shown: quoted such that a shell takes it."""
    path = str(directory)
    return f"riesel {subcommand} {shlex.quote('./' + path if path.startswith('-') else path)}"


class NotThere(LookupError):
    """A file, or a part of one, that was not written (yet). The text says why and what to do."""


class Unreadable(ValueError):
    """A file that is there but cannot be read as riesel's: it is damaged, or of another
    program or format. The text says which file, why, and what to do."""


@contextlib.contextmanager
def opened(path: pathlib.Path, if_missing: str, if_damaged: str = RESTORE,
           sealed: bool = False) -> Iterator[Any]:
    """The HDF5 file, open as long as the `with` block lasts. The texts are remedies for the
    messages. Raises NotThere if it is missing, and Unreadable for any flaw that shows in the
    block, or that the seal shows (docs/files.md)."""
    _require(path, if_missing)
    try:
        with h5py.File(_unsealed(path) if sealed else path, "r") as file:
            yield file
    except (OSError, KeyError, IndexError, RuntimeError, ValueError, TypeError,
            AttributeError) as error:  # the last two for a number in the place of a group
        raise Unreadable(f"{path}: cannot be read ({error}); {if_damaged}") from error


@contextlib.contextmanager
def part(path: pathlib.Path, name: str, if_missing: str, if_without: str,
         if_damaged: str = RESTORE, sealed: bool = False) -> Iterator[Any]:
    """A group of the HDF5 file, like `opened`. Raises NotThere if it is missing or empty, too:
    riesel makes that of the series for every run, even if it has none."""
    with opened(path, if_missing, if_damaged, sealed) as file:
        if not len(file.get(name, ())):
            raise NotThere(f"{path}: has no {name}; {if_without}")
        yield file[name]


def _unsealed(path: pathlib.Path) -> io.BytesIO:
    """The content of a file whose seal is intact. The seals of riesel 0.10 and before have no
    CRC-32: of these files only the length is checked. Raises ValueError."""
    image = path.read_bytes()
    seal = _SEAL.fullmatch(image[:_SEAL_SIZE])
    if not seal or int(seal["size"]) != len(image):
        raise ValueError("its seal is damaged, or not of its length")
    if seal["crc"] and int(seal["crc"], 16) != zlib.crc32(image[_SEAL_SIZE:]):
        raise ValueError("its checksum is wrong")
    return io.BytesIO(image)


def members(path: pathlib.Path, parse: Callable[[str], Any], if_missing: str,
            if_damaged: str = RESTORE) -> dict[str, Any]:
    """The mapping that the text file holds; `parse` is json.loads or yaml.safe_load. The texts are
    remedies for the messages. Raises NotThere, and Unreadable if it is damaged or no mapping."""
    _require(path, if_missing)
    try:
        values = parse(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError, yaml.YAMLError) as error:
        flaw = " ".join(str(error).split())  # PyYAML describes it on several lines
        raise Unreadable(f"{path}: is damaged ({flaw}); {if_damaged}") from error
    if not isinstance(values, dict):
        raise Unreadable(f"{path}: is damaged (it has no names); {if_damaged}")
    return values


def _require(path: pathlib.Path, remedy: str) -> None:
    if not path.exists():
        raise NotThere(f"{path}: is not there; {remedy}")
    if not (path.is_file() or path.is_dir()):  # a pipe would wait for its writer
        raise Unreadable(f"{path}: is no regular file; remove it")
