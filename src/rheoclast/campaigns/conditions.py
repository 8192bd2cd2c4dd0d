"""What all aggregates of a campaign meet: liquid, flows or histories, materials, and what is asked of them."""

from __future__ import annotations

from typing import Annotated, Literal, get_args

from msgspec import Meta, Struct

from rheoclast import _checks
from rheoclast.breakup.crack import Rule
from rheoclast.campaigns.choices import COUNTING, one_of, refuse_repeated
from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.histories import Histories
from rheoclast.flows import LinearFlow
from rheoclast.generation.chains import straight_chain
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import refuse_without_strength
from rheoclast.mechanics.laws.jkr import JKR
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.laws.measured_pull_off import MeasuredPullOff
from rheoclast.mechanics.laws.uniform import Uniform
from rheoclast.mechanics.material import MATERIALS, Material
from rheoclast.names import CRITERIA, FLOWS, MODELS

Row = tuple[float, float, float]


class Orientations(Struct, frozen=True, forbid_unknown_fields=True):
    """A number of orientations of every aggregate, uniform over all rotations, different for every aggregate."""

    number: COUNTING


class NamedGradient(Struct, frozen=True, forbid_unknown_fields=True):
    """A flow by its velocity gradient (3, 3) in 1/s, and what it is called in the results."""

    name: str
    gradient: tuple[Row, Row, Row]

    def __post_init__(self) -> None:
        if LinearFlow(self.gradient).magnitude == 0:  # type: ignore[arg-type]
            raise ValueError("gradient: expected a strain rate that is not zero; a rotation loads no contact")


class Hydrodynamics(Struct, frozen=True, forbid_unknown_fields=True):
    """A hydrodynamic model with its multipole order, or "auto" with the largest error of the loads as a share."""

    model: str = "stokesian"
    order: int | Literal["auto"] = 2
    accuracy: float = 0.02

    def __post_init__(self) -> None:
        one_of("model", MODELS, self.model)
        self.chosen()

    def chosen(self) -> HydrodynamicModel:
        """The model."""
        return MODELS[self.model](self.order, self.accuracy)


class ContactMaterial(Struct, frozen=True, forbid_unknown_fields=True):
    """Contacts of a material: JKR's, with the pull-off force of JKR or as measured, or of explicit stiffness.

    Moduli in Pa, work of adhesion in J/m², pull-off force in N, rolling distance in m; stiffness normal and tangential
    in N/m, bending and twisting in N m/rad. What is not given is that of the material of the same name.
    """

    name: str
    youngs_modulus: float | None = None
    poisson_ratio: float | None = None
    work_of_adhesion: float | None = None
    pull_off: float | None = None
    stiffness: tuple[float, float, float, float] | None = None
    friction: float | None = None
    rolling_distance: float | None = None

    def __post_init__(self) -> None:
        self.law()

    def law(self) -> ContactLaw:
        """The contact law."""
        if self.stiffness is None:
            law = JKR(self._material(), self.friction, self.rolling_distance)
            return law if self.pull_off is None else MeasuredPullOff(self.pull_off, law)
        if self.pull_off is None:
            raise ValueError("stiffness: explicit stiffness needs the strength too; add pull_off")
        if self.friction is not None or self.rolling_distance is not None:
            raise ValueError("friction, rolling_distance: explicit stiffness has no law for them; leave one out")
        return Uniform(*self.stiffness, tensile_strength=self.pull_off)

    def _material(self) -> Material:
        known = MATERIALS.get(self.name)
        properties: dict[str, float] = {}
        for name in ("youngs_modulus", "poisson_ratio", "work_of_adhesion"):
            value = getattr(known, name, None) if getattr(self, name) is None else getattr(self, name)
            if value is None:
                raise ValueError(
                    f"{name}: {self.name!r} is none of the known materials ({', '.join(MATERIALS)}); give its {name}"
                )
            properties[name] = value
        return Material(**properties)


class Conditions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What every aggregate of a campaign meets.

    Attributes
    ----------
    event
        "first failure": the contact that fails first in every flow and orientation. "breakup": all failures up to the
        split, and the fragments. "history": the contact that fails first along every history, and the fragments.
    viscosity
        Of the liquid, Pa s.
    radius
        Of the spheres in m, the median where they are unequal, for families that are given none.
    hydrodynamics
        The model.
    flows
        Names of flows, or gradients; not for "history".
    orientations
        "worst" for tension in every flow, or a number of random ones; not for "history".
    histories
        For "history" only.
    materials
        Of the contacts: names of known materials, or their properties.
    criterion
        When a contact fails.
    rule
        For fragments: contacts fail one at a time, "weakest", or all that are "overloaded" at once.
    up_to
        For "breakup" only: rate of the flow, 1/s, above which it is not raised.
    """

    event: str = "first failure"
    viscosity: float
    radius: float
    hydrodynamics: Hydrodynamics = Hydrodynamics()
    flows: Annotated[tuple[str | NamedGradient, ...], Meta(min_length=1)] | None = None
    orientations: str | Orientations | None = None
    histories: Histories | None = None
    materials: Annotated[tuple[str | ContactMaterial, ...], Meta(min_length=1)]
    criterion: str = "every-limit"
    rule: str = "weakest"
    up_to: float | None = None

    def __post_init__(self) -> None:
        for name in ("viscosity", "radius"):
            _checks.positive(name, getattr(self, name))
        if self.up_to is not None:
            _checks.positive("up_to", self.up_to)
        one_of("event", EVENTS, self.event)
        if self.up_to is not None and self.event != "breakup":
            raise ValueError(f"up_to: only event 'breakup' raises the flow, got {self.event!r}; remove up_to")
        self._refuse_what_others_meet()
        one_of("rule", get_args(Rule), self.rule)
        one_of("criterion", CRITERIA, self.criterion)
        if isinstance(self.orientations, str) and self.orientations != "worst":
            raise ValueError(f"orientations: expected 'worst' or {{ number = … }}, got {self.orientations!r}")
        refuse_repeated("flows", (self._flow(each)[0] for each in self.flows or ()))
        refuse_repeated("materials", (each.name for each in self.contact_materials))
        self._refuse_unbreakable()

    @property
    def linear_flows(self) -> dict[str, LinearFlow]:
        """The flows by their names; those known by name at a rate of 1/s."""
        return dict(self._flow(each) for each in self.flows or ())

    @property
    def contact_materials(self) -> tuple[ContactMaterial, ...]:
        """The materials of the contacts."""
        return tuple(ContactMaterial(each) if isinstance(each, str) else each for each in self.materials)

    def failure_criterion(self, material: ContactMaterial) -> Criterion:
        """The criterion, with the friction of a material."""
        return CRITERIA[self.criterion](material.friction or 0.0)

    def _flow(self, given: str | NamedGradient) -> tuple[str, LinearFlow]:
        if isinstance(given, NamedGradient):
            return given.name, LinearFlow(given.gradient)  # type: ignore[arg-type]
        one_of("flows", FLOWS, given)
        return given, FLOWS[given](1.0)

    def _refuse_what_others_meet(self) -> None:
        """Refuse a campaign that does not say what its event needs, or says what only other events need."""
        needed = EVENTS[self.event].needs
        for key in needed:
            if getattr(self, key) is None:
                raise ValueError(f"{key}: expected with event {self.event!r}, got none; add it")
        for key in {key: None for event in EVENTS.values() for key in event.needs if key not in needed}:
            if getattr(self, key) is not None:
                raise ValueError(f"{key}: event {self.event!r} takes {' and '.join(needed)} instead; remove {key}")

    def _refuse_unbreakable(self) -> None:
        """Refuse a criterion that no contact of some material can meet, by the example of two spheres."""
        pair = straight_chain(2, self.radius)
        for material in self.contact_materials:
            try:
                refuse_without_strength(material.law().bonds(pair), self.failure_criterion(material))
            except ValueError as error:
                raise ValueError(f"criterion: {self.criterion!r} never fails {material.name!r}: {error}") from None
