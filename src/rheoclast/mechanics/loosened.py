"""Contact loads while contacts are lost one after the other, under loads that stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rheoclast._checks import IntArray
from rheoclast.frames.removal import LoadedFrame, removable_frame
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import (
    ContactLoads,
    check_loads,
    dimensionless_cases,
    dimensionless_geometry,
    dimensionless_stiffness,
)
from rheoclast.particles.aggregate import Aggregate


@dataclass(frozen=True, eq=False)
class LoosenedAggregate:
    """An aggregate some of whose contacts are lost, under one case of loads. Made by `loosened` and `without`.

    Attributes
    ----------
    aggregate
        Spheres and all contacts, those lost among them.
    loads
        Loads (C,) of the contacts; zero where the contact is lost.
    """

    aggregate: Aggregate
    loads: ContactLoads
    _state: LoadedFrame
    _size: float

    @property
    def lost(self) -> IntArray:
        """Contacts that are lost, in their order."""
        return self._state.removed

    @property
    def residual(self) -> float:
        """Largest force or torque left unbalanced on a sphere, over the largest load."""
        return self._state.residual

    def without(self, contacts: int | Sequence[int] | IntArray) -> LoosenedAggregate:
        """The same after one contact more, or several at once, are lost.

        Raises
        ------
        CollapseError
            If the aggregate falls into parts; the error carries them.
        """
        return _loosened(self.aggregate, self._state.without(contacts), self._size)


def loosened(aggregate: Aggregate, loads: SphereLoads, bonds: Bonds) -> LoosenedAggregate:
    """The aggregate with all its contacts, ready to lose some.

    Parameters
    ----------
    aggregate
        Spheres and contacts.
    loads
        Force and torque (N, 3) of the fluid on every sphere, in balance.
    bonds
        Stiffness of the contacts, which decides how the load is shared anew.

    Raises
    ------
    ValueError
        As `contact_loads`.
    """
    check_loads(aggregate, loads)
    cases, size = dimensionless_cases(loads, float(aggregate.spheres.radii.mean()))
    frame = removable_frame(*dimensionless_geometry(aggregate), dimensionless_stiffness(aggregate, bonds))
    return _loosened(aggregate, frame.loaded(cases), float(size[0]))


def _loosened(aggregate: Aggregate, state: LoadedFrame, size: float) -> LoosenedAggregate:
    carried, length = state.joint_loads[:, :, 0], float(aggregate.spheres.radii.mean())
    loads = ContactLoads(aggregate.normals, size * carried[:, :3], size * length * carried[:, 3:])
    return LoosenedAggregate(aggregate, loads, state, size)
