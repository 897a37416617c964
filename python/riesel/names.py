"""What a name that does not exist may have been meant for."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def there_is(name: str, names: Iterable[str]) -> str:
    """For messages: the names most like this one, or all of them in the order of the alphabet."""
    known = list(names)
    return f"there is {', '.join(difflib.get_close_matches(str(name), known) or sorted(known))}"
