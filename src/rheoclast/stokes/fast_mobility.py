"""The mobility operator of orders 1 and 2 without its matrix."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.stokes.direct_sum import force_velocities, pair_velocities
from rheoclast.stokes.mobility import Mobility
from rheoclast.vectors import STRAIN_BASIS

ENTRIES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2))
"""The five entries that give a symmetric traceless tensor."""


@dataclass(frozen=True, eq=False)
class FastMobility:
    """Applies the mobility of order 1 or 2 by compiled direct sums over all pairs.

    Parameters
    ----------
    mobility
        The operator.
    """

    mobility: Mobility

    def __call__(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) from tractions (N, M, K)."""
        mobility, scale = self.mobility, self._scale
        loads = np.ascontiguousarray((scale * (self._to_loads @ tractions)).transpose(2, 1, 0))
        motion = np.zeros_like(loads)
        sums = force_velocities if mobility.basis.order == 1 else pair_velocities
        sums(self._centers, mobility.radii, loads, *self._ranges, motion)
        velocities = self._from_motion @ (scale * motion.transpose(2, 1, 0))
        velocities += mobility.basis.self_mobility[:, None] / mobility.radii[:, None, None] * tractions
        return velocities

    @cached_property
    def _centers(self) -> FloatArray:
        return np.ascontiguousarray(self.mobility.centers.T)

    @cached_property
    def _ranges(self) -> tuple[IntArray, IntArray, IntArray]:
        """All spheres are one group, and see one range: all spheres."""
        count = len(self.mobility.radii)
        return np.zeros(count, np.intp), np.array([0, 1]), np.array([[0, count]])

    @cached_property
    def _scale(self) -> FloatArray:
        """Arm (N, 3 or 11, 1) of each component: one for force and velocity, the radius for the others."""
        rows = len(self._to_loads)
        scale = np.ones((len(self.mobility.radii), rows, 1))
        scale[:, 3:] = self.mobility.radii[:, None, None]
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
