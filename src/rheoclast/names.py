"""Flows, hydrodynamic models and criteria by the names that commands and campaigns know them by."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Literal

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
