"""The mobility operator without its matrix: near pairs by themselves, the rest through an octree."""

from __future__ import annotations

from dataclasses import dataclass

from rheoclast._checks import FloatArray
from rheoclast.stokes.basis import HIGHEST_CLOSED_ORDER, MultipoleBasis
from rheoclast.stokes.far_field import FarField, arithmetic, far_field
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.near_field import NearField, near_field

FEWEST_IN_OCTREE = 3_000
"""Spheres from which on the octree pays at orders 1 and 2, whose direct sums are fast."""
FEWEST_IN_OCTREE_OF_BLOCKS = 300
"""The same for orders whose blocks are stored."""


@dataclass(frozen=True, eq=False)
class FastMobility:
    """Applies the mobility; made by `fast_mobility`.

    Attributes
    ----------
    mobility
        The operator.
    near
        Sum over near pairs.
    far
        Sum over the others; none where all pairs are near.
    accuracy
        Of the far field.
    """

    mobility: Mobility
    near: NearField
    far: FarField | None
    accuracy: float

    def __matmul__(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) from tractions (N, M, K)."""
        mobility = self.mobility
        velocities = mobility.basis.self_mobility[:, None] / mobility.radii[:, None, None] * tractions
        velocities += self.near.apply(tractions)
        return velocities if self.far is None else velocities + self.far.apply(tractions)

    def lowered(self) -> FastMobility:
        """The operator of the next lower order, which acts on the first modes of this one."""
        mobility, basis = self.mobility, MultipoleBasis(self.mobility.basis.order - 1)
        lower = Mobility(mobility.centers, mobility.radii, basis)
        far = self.far.lowered(basis) if self.far is not None and _octree_pays(lower) else None
        return _with_far_field(lower, far, self.accuracy)


def fast_mobility(mobility: Mobility, accuracy: float) -> FastMobility:
    """The operator of any order, its far field to an accuracy as `far_field` defines it."""
    spheres = mobility.centers, mobility.radii, mobility.basis
    return _with_far_field(mobility, far_field(*spheres, accuracy) if _octree_pays(mobility) else None, accuracy)


def _octree_pays(mobility: Mobility) -> bool:
    closed = mobility.basis.order <= HIGHEST_CLOSED_ORDER
    return len(mobility.radii) >= (FEWEST_IN_OCTREE if closed else FEWEST_IN_OCTREE_OF_BLOCKS)


def _with_far_field(mobility: Mobility, far: FarField | None, accuracy: float) -> FastMobility:
    tree = None if far is None else far.tree
    near = near_field(mobility.centers, mobility.radii, mobility.basis, tree, arithmetic(accuracy))
    return FastMobility(mobility, near, far, accuracy)
