"""What a campaign is asked to do, as it stands in a TOML file.

The random numbers of an aggregate follow from the seed of the campaign and from what the aggregate is, in the manner of
`numpy.random.SeedSequence.spawn` with a hash in place of the count of children: not from who works on it, or when.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping
from difflib import get_close_matches
from inspect import signature
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta, Struct

from rheoclast.campaigns.choices import COUNTING, NATURAL
from rheoclast.campaigns.conditions import Conditions, ContactMaterial, Hydrodynamics, NamedGradient, Orientations
from rheoclast.campaigns.families import RADIUS, SEED, combinations, is_random
from rheoclast.campaigns.histories import Histories
from rheoclast.campaigns.identity import derived_seed
from rheoclast.campaigns.task import Task
from rheoclast.generation.families import FAMILIES
from rheoclast.hydrodynamics.response import DIMENSIONLESS_VISCOSITY
from rheoclast.scales import warn_of_radii, warn_of_viscosity

_PLACE = re.compile(r" - at `\$\.?([^`]*)`$")
_UNKNOWN, _MISSING = "Object contains unknown field ", "Object missing required field "
_KINDS = {
    "int": "an integer",
    "float": "a number",
    "str": "text",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
}
"""Types as a reader of typed data calls them, in the words of TOML."""


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
                raise ValueError(f"families[{position}]: {plain(error, asked, _parameters(asked))}") from None

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
    FileNotFoundError, IsADirectoryError
        If there is no such file, or a folder in its place.
    ValueError
        If it is not TOML, or a key is unknown, missing, or has a value that is not understood.

    Warns
    -----
    UnitWarning
        If a radius or the viscosity is so large that its unit is probably wrong.
    """
    request = _decoded(Path(path))
    try:
        campaign = msgspec.convert(_located(request, Path(path).parent), Campaign, dec_hook=_as_path)
    except ValueError as error:
        raise ValueError(f"{path}: {plain(error, request, _TABLES)}") from None
    if campaign.viscosity != DIMENSIONLESS_VISCOSITY:
        warn_of_radii(np.array([campaign.radius, *(parameters[RADIUS] for _, parameters in campaign.kinds())]))
        warn_of_viscosity(campaign.viscosity)
    return campaign


def _decoded(path: Path) -> dict[str, Any]:
    """What stands in a file of TOML."""
    if path.is_dir():
        raise IsADirectoryError(f"{path}: expected a campaign in TOML, got a folder; name a file in it")
    try:
        return dict(msgspec.toml.decode(path.read_bytes()))
    except FileNotFoundError:
        raise FileNotFoundError(f"{path}: there is no such file; check its name and the current folder") from None
    except UnicodeDecodeError as error:
        raise ValueError(
            f"{path}: expected a campaign in TOML, got byte {error.object[error.start]:#x} at position {error.start}, "
            "which is no text in UTF-8; save it as UTF-8"
        ) from None
    except msgspec.DecodeError as error:
        problem = f"{error}"[0].lower() + f"{error}"[1:]
        raise ValueError(f"{path}: expected a campaign in TOML, with lines key = value; {problem}") from None


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
    if not isinstance(value, str):
        raise ValueError(f"expected the name of a file, got {value!r:.60}")
    return Path(value)


_TABLES = {
    "": Campaign.__struct_fields__,
    "seeds": Seeds.__struct_fields__,
    "hydrodynamics": Hydrodynamics.__struct_fields__,
    "orientations": Orientations.__struct_fields__,
    "flows": NamedGradient.__struct_fields__,
    "materials": ContactMaterial.__struct_fields__,
    "histories": Histories.__struct_fields__,
}
"""Keys of the tables of a campaign."""


def _parameters(asked: Mapping[str, Any]) -> Mapping[str, Collection[str]]:
    """Keys of the table of a family, if it is known."""
    family = FAMILIES.get(str(asked.get("name")))
    return {} if family is None else {"": ("name", *(key for key in signature(family).parameters if key != SEED))}


def plain(error: Exception, request: Any, tables: Mapping[str, Collection[str]]) -> str:
    """What a reader of typed data complains about: the key first, in the words of TOML, and what stands there.

    Parameters
    ----------
    error
        The complaint.
    request
        The data.
    tables
        The keys that are known, by the place of the table in the data.
    """
    found = _PLACE.search(str(error))
    if found is None and not isinstance(error, msgspec.ValidationError):
        return str(error)
    message, place = _PLACE.sub("", str(error)), found[1] if found else ""
    if message.startswith(_UNKNOWN):
        message = _unknown(message.removeprefix(_UNKNOWN).strip("`"), tables.get(re.sub(r"\[\d+\]", "", place), ()))
    elif message.startswith(_MISSING):
        message = f"missing key {message.removeprefix(_MISSING).strip('`')}"
    elif message.startswith("Expected"):
        message = f"{_expected(message)}, got {_at(request, place)!r:.60}"
    return f"{place}: {message}" if place else message


def _unknown(key: str, known: Collection[str]) -> str:
    nearest = get_close_matches(key, known, 1)
    if nearest:
        return f"unknown key {key}; did you mean {nearest[0]}?"
    return f"unknown key {key}; " + (f"known are {', '.join(known)}" if known else "remove it")


def _expected(message: str) -> str:
    """The type that was expected, without the one that came: "expected an integer of at least 1"."""
    wanted = message.partition(", got ")[0].removeprefix("Expected ").replace("`", "")
    kinds, _, bound = wanted.partition(" of length ")
    kinds, _, least = kinds.partition(" >= ")
    named = " or ".join(_KINDS.get(kind, kind) for kind in kinds.split(" | ") if kind != "null")
    return f"expected {named}" + (
        f" of at least {least}" if least else f" of length {bound.replace('>=', 'at least')}" if bound else ""
    )


def _at(request: Any, place: str) -> Any:
    """The value at a place such as `histories.files[0]`."""
    for key, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", place):
        request = request[int(index) if index else key]
    return request
