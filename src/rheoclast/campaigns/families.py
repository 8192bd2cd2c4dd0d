"""The aggregates that a campaign asks for: families with their own parameters, in every combination."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from inspect import Parameter, signature
from itertools import product
from typing import Annotated, Any, get_origin

import msgspec
from msgspec import Meta

from rheoclast.generation.families import FAMILIES
from rheoclast.names import one_of

SIZE, RADIUS, SEED = "count", "radius", "seed"


def is_random(family: str) -> bool:
    """Whether the aggregates of a family differ from seed to seed."""
    return SEED in _parameters(family)


def combinations(
    asked: Mapping[str, Any], sizes: tuple[int, ...], radius: float
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Family and parameters, but the seed, of every aggregate that one table of a campaign asks for.

    Parameters
    ----------
    asked
        The `name` of a family, and its own parameters, each one value or a list of them.
    sizes, radius
        For families that are not given their own.

    Raises
    ------
    ValueError
        If the family or a parameter is not known, one is missing, a list is empty, or a value is of another type.
    """
    name = asked.get("name", "")
    if not isinstance(name, str):
        raise ValueError(f"name: expected the name of one family, got {name!r}; give every family a table of its own")
    one_of("name", FAMILIES, name)
    parameters = _parameters(name)
    request = msgspec.convert(dict(asked), _request(name))
    values = {key: _several(getattr(request, key)) for key in parameters if key != SEED}
    if SIZE in values and not values[SIZE]:
        values[SIZE] = sizes
    if not values[RADIUS]:
        values[RADIUS] = (radius,)
    if values.get(SIZE) == ():
        raise ValueError(f"sizes: {name} needs numbers of spheres; give sizes, or the family its own {SIZE}")
    given = {key: each for key, each in values.items() if each}
    return ((name, dict(zip(given, each, strict=True))) for each in product(*given.values()))


def _several(value: Any) -> tuple[Any, ...]:
    if value is None:
        return ()
    return tuple(value) if isinstance(value, list) else (value,)


@cache
def _parameters(family: str) -> Mapping[str, Parameter]:
    return signature(FAMILIES[family], eval_str=True).parameters


@cache
def _request(family: str) -> type[msgspec.Struct]:
    """The type of a family's table: every parameter but the seed as one value or a list, where a value is no list."""
    fields: list[tuple[str, Any] | tuple[str, Any, Any]] = [("name", str)]
    for name, each in _parameters(family).items():
        several: Any = Annotated[list[each.annotation], Meta(min_length=1)]  # type: ignore[name-defined]
        kind = several if get_origin(each.annotation) is tuple else each.annotation | several
        needed = each.default is Parameter.empty and name != SIZE
        if name != SEED:
            fields.append((name, kind) if needed else (name, kind, None))
    return msgspec.defstruct(family.title().replace("-", ""), fields, kw_only=True, forbid_unknown_fields=True)
