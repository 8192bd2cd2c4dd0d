"""What the keys of a campaign may number, and that they do not repeat themselves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Annotated, Any

from msgspec import Meta

NATURAL = Annotated[int, Meta(ge=0)]
COUNTING = Annotated[int, Meta(ge=1)]


def refuse_repeated(key: str, values: Iterable[Any]) -> None:
    """Refuse a value that stands for a key more than once.

    Raises
    ------
    ValueError
        With the key and the value.
    """
    for value, number in Counter(values).most_common(1):
        if number > 1:
            raise ValueError(f"{key}: expected different ones, got {value!r} {number} times; rename or remove one")
