"""Named columns with units, and how they are read from an HDF5 file of riesel."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from .names import NoSuchName


class Table(Mapping[str, NDArray[Any]]):
    """Columns by name: numpy arrays of equal length, numbers or texts. `unit[name]` is SI, "1" for
    pure numbers and "" where there is none; `doc[name]` says what it is. Equal only to itself."""

    __eq__ = object.__eq__  # that of mappings would need the truth value of arrays
    __hash__ = object.__hash__

    def __init__(self, columns: Mapping[str, NDArray[Any]], unit: Mapping[str, str],
                 doc: Mapping[str, str]) -> None:
        self._columns = columns
        self.unit = unit
        self.doc = doc

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Raises KeyError, which lists the names most like this one."""
        if name not in self._columns:
            raise NoSuchName(name, "column", self._columns)
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """The number of columns."""
        return len(self._columns)

    def label(self, name: str) -> str:
        """The label for an axis: "mean_vy (m/s)". Raises KeyError like table[name]."""
        self[name]
        unit = self.unit[name]
        return name if unit in ("", "1") else f"{name} ({unit})"

    def __repr__(self) -> str:
        return f"Table({', '.join(map(self.label, self))})"


def text(value: Any) -> str:
    """The text of an attribute, or of a data set that is a single text."""
    return value.decode() if isinstance(value, bytes) else str(value)


def _column(data: Any) -> NDArray[Any]:
    values: NDArray[Any] = np.asarray(data[()])
    return np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values


def table_of(group: Any) -> Table:
    """The data sets of a group; groups within it are left out."""
    data = {name: item for name, item in group.items() if isinstance(item, h5py.Dataset)}
    return Table({name: _column(item) for name, item in data.items()},
                 {name: text(item.attrs.get("unit", "")) for name, item in data.items()},
                 {name: text(item.attrs.get("doc", "")) for name, item in data.items()})
