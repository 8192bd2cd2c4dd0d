"""What a campaign is asked to do, as it stands in a TOML file.

The random numbers of an aggregate follow from the seed of the campaign and from what the aggregate is, in the manner of
`numpy.random.SeedSequence.spawn` with a hash in place of the count of children: not from who works on it, or when.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta, Struct

from rheoclast.campaigns.choices import COUNTING, NATURAL
from rheoclast.campaigns.conditions import Conditions
from rheoclast.campaigns.families import combinations, is_random
from rheoclast.campaigns.identity import derived_seed
from rheoclast.campaigns.task import Task
from rheoclast.hydrodynamics.response import DIMENSIONLESS_VISCOSITY
from rheoclast.scales import warn_of_radii, warn_of_viscosity

_PLACE = re.compile(r" - at `\$\.?([^`]*)`$")
_PLAIN_WORDS = {
    "Object contains unknown field": "unknown key",
    "Object missing required field": "missing key",
    "Expected": "expected",
    "array": "list",
    "object": "table",
    "`": "",
}


class Seeds(Struct, frozen=True, forbid_unknown_fields=True):
    """Aggregates of every kind are numbered from `first` on."""

    number: COUNTING = 1
    first: NATURAL = 0


class Campaign(Conditions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Families × sizes × seeds of aggregates, and the `Conditions` that each of them meets.

    Attributes
    ----------
    families
        Tables with the `name` of a family and its own parameters; a list stands for every one of its values.
    sizes
        Numbers of spheres, for families that are given no `count`.
    seeds
        How many aggregates of every kind, unless the family knows only one.
    seed
        Of everything random in the campaign.
    """

    families: Annotated[tuple[dict[str, Any], ...], Meta(min_length=1)]
    sizes: tuple[COUNTING, ...] = ()
    seeds: Seeds = Seeds()
    seed: NATURAL = 0

    def __post_init__(self) -> None:
        Conditions.__post_init__(self)
        list(self._kinds())
        self._refuse_unreadable_histories()

    def tasks(self) -> tuple[Task, ...]:
        """Its units of work, each once, in the order of the file."""
        return tuple({task.digest: task for task in self._tasks()}.values())

    def _tasks(self) -> Iterator[Task]:
        conditions = Conditions(**{name: getattr(self, name) for name in Conditions.__struct_fields__})
        for family, parameters in self._kinds():
            replicates = range(self.seeds.first, self.seeds.first + self.seeds.number) if is_random(family) else (0,)
            for replicate in replicates:
                identity = (family, parameters, replicate)
                yield Task(
                    family=family,
                    parameters=parameters,
                    replicate=replicate,
                    seed=derived_seed(self.seed, "aggregate", *identity) if is_random(family) else None,
                    orientation_seed=derived_seed(self.seed, "orientations", *identity),
                    history_seed=None if self.histories is None else derived_seed(self.seed, "histories", *identity),
                    conditions=conditions,
                )

    def _kinds(self) -> Iterator[tuple[str, dict[str, Any]]]:
        for position, asked in enumerate(self.families):
            try:
                yield from combinations(asked, self.sizes, self.radius)
            except ValueError as error:
                raise ValueError(f"families[{position}]: {plain(error)}") from None

    def _refuse_unreadable_histories(self) -> None:
        if self.histories is not None:
            try:
                self.histories.refuse_unreadable()
            except ValueError as error:
                raise ValueError(f"histories: {error}") from None


def read_campaign(path: str | os.PathLike[str]) -> Campaign:
    """The campaign of a TOML file.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    ValueError
        If it is not TOML, or a key is unknown, missing, or has a value that is not understood.

    Warns
    -----
    UnitWarning
        If the radius or the viscosity is so large that its unit is probably wrong.
    """
    try:
        campaign = msgspec.toml.decode(Path(path).read_bytes(), type=Campaign)
    except FileNotFoundError:
        raise FileNotFoundError(f"{path}: there is no such file; check its name and the current folder") from None
    except ValueError as error:
        raise ValueError(f"{path}: {plain(error)}") from None
    if campaign.viscosity != DIMENSIONLESS_VISCOSITY:
        warn_of_radii(np.array([campaign.radius]))
        warn_of_viscosity(campaign.viscosity)
    return campaign


def plain(error: Exception) -> str:
    """What a reader of typed data complains about: the key first, in the words of TOML."""
    message = str(error)
    place = _PLACE.search(message)
    if place is None and not isinstance(error, msgspec.ValidationError):
        return message
    message = _PLACE.sub("", message)
    if message.startswith(tuple(_PLAIN_WORDS)):
        for typed, word in _PLAIN_WORDS.items():
            message = message.replace(typed, word)
    return f"{place[1]}: {message}" if place and place[1] else message
