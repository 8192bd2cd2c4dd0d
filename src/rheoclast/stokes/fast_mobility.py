"""The mobility operator of orders 1 and 2 without its matrix."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.stokes.direct_sum import force_velocities, pair_velocities
from rheoclast.stokes.far_field import FarField
from rheoclast.stokes.mobility import Mobility
from rheoclast.vectors import STRAIN_BASIS

ENTRIES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2))
"""The five entries that give a symmetric traceless tensor."""


@dataclass(frozen=True, eq=False)
class FastMobility:
    """Applies the mobility of order 1 or 2: compiled direct sums over near pairs, an octree for the rest.

    Parameters
    ----------
    mobility
        The operator.
    far
        Far field of the same spheres. Without it all pairs are summed directly.
    """

    mobility: Mobility
    far: FarField | None = None

    def __call__(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) from tractions (N, M, K)."""
        mobility, order = self.mobility, self._order
        loads = np.ascontiguousarray((self._scale * (self._to_loads @ tractions[order])).transpose(2, 1, 0))
        motion = np.zeros_like(loads)
        sums = force_velocities if mobility.basis.order == 1 else pair_velocities
        sums(*self._sorted_spheres, loads, *self._ranges, motion)
        velocities = np.empty_like(tractions)
        velocities[order] = self._from_motion @ (self._scale * motion.transpose(2, 1, 0))
        velocities += mobility.basis.self_mobility[:, None] / mobility.radii[:, None, None] * tractions
        return velocities if self.far is None else velocities + self.far.apply(tractions)

    @cached_property
    def _order(self) -> IntArray:
        """Spheres in an order that makes those of a leaf contiguous."""
        return np.arange(len(self.mobility.radii)) if self.far is None else self.far.tree.order

    @cached_property
    def _sorted_spheres(self) -> tuple[FloatArray, FloatArray]:
        """Centres (3, N) and radii (N,)."""
        mobility, order = self.mobility, self._order
        return np.ascontiguousarray(mobility.centers[order].T), mobility.radii[order]

    @cached_property
    def _ranges(self) -> tuple[IntArray, IntArray, IntArray]:
        """Group (N,) of every sphere, first range (G + 1,) of every group, ranges (R, 2) of spheres near to it."""
        count = len(self.mobility.radii)
        if self.far is None:
            return np.zeros(count, np.intp), np.array([0, 1]), np.array([[0, count]])
        leaf_starts = self.far.tree.leaf_starts
        starts, leaves = self.far.tree.neighbours
        group = np.repeat(np.arange(len(leaf_starts) - 1), np.diff(leaf_starts))
        return group, starts, np.stack([leaf_starts[leaves], leaf_starts[leaves + 1]], axis=1)

    @cached_property
    def _scale(self) -> FloatArray:
        """Arm (N, 3 or 11, 1) of each component: one for force and velocity, the radius for the others."""
        rows = len(self._to_loads)
        scale = np.ones((len(self.mobility.radii), rows, 1))
        scale[:, 3:] = self.mobility.radii[self._order, None, None]
        return scale

    @cached_property
    def _to_loads(self) -> FloatArray:
        """Force, torque and entries of the stresslet (11, M) from the modes of a unit sphere."""
        moments = self.mobility.basis.elementary_projections
        if self.mobility.basis.order == 1:
            return moments[:3]
        entries = np.array([[basis[entry] for basis in STRAIN_BASIS] for entry in ENTRIES])
        return np.vstack([moments[:6], entries @ moments[6:]])

    @cached_property
    def _from_motion(self) -> FloatArray:
        """Modes (M, 11) from 8π times velocity, angular velocity and entries of the strain rate of a unit sphere."""
        projections = self.mobility.basis.elementary_projections / (8 * np.pi)
        if self.mobility.basis.order == 1:
            return projections[:3].T
        components = np.array([[_weight(basis, *entry) for entry in ENTRIES] for basis in STRAIN_BASIS])
        return np.hstack([projections[:6].T, projections[6:].T @ components])


def _weight(basis: FloatArray, row: int, column: int) -> float:
    """How an entry of a symmetric traceless tensor counts in its contraction with a basis tensor."""
    return float(basis[row, column] - basis[2, 2] if row == column else 2 * basis[row, column])
