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
        for name in ("normals", "force", "moment"):
            array = getattr(self, name)
            object.__setattr__(self, name, _checks.real_array(name, array, array.shape))

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


def contact_response(aggregate: Aggregate, response: RigidResponse, bonds: Bonds | None = None) -> ContactResponse:
    """Solve the structure for the five strain components.

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
    """
    refuse_other_spheres(aggregate.spheres, response)
    unit = [each.strain_loads for each in response.by_order]
    batch = SphereLoads(
        np.stack([each.force for each in unit]),
        np.stack([each.torque for each in unit]),
        max(each.rounding for each in unit),
    )
    carried = contact_loads(aggregate, batch, bonds)
    table = None
    for each, force, moment in zip(response.by_order, carried.force, carried.moment, strict=True):
        table = ContactResponse(
            carried.normals, force.transpose(1, 2, 0), moment.transpose(1, 2, 0), each.order, coarser=table
        )
    assert table is not None
    return table
