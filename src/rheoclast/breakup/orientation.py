"""The orientation in which an aggregate is broken, where it is not given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Literal

from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.breakup.initiation import Initiation, worst_initiation
from rheoclast.breakup.orbit import orbit_initiation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion

Sought = Literal["worst", "orbit"]


def _worst(
    response: RigidResponse, table: ContactResponse, bonds: Bonds, flow: LinearFlow, criterion: Criterion
) -> Initiation:
    return worst_initiation(table, bonds, flow)


def _along_orbit(
    response: RigidResponse, table: ContactResponse, bonds: Bonds, flow: LinearFlow, criterion: Criterion
) -> Initiation:
    return orbit_initiation(response, table, bonds, flow, criterion=criterion)


SOUGHT: Mapping[Sought, Callable[[RigidResponse, ContactResponse, Bonds, LinearFlow, Criterion], Initiation]] = (
    MappingProxyType({"worst": _worst, "orbit": _along_orbit})
)
"""First failures in the worst orientation for tension, and in the worst along the free rotation."""
