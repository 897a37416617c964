"""What a name that does not exist may have been meant for."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class NoSuchName(KeyError):
    """A name that does not exist among the `known` ones. The text, which is made only when it is
    asked for, lists those most like it."""

    def __init__(self, name: str, what: str, known: Iterable[str]) -> None:
        super().__init__(name)
        self._what = what
        self._known = known

    def __str__(self) -> str:
        return f"{self.args[0]}: there is no such {self._what}; {there_is(self.args[0], self._known)}"


def there_is(name: str, names: Iterable[str]) -> str:
    """For messages: the names most like this one, or all of them in the order of the alphabet."""
    known = list(names)
    return f"there is {', '.join(difflib.get_close_matches(str(name), known) or sorted(known))}"
