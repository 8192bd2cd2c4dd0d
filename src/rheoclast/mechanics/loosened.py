"""Contact loads while contacts are lost one after the other, under loads that stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.removable_tree import LoadedTree, RemovableTree
from rheoclast.frames.removal import CollapseError, LoadedFrame, RemovableFrame, removable_frame
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import (
    ContactLoads,
    check_loads,
    dimensional_loads,
    dimensionless_cases,
    dimensionless_geometry,
    dimensionless_stiffness,
    refuse_single_sphere,
)
from rheoclast.particles.aggregate import Aggregate


@dataclass(frozen=True, eq=False)
class LoosenableAggregate:
    """An aggregate with all its contacts, ready to be loaded and to lose some. Made by `loosenable`.

    Attributes
    ----------
    aggregate
        Spheres and contacts.
    """

    aggregate: Aggregate
    _frame: RemovableFrame | RemovableTree

    def loaded(self, loads: SphereLoads) -> LoosenedAggregate:
        """The aggregate under force and torque of the fluid on every sphere, (N, 3) or (..., N, 3), in balance.

        Raises
        ------
        ValueError
            As `contact_loads`.
        """
        check_loads(self.aggregate, loads)
        cases, size = dimensionless_cases(self.aggregate, loads)
        return _loosened(self.aggregate, self._frame.loaded(cases), size, loads.force.shape[:-2])


@dataclass(frozen=True, eq=False)
class LoosenedAggregate:
    """An aggregate some of whose contacts are lost, under loads. Made by `LoosenableAggregate.loaded` and `without`.

    Attributes
    ----------
    aggregate
        Spheres and all contacts, those lost among them.
    loads
        Loads (..., C) of the contacts; zero where the contact is lost.
    """

    aggregate: Aggregate
    loads: ContactLoads
    _state: LoadedFrame | LoadedTree
    _size: FloatArray

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
        batch = self.loads.force.shape[:-2]
        return _loosened(self.aggregate, self._state.without(contacts), self._size, batch)


def loosenable(aggregate: Aggregate, bonds: Bonds) -> LoosenableAggregate:
    """The aggregate with its contacts assembled and factorized, which all loads and losses share.

    Bonds give the stiffness, which decides how the load is shared anew. A tree is balanced without it.

    Raises
    ------
    ValueError
        If there is no contact, the bonds have another number of contacts, or do not hold the spheres.
    """
    refuse_single_sphere(aggregate)
    geometry, stiffness = dimensionless_geometry(aggregate), dimensionless_stiffness(aggregate, bonds)
    try:
        frame = RemovableTree(*geometry) if aggregate.is_tree else removable_frame(*geometry, stiffness)
    except CollapseError:
        raise ValueError(
            "bonds: expected contacts that hold the spheres, got some that turn or slide without resistance; "
            "bring bending, twisting and tangential stiffness closer to the normal one"
        ) from None
    return LoosenableAggregate(aggregate, frame)


def _loosened(
    aggregate: Aggregate, state: LoadedFrame | LoadedTree, size: FloatArray, batch: tuple[int, ...]
) -> LoosenedAggregate:
    return LoosenedAggregate(aggregate, dimensional_loads(aggregate, state.joint_loads, size, batch), state, size)
