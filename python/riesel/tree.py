"""Nested values by dotted names, as in settings files, `--set` and the tables of sweeps (which have the findings of a
verdict and the lines of a curve besides, that are lists here)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .names import NoSuchName


class Tree(Mapping[str, Any]):
    """tree["contact.friction"] is the value; tree["contact"] is the Tree of that section. As a
    mapping it is flat: it iterates over the dotted names of all values."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    def __getitem__(self, name: str) -> Any:
        """Raises KeyError, which lists the names most like this one."""
        value: Any = self._values
        for part in str(name).split("."):
            if not isinstance(value, Mapping) or part not in value:
                raise NoSuchName(name, "value", self)
            value = value[part]
        return Tree(value) if isinstance(value, Mapping) else value

    def __iter__(self) -> Iterator[str]:
        for name, value in self._values.items():
            if isinstance(value, Mapping):
                yield from (f"{name}.{inner}" for inner in Tree(value))
            else:
                yield name

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"Tree({dict(self)!r})"
