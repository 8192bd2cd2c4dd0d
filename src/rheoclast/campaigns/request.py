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
from rheoclast.campaigns.families import RADIUS, combinations, is_random
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
        list(self.kinds())
        self._refuse_unreadable_histories()

    def tasks(self) -> tuple[Task, ...]:
        """Its units of work, each once, in the order of the file."""
        return tuple({task.digest: task for task in self._tasks()}.values())

    def _tasks(self) -> Iterator[Task]:
        conditions = Conditions(**{name: getattr(self, name) for name in Conditions.__struct_fields__})
        for family, parameters in self.kinds():
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

    def kinds(self) -> Iterator[tuple[str, dict[str, Any]]]:
        """Family and parameters of every kind of aggregates."""
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
    """The campaign of a TOML file, from whose folder on the paths of files of histories are taken.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    ValueError
        If it is not TOML, or a key is unknown, missing, or has a value that is not understood.

    Warns
    -----
    UnitWarning
        If a radius or the viscosity is so large that its unit is probably wrong.
    """
    try:
        request = msgspec.toml.decode(Path(path).read_bytes())
        campaign = msgspec.convert(_located(request, Path(path).parent), Campaign, dec_hook=_as_path)
    except FileNotFoundError:
        raise FileNotFoundError(f"{path}: there is no such file; check its name and the current folder") from None
    except ValueError as error:
        raise ValueError(f"{path}: {plain(error)}") from None
    if campaign.viscosity != DIMENSIONLESS_VISCOSITY:
        warn_of_radii(np.array([campaign.radius, *(parameters[RADIUS] for _, parameters in campaign.kinds())]))
        warn_of_viscosity(campaign.viscosity)
    return campaign


def _located(request: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The same request, with the files of histories where they lie as seen from a folder."""
    histories = request.get("histories")
    if not isinstance(histories, dict) or not isinstance(histories.get("files"), list):
        return request
    files = [_located_file(each, folder) for each in histories["files"]]
    return {**request, "histories": {**histories, "files": files}}


def _located_file(file: Any, folder: Path) -> Any:
    if isinstance(file, str):
        return str(folder / file)
    path = file.get("path") if isinstance(file, dict) else None
    return {**file, "path": str(folder / path)} if isinstance(path, str) else file


def _as_path(kind: type, value: Any) -> Path:
    """What stands for a path, the only type of a campaign that TOML does not know."""
    return Path(value)


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
