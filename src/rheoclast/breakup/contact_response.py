"""The linear map from flow to contact loads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse, refuse_other_spheres
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads, contact_loads
from rheoclast.particles.aggregate import Aggregate
from rheoclast.vectors import strain_components, strain_tensor


@dataclass(frozen=True, eq=False)
class ContactResponse:
    """Contact loads of a freely suspended aggregate, for every linear flow at once. Made by `contact_response`.

    Attributes
    ----------
    normals
        (C, 3) unit vectors from sphere i to sphere j of each contact.
    force, moment
        (C, 3, 5) per component of the strain rate on `STRAIN_BASIS`, in N s and N m s; signs as in `ContactLoads`.
    order
        Multipole order of the hydrodynamics; None if the model has none.
    coarser
        The same at the next lower order, where there is one.
    """

    normals: FloatArray
    force: FloatArray
    moment: FloatArray
    order: int | None = None
    coarser: ContactResponse | None = None

    def __post_init__(self) -> None:
        normals = _checks.real_array("normals", self.normals, ("C", 3))
        force, moment = (
            _checks.real_array(name, getattr(self, name), (len(normals), 3, 5)) for name in ("force", "moment")
        )
        _checks.set_fields(self, normals=normals, force=force, moment=moment)

    @property
    def by_order(self) -> tuple[ContactResponse, ...]:
        """The same at all orders that were solved, the lowest first and this one last."""
        return (*(self.coarser.by_order if self.coarser else ()), self)

    @property
    def map(self) -> FloatArray:
        """Force and moment (C, 6, 5) per component of the strain rate."""
        return np.concatenate([self.force, self.moment], axis=1)

    @property
    def tension(self) -> FloatArray:
        """Symmetric traceless tensors A (C, 3, 3) in N s: the tension of a contact is A : E."""
        return strain_tensor(np.einsum("ci,cik->ck", self.normals, self.force))

    def loads(self, flow: LinearFlow) -> ContactLoads:
        """Contact loads in a flow."""
        return self.loads_of(strain_components(flow.strain_rate))

    def loads_of(self, components: FloatArray) -> ContactLoads:
        """Contact loads (..., C) for strain rates with components (..., 5) on `STRAIN_BASIS`, in 1/s."""
        force, moment = (np.tensordot(components, part, axes=(-1, 2)) for part in (self.force, self.moment))
        return ContactLoads(self.normals, force, moment)

    def worst_tension(self, flow: LinearFlow) -> FloatArray:
        """Largest tension (C,) in N of every contact over all orientations of the aggregate in the flow.

        By von Neumann's trace inequality it is Σ λ_k e_k, the eigenvalues of A and of the strain rate both sorted.
        """
        return np.linalg.eigvalsh(self.tension)[:, ::-1] @ flow.principal_rates

    def worst_orientation(self, flow: LinearFlow) -> FloatArray:
        """Rotations R (C, 3, 3) of the flow for which each contact's tension is its largest.

        ``loads(flow.rotated(R[c])).tension[c]`` equals ``worst_tension(flow)[c]``; the aggregate itself would be turned
        by the transpose.
        """
        own = np.linalg.eigh(self.tension)[1]
        principal = np.linalg.eigh(flow.strain_rate)[1]
        rotation = own @ principal.T
        own[np.linalg.det(rotation) < 0, :, 0] *= -1
        return own @ principal.T


@_checks.instances
def contact_response(aggregate: Aggregate, response: RigidResponse, bonds: Bonds | None = None) -> ContactResponse:
    """Contact loads of an aggregate in every linear flow: the structure solved for the five strain components.

    Parameters
    ----------
    aggregate
        Spheres and contacts.
    response
        Hydrodynamic response of the same spheres.
    bonds
        Stiffness of the contacts; a tree does not need it.

    Raises
    ------
    GeometryError
        If the response belongs to other spheres.
    ValueError
        As `contact_loads`.
    TypeError
        If an argument is something else.
    """
    refuse_other_spheres(aggregate.spheres, response)
    unit = SphereLoads.stacked([each.strain_loads for each in response.by_order])
    carried = contact_loads(aggregate, unit, bonds)
    force, moment = (np.moveaxis(part, 1, -1) for part in (carried.force, carried.moment))
    table = None
    for k, each in enumerate(response.by_order[:-1]):
        table = ContactResponse(carried.normals, force[k], moment[k], each.order, table)
    return ContactResponse(carried.normals, force[-1], moment[-1], response.order, table)


def refuse_without_strain(flow: LinearFlow) -> None:
    """Refuse a flow that loads no contact, at whatever rate."""
    if not flow.magnitude > 0:
        raise ValueError("flow: expected a strain rate that is not zero, got none; a rotation loads no contact")
