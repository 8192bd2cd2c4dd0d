"""Flows, hydrodynamic models, contact laws and criteria by the names that commands and campaigns know them by.

What is entered here is known to both, with no further step. Families and models of turbulence have their names in
`generation.families` and `turbulence.models`, materials in `mechanics.material`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from inspect import signature
from types import MappingProxyType
from typing import Any, Literal, TypeVar

from rheoclast import _checks
from rheoclast.flows import LinearFlow, biaxial_extension, planar_extension, simple_shear, uniaxial_extension
from rheoclast.generation.chains import straight_chain
from rheoclast.hydrodynamics.exposed_area import ExposedArea
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.combined import Combined
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import limited_parts
from rheoclast.mechanics.criteria.rolling import Rolling
from rheoclast.mechanics.criteria.sliding import Sliding
from rheoclast.mechanics.criteria.tension import Tension
from rheoclast.mechanics.criteria.twisting import Twisting
from rheoclast.mechanics.laws.jkr import JKR
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.laws.measured_pull_off import MeasuredPullOff
from rheoclast.mechanics.material import MATERIALS, Material

Made = TypeVar("Made")

FLOWS: Mapping[str, Callable[[float], LinearFlow]] = MappingProxyType(
    {
        "shear": simple_shear,
        "uniaxial": uniaxial_extension,
        "biaxial": biaxial_extension,
        "planar": planar_extension,
    }
)
"""Flows by name, from their rate."""

MODELS: Mapping[str, Callable[..., HydrodynamicModel]] = MappingProxyType(
    {"stokesian": StokesianDynamics, "free-draining": FreeDraining, "exposed-area": ExposedArea}
)
"""Hydrodynamic models by name, from `order` and `accuracy` if they take them."""

LAWS: Mapping[str, Callable[..., ContactLaw]] = MappingProxyType({"jkr": JKR})
"""Contact laws by name, from a material, and from `friction` and `rolling_distance` if they take them."""

CRITERIA: Mapping[str, Callable[..., Criterion]] = MappingProxyType(
    {
        "every-limit": lambda friction: Tension() | Sliding(friction) | Rolling() | Twisting(),
        "tension": Tension,
        "sliding": Sliding,
        "rolling": Rolling,
        "twisting": Twisting,
        "combined": Combined,
    }
)
"""Criteria by name, from the coefficient of `friction` if they take it."""

LIMITED_BY = MappingProxyType(
    {"shear_strength": "friction", "twisting_strength": "friction", "bending_strength": "rolling_distance"}
)
"""What a law needs to know for a strength that it does not give by itself."""


def one_of(key: str, choices: Collection[str], name: str) -> None:
    """Refuse a name that is none of the choices for a key.

    Raises
    ------
    ValueError
        With the key and the choices.
    """
    if name not in choices:
        raise ValueError(f"{key}: expected one of {', '.join(choices)}, got {name!r}")


def hydrodynamic_model(name: str, order: int | Literal["auto"], accuracy: float) -> HydrodynamicModel:
    """The hydrodynamic model of a name, of a multipole order and with the accuracy of order "auto" if it has them."""
    one_of("model", MODELS, name)
    return _made(MODELS[name], order=order, accuracy=accuracy)


def contact_law(
    material: str,
    *,
    law: str = "jkr",
    youngs_modulus: float | None = None,
    poisson_ratio: float | None = None,
    work_of_adhesion: float | None = None,
    pull_off: float | None = None,
    stiffness: tuple[float, float, float, float] | None = None,
    friction: float | None = None,
    rolling_distance: float | None = None,
) -> ContactLaw:
    """The contact law of a material, with a measured pull-off force or explicit stiffness where they are given.

    Parameters
    ----------
    material
        Name in `MATERIALS`, or any other name together with all properties.
    law
        Name in `LAWS`.
    youngs_modulus, poisson_ratio, work_of_adhesion
        In Pa, 1 and J/m², by default those of the material of this name.
    pull_off
        Of every contact in N, by default that of the law.
    stiffness
        In place of that of the law: normal and tangential in N/m, bending and twisting in N m/rad. Needs `pull_off`.
    friction
        Coefficient, which limits shear and twisting too.
    rolling_distance
        In m, which limits bending too.

    Raises
    ------
    ValueError
        If a name is not known, a property is missing, a number is out of range, or two do not go together.
    """
    limits = {"friction": friction, "rolling_distance": rolling_distance}
    given = {name: value for name, value in limits.items() if value is not None}
    if pull_off is not None:
        _checks.positive("pull_off", pull_off)
    properties = {
        "youngs_modulus": youngs_modulus,
        "poisson_ratio": poisson_ratio,
        "work_of_adhesion": work_of_adhesion,
    }
    one_of("law", LAWS, law)
    if stiffness is not None:
        of_no_use = [name for name, value in properties.items() if value is not None]
        return _explicit_law(stiffness, pull_off, [*given, *of_no_use])
    _refuse_untaken(given, f"law {law!r}", signature(LAWS[law]).parameters)
    of_material = LAWS[law](_material(material, properties), **given)
    return of_material if pull_off is None else MeasuredPullOff(pull_off, of_material)


def _explicit_law(
    stiffness: tuple[float, float, float, float], pull_off: float | None, limits: Collection[str]
) -> ContactLaw:
    if pull_off is None:
        raise ValueError("stiffness: explicit stiffness needs the strength too; add pull_off")
    _refuse_untaken(limits, "explicit stiffness", ())
    return MeasuredPullOff(pull_off, Bonds(*stiffness))


def _refuse_untaken(given: Collection[str], taker: str, taken: Collection[str]) -> None:
    untaken = [name for name in given if name not in taken]
    if untaken:
        raise ValueError(f"{', '.join(untaken)}: {taker} does not take this; leave one of them out")


def _material(name: str, properties: Mapping[str, float | None]) -> Material:
    """The material of a name, with the properties that are given instead of its own."""
    known = MATERIALS.get(name)
    values = {key: getattr(known, key, None) if value is None else value for key, value in properties.items()}
    missing = [key for key, value in values.items() if value is None]
    if missing:
        raise ValueError(
            f"material: {name!r} is none of the known ones ({', '.join(MATERIALS)}); give its {', '.join(missing)}"
        )
    return Material(**{key: value for key, value in values.items() if value is not None})


def failure_criterion(name: str, friction: float | None = None) -> Criterion:
    """The criterion of a name, of a coefficient of friction if it takes one."""
    one_of("criterion", CRITERIA, name)
    return _made(CRITERIA[name], friction=friction or 0.0)


def refuse_unbreakable(criterion: str, material: str, law: ContactLaw) -> None:
    """Refuse a criterion that no contact of a law can meet, by the example of two spheres.

    Raises
    ------
    ValueError
        With the names of criterion and material, and what to add.
    """
    chosen = failure_criterion(criterion)
    if not len(limited_parts(law.bonds(straight_chain(2)), chosen)):
        missing = dict.fromkeys(LIMITED_BY.get(strength, strength) for strength in chosen.strengths)
        raise ValueError(
            f"criterion: {criterion!r} never fails {material!r}, whose contacts have no limit for it; "
            f"add {' or '.join(missing)}"
        )


def _made(kind: Callable[..., Made], **values: Any) -> Made:
    """One of a kind, made from those of the values that it takes."""
    taken = signature(kind).parameters
    return kind(**{name: value for name, value in values.items() if name in taken})
