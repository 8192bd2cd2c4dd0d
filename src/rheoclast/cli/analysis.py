"""What `rheoclast stress` computes, before anything is shown or written."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.initiation import Initiation, initiation, worst_initiation
from rheoclast.breakup.truncation import LoadErrors, truncation_error
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.response import RigidResponse, rigid_response
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.particles.aggregate import Aggregate
from rheoclast.progress import Progress


@dataclass(frozen=True, eq=False)
class Analysis:
    """One aggregate in one flow, in SI units."""

    aggregate: Aggregate
    flow: LinearFlow
    bonds: Bonds
    response: RigidResponse
    table: ContactResponse

    @cached_property
    def sphere_loads(self) -> SphereLoads:
        """Loads of the fluid on the spheres."""
        return self.response.loads(self.flow)

    @cached_property
    def contact_loads(self) -> ContactLoads:
        """Loads in the contacts."""
        return self.table.loads(self.flow)

    @cached_property
    def truncation(self) -> LoadErrors | None:
        """Expected errors of the contact loads; None where there is no lower order to compare with."""
        if self.table.coarser is None:
            return None
        return truncation_error(self.table, self.flow)

    @cached_property
    def given(self) -> Initiation:
        """First failure in the given orientation."""
        return initiation(self.table, self.bonds, self.flow)

    @cached_property
    def worst(self) -> Initiation:
        """First failure over all orientations."""
        return worst_initiation(self.table, self.bonds, self.flow)


def analyse(
    aggregate: Aggregate,
    flow: LinearFlow,
    model: HydrodynamicModel,
    viscosity: float,
    law: ContactLaw,
    progress: Progress | None = None,
) -> Analysis:
    """Solve fluid and structure of one aggregate."""
    bonds = law.bonds(aggregate)
    response = rigid_response(aggregate.spheres, model, viscosity, progress)
    return Analysis(aggregate, flow, bonds, response, contact_response(aggregate, response, bonds))
