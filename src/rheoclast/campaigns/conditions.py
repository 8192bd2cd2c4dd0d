"""What all aggregates of a campaign meet: liquid, flows or histories, materials, and what is asked of them."""

from __future__ import annotations

from typing import Annotated, Literal, get_args

import msgspec
from msgspec import Meta, Struct

from rheoclast import _checks
from rheoclast.breakup.crack import Rule
from rheoclast.campaigns.choices import COUNTING, refuse_repeated
from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.histories import Histories
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.material import MATERIALS
from rheoclast.names import (
    CRITERIA,
    FLOWS,
    contact_law,
    failure_criterion,
    hydrodynamic_model,
    one_of,
    refuse_unbreakable,
)

Row = tuple[float, float, float]


class Orientations(Struct, frozen=True, forbid_unknown_fields=True):
    """A number of orientations of every aggregate, uniform over all rotations, different for every aggregate."""

    number: COUNTING


class NamedGradient(Struct, frozen=True, forbid_unknown_fields=True):
    """A flow by its velocity gradient (3, 3) in 1/s, and what it is called in the results."""

    name: str
    gradient: tuple[Row, Row, Row]

    def __post_init__(self) -> None:
        if LinearFlow(self.gradient).magnitude == 0:
            raise ValueError("gradient: expected a strain rate that is not zero; a rotation loads no contact")


class Hydrodynamics(Struct, frozen=True, forbid_unknown_fields=True):
    """A hydrodynamic model with its multipole order, or "auto" with the largest error of the loads as a share."""

    model: str = "stokesian"
    order: int | Literal["auto"] = 2
    accuracy: float = 0.02

    def __post_init__(self) -> None:
        self.chosen()

    def chosen(self) -> HydrodynamicModel:
        """The model."""
        return hydrodynamic_model(self.model, self.order, self.accuracy)


class ContactMaterial(Struct, frozen=True, forbid_unknown_fields=True):
    """Contacts of a material, known by its name or by its properties: the arguments of `names.contact_law`."""

    name: str
    youngs_modulus: float | None = None
    poisson_ratio: float | None = None
    work_of_adhesion: float | None = None
    law: str = "jkr"
    pull_off: float | None = None
    stiffness: tuple[float, float, float, float] | None = None
    friction: float | None = None
    rolling_distance: float | None = None

    def __post_init__(self) -> None:
        self.contact_law()

    def contact_law(self) -> ContactLaw:
        """The contact law."""
        properties = msgspec.structs.asdict(self)
        return contact_law(properties.pop("name"), **properties)


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

    @property
    def draws_orientations(self) -> bool:
        """Whether something of an aggregate's orientation is random: all but the worst."""
        return self.histories is not None or isinstance(self.orientations, Orientations)

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
        for position, each in enumerate(self.materials):
            if isinstance(each, str) and each not in MATERIALS:
                known = ", ".join(MATERIALS)
                raise ValueError(
                    f"materials[{position}]: expected {known}, or a table {{ name = …, youngs_modulus = …, "
                    f"poisson_ratio = …, work_of_adhesion = … }}, got {each!r}"
                )
        return tuple(ContactMaterial(each) if isinstance(each, str) else each for each in self.materials)

    def failure_criterion(self, material: ContactMaterial) -> Criterion:
        """The criterion, with the friction of a material."""
        return failure_criterion(self.criterion, material.friction)

    def _flow(self, given: str | NamedGradient) -> tuple[str, LinearFlow]:
        if isinstance(given, NamedGradient):
            return given.name, LinearFlow(given.gradient)
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
        """Refuse a criterion that no contact of some material can meet."""
        for material in self.contact_materials:
            refuse_unbreakable(self.criterion, material.name, material.contact_law())
