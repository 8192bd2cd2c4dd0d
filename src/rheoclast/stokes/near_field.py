"""Velocities that spheres raise on spheres near to them: all pairs, or those in neighbouring leaves of an octree."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any, final

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.stokes.basis import HIGHEST_CLOSED_ORDER, MultipoleBasis
from rheoclast.stokes.block_rows import BlockRows
from rheoclast.stokes.direct_sum import force_velocities, pair_velocities
from rheoclast.stokes.octree import Octree
from rheoclast.stokes.pair_blocks import PairCoefficients
from rheoclast.stokes.pair_kernels import block_rows
from rheoclast.stokes.solver import refuse_beyond_memory
from rheoclast.vectors import STRAIN_BASIS

PAIR_COST = {1: 20.0, 2: 100.0}
"""Time of a pair and right-hand side in closed form, over that of a multiplication and addition in a matrix product."""
BLOCK_COST = 1.5
"""The same for every number of a stored block."""

ENTRIES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2))
"""The five entries that give a symmetric traceless tensor."""


class NearField(ABC):
    """Sum over near pairs, a sphere's own velocity left out."""

    @abstractmethod
    def apply(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) from tractions (N, M, K)."""


def pair_cost(basis: MultipoleBasis) -> float:
    """Time of a near pair and right-hand side, in operations of a matrix product."""
    return PAIR_COST[basis.order] if basis.order <= HIGHEST_CLOSED_ORDER else BLOCK_COST * basis.size**2


def near_field(
    centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, tree: Octree | None, dtype: type[np.floating[Any]]
) -> NearField:
    """The faster of the two near fields.

    Parameters
    ----------
    centers, radii, basis
        Spheres and modes, as for `Mobility`.
    tree
        Octree of the spheres; without it all pairs are near.
    dtype
        Precision of blocks that are stored.
    """
    if basis.order <= HIGHEST_CLOSED_ORDER:
        return ClosedForm(centers, radii, basis, tree)
    return StoredBlocks(_near_blocks(centers, radii, basis, tree, dtype))


@final
@dataclass(frozen=True, eq=False)
class ClosedForm(NearField):
    """Orders 1 and 2 by compiled sums that compute every pair anew: memory N."""

    centers: FloatArray
    radii: FloatArray
    basis: MultipoleBasis
    tree: Octree | None

    def apply(self, tractions: FloatArray) -> FloatArray:
        """See `NearField`."""
        order = slice(None) if self.tree is None else self.tree.order
        loads = np.ascontiguousarray((self._scale * (self._to_loads @ tractions[order])).transpose(2, 1, 0))
        motion = np.zeros_like(loads)
        sums = force_velocities if self.basis.order == 1 else pair_velocities
        sums(*self._sorted_spheres, loads, *self._ranges, motion)
        velocities = np.empty_like(tractions)
        velocities[order] = self._from_motion @ (self._scale * motion.transpose(2, 1, 0))
        return velocities

    @cached_property
    def _sorted_spheres(self) -> tuple[FloatArray, FloatArray]:
        """Centres (3, N) and radii (N,), those of a leaf one after another."""
        order = slice(None) if self.tree is None else self.tree.order
        return np.ascontiguousarray(self.centers[order].T), self.radii[order]

    @cached_property
    def _ranges(self) -> tuple[IntArray, IntArray, IntArray]:
        """Group (N,) of every sphere, first range (G + 1,) of every group, ranges (R, 2) of spheres near to it."""
        count = len(self.radii)
        if self.tree is None:
            return np.zeros(count, np.intp), np.array([0, 1]), np.array([[0, count]])
        leaf_starts = self.tree.leaf_starts
        starts, leaves = self.tree.neighbours
        group = np.repeat(np.arange(len(leaf_starts) - 1), np.diff(leaf_starts))
        return group, starts, np.stack([leaf_starts[leaves], leaf_starts[leaves + 1]], axis=1)

    @cached_property
    def _scale(self) -> FloatArray:
        """Arm (N, 3 or 11, 1) of each component: one for force and velocity, the radius for the others."""
        scale = np.ones((len(self.radii), len(self._to_loads), 1))
        scale[:, 3:] = self._sorted_spheres[1][:, None, None]
        return scale

    @cached_property
    def _to_loads(self) -> FloatArray:
        """Force, torque and entries of the stresslet (11, M) from the modes of a unit sphere."""
        moments = self.basis.elementary_projections
        if self.basis.order == 1:
            return moments[:3]
        entries = np.array([[basis[entry] for basis in STRAIN_BASIS] for entry in ENTRIES])
        return np.vstack([moments[:6], entries @ moments[6:]])

    @cached_property
    def _from_motion(self) -> FloatArray:
        """Modes (M, 11) from 8π times velocity, angular velocity and entries of the strain rate of a unit sphere."""
        projections = self.basis.elementary_projections / (8 * np.pi)
        if self.basis.order == 1:
            return projections[:3].T
        components = np.array([[_weight(basis, *entry) for entry in ENTRIES] for basis in STRAIN_BASIS])
        return np.hstack([projections[:6].T, projections[6:].T @ components])


@final
@dataclass(frozen=True, eq=False)
class StoredBlocks(NearField):
    """Any order by the blocks of all near pairs, computed once."""

    blocks: BlockRows

    def apply(self, tractions: FloatArray) -> FloatArray:
        """See `NearField`."""
        return self.blocks @ tractions


def _near_blocks(
    centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, tree: Octree | None, dtype: type[np.floating[Any]]
) -> BlockRows:
    count = len(radii)
    rows, columns = np.nonzero(~np.eye(count, dtype=bool)) if tree is None else tree.near_point_pairs()
    starts = np.searchsorted(rows, np.arange(count + 1))
    needed = len(rows) * basis.size**2 * np.dtype(dtype).itemsize
    refuse_beyond_memory(needed, count, basis.order)
    numbers = np.empty(len(rows) * basis.size**2, dtype)
    block_rows(centers, radii, PairCoefficients.of(basis).elements, basis.size, starts, columns, numbers)
    return BlockRows(starts, columns, numbers)


def _weight(basis: FloatArray, row: int, column: int) -> float:
    """How an entry of a symmetric traceless tensor counts in its contraction with a basis tensor."""
    return float(basis[row, column] - basis[2, 2] if row == column else 2 * basis[row, column])
