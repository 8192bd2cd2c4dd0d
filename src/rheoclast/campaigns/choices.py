"""What a campaign may name or number: flows, hydrodynamic models and criteria of failure, and the usual refusals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping
from types import MappingProxyType
from typing import Annotated, Any, Literal

from msgspec import Meta

from rheoclast.flows import LinearFlow, biaxial_extension, planar_extension, simple_shear, uniaxial_extension
from rheoclast.hydrodynamics.exposed_area import ExposedArea
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.mechanics.criteria.combined import Combined
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.rolling import Rolling
from rheoclast.mechanics.criteria.sliding import Sliding
from rheoclast.mechanics.criteria.tension import Tension
from rheoclast.mechanics.criteria.twisting import Twisting

NATURAL = Annotated[int, Meta(ge=0)]
COUNTING = Annotated[int, Meta(ge=1)]

FLOWS: Mapping[str, Callable[[float], LinearFlow]] = MappingProxyType(
    {
        "shear": simple_shear,
        "uniaxial": uniaxial_extension,
        "biaxial": biaxial_extension,
        "planar": planar_extension,
    }
)
"""Flows by name, from their rate."""

MODELS: Mapping[str, Callable[[int | Literal["auto"], float], HydrodynamicModel]] = MappingProxyType(
    {
        "stokesian": StokesianDynamics,
        "free-draining": lambda order, accuracy: FreeDraining(),
        "exposed-area": lambda order, accuracy: ExposedArea(),
    }
)
"""Hydrodynamic models by name, from multipole order and accuracy."""

CRITERIA: Mapping[str, Callable[[float], Criterion]] = MappingProxyType(
    {
        "every-limit": lambda friction: Tension() | Sliding(friction) | Rolling() | Twisting(),
        "tension": lambda friction: Tension(),
        "sliding": Sliding,
        "rolling": lambda friction: Rolling(),
        "twisting": lambda friction: Twisting(),
        "combined": lambda friction: Combined(),
    }
)
"""Criteria by name, from the coefficient of friction."""


def one_of(key: str, choices: Collection[str], name: str) -> None:
    """Refuse a name that is none of the choices for a key.

    Raises
    ------
    ValueError
        With the key and the choices.
    """
    if name not in choices:
        raise ValueError(f"{key}: expected one of {', '.join(choices)}, got {name!r}")


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
