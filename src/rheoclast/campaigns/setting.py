"""An aggregate with its bonds, and what it meets: flows in several orientations, or histories of the flow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.crack import Rule
from rheoclast.breakup.initiation import worst_initiation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.hydrodynamics.trajectory import Trajectory
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import depth, radial_position


@dataclass(frozen=True, eq=False)
class Setting:
    """An aggregate, the liquid's action on it, its bonds, and when they fail."""

    aggregate: Aggregate
    response: RigidResponse
    bonds: Bonds
    criterion: Criterion
    rule: Rule

    @cached_property
    def table(self) -> ContactResponse:
        """Contact loads in every flow."""
        return contact_response(self.aggregate, self.response, self.bonds)

    @cached_property
    def places(self) -> FloatArray:
        """Radial position and depth (2, C) of the contacts."""
        points = self.aggregate.contact_points
        return np.array([place(self.aggregate, points) for place in (radial_position, depth)])


@dataclass(frozen=True, eq=False)
class Flows:
    """Flows that an aggregate meets.

    Attributes
    ----------
    named
        By their names.
    rotations
        (n, 3, 3) by which every flow is turned; None for the worst orientation for tension in each flow.
    up_to
        Rate of the flow, 1/s, above which it is not raised.
    """

    named: Mapping[str, LinearFlow]
    rotations: FloatArray | None
    up_to: float

    def turns(self, flow: LinearFlow, setting: Setting) -> FloatArray:
        """Rotations (n, 3, 3) by which an aggregate meets a flow turned."""
        if self.rotations is not None:
            return self.rotations
        return worst_initiation(setting.table, setting.bonds, flow).rotation[None]


@dataclass(frozen=True, eq=False)
class Orbits:
    """Paths along which an aggregate is carried.

    Attributes
    ----------
    numbered
        How it turns along each, by the number of the history, in units of the Kolmogorov time: a creeping flow that is
        faster turns it along the same orbit.
    kolmogorov_times
        In s, by the dissipation in m²/s³ that the orbits stand for.
    fragments
        Whether to follow cracks to the fragments.
    """

    numbered: Mapping[int, Trajectory]
    kolmogorov_times: Mapping[float, float]
    fragments: bool = True
