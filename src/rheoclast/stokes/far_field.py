"""Velocities that spheres raise on spheres far away, in time linear in their number, for every multipole order.

The elements are those of `pair_blocks` to a requested accuracy, the sum running over an octree: tractions of the spheres
of a leaf become coefficients of the leaf, those of eight children coefficients of their parent, boxes act on the boxes that are
not their neighbours but their parents' neighbours' children, and velocities come down by the transposes. Near pairs, in
neighbouring leaves, are left to the caller.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.interpolation import BoxOperators, Precision, box_operators
from rheoclast.stokes.octree import Octree, Pairs, octree

PRECISIONS = {
    1e-3: Precision(5, 1e-3),
    1e-4: Precision(6, 1e-4),
    1e-5: Precision(7, 1e-5),
    1e-6: Precision(8, 1e-6),
    1e-7: Precision(9, 1e-7),
}
"""Measured: see tests/agreement/test_far_field.py."""

LEAF_SIDES = (4, 6, 8, 12, 16)  # in largest radii; few, because the operators of each are made once and kept
NEAR_COST = 4.0  # time of a near pair's floating-point operations over that of a matrix product's
PIECE = 4096  # spheres whose coefficients are made at a time


@dataclass(frozen=True, eq=False)
class FarField:
    """The far part of the mobility of N spheres: all ordered pairs that are not in neighbouring leaves.

    Attributes
    ----------
    tree
        Leaves, with the order that makes their spheres contiguous. Leaf b holds the spheres
        `tree.order[tree.leaf_starts[b] : tree.leaf_starts[b + 1]]`. With `starts, leaves = tree.neighbours`, the near pairs
        of these spheres are all those of `leaves[starts[b] : starts[b + 1]]`, b itself among them.
    operators
        Constant matrices between the coefficients of boxes.
    coefficients
        (N M, R) coefficients of unit tractions in their leaf, spheres in the order of the tree; in single precision,
        which costs accuracy of 1e-7 and no symmetry.
    interactions
        Pairs of boxes by offset.
    """

    tree: Octree
    operators: BoxOperators
    coefficients: NDArray[np.float32]
    interactions: tuple[Pairs, ...]

    @property
    def rank(self) -> int:
        """Coefficients of a box."""
        return self.operators.rank

    @property
    def levels(self) -> int:
        """Levels of boxes that interact; none for spheres that are all near."""
        return len(self.tree.levels)

    @property
    def memory(self) -> int:
        """Bytes held, without the constant operators."""
        return self.coefficients.nbytes + sum(2 * pairs.targets.nbytes for pairs in self.interactions)

    def apply(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) of all spheres from the tractions (N, M, K) of the spheres far from each."""
        if not self.levels:
            return np.zeros_like(tractions)
        count, modes, columns = tractions.shape
        sorted_tractions = tractions[self.tree.order].reshape(-1, columns)
        local = self._across(self._upward(sorted_tractions))
        velocities = np.empty((count, modes, columns))
        velocities[self.tree.order] = self._downward(local).reshape(count, modes, columns)
        return velocities

    def _upward(self, tractions: FloatArray) -> FloatArray:
        """Coefficients (B, K, R) of all boxes from tractions (N M, K)."""
        coefficients = np.zeros((self.tree.box_starts[-1], tractions.shape[1], self.rank))
        for box, rows in self._leaves():
            coefficients[box] = tractions[rows].T @ self.coefficients[rows].astype(np.float64)
        for level in reversed(self.tree.levels[1:]):
            for octant, children, parents in self.tree.families(level):
                coefficients[parents] += _times(coefficients[children], self.operators.transfers[octant])
        return coefficients

    def _across(self, sources: FloatArray) -> FloatArray:
        """Coefficients (B, K, R) of the velocities that the boxes' coefficients raise in the boxes they interact with."""
        targets = np.zeros_like(sources)
        for pairs in self.interactions:
            target, source = self.operators.factors(pairs.offset)
            targets[pairs.targets] += _times(_times(sources[pairs.sources], source), target.T)
            targets[pairs.sources] += _times(_times(sources[pairs.targets], target), source.T)
        targets /= 8 * np.pi * self.tree.box_sides[:, None, None]
        return targets

    def _downward(self, coefficients: FloatArray) -> FloatArray:
        """Velocities (N M, K) from the coefficients (B, K, R) of all boxes, which are changed."""
        for level in self.tree.levels[1:]:
            for octant, children, parents in self.tree.families(level):
                coefficients[children] += _times(coefficients[parents], self.operators.transfers[octant].T)
        velocities = np.empty((len(self.coefficients), coefficients.shape[1]))
        for box, rows in self._leaves():
            velocities[rows] = self.coefficients[rows].astype(np.float64) @ coefficients[box].T
        return velocities

    def _leaves(self) -> list[tuple[int, slice]]:
        """Number of each leaf among the boxes, and the rows of its spheres' modes."""
        ends = (self.tree.leaf_starts * self.operators.basis.size).tolist()
        first = self.tree.boxes(self.tree.depth).start
        return [(first + leaf, slice(*ends[leaf : leaf + 2])) for leaf in range(len(ends) - 1)]


def far_field(
    centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, accuracy: float, leaf_side: int | None = None
) -> FarField:
    """Far field of spheres (N, 3), (N,) to an accuracy.

    Parameters
    ----------
    accuracy
        Error of the far velocities in the 2-norm over their 2-norm, between 1e-7 and 1e-3.
    leaf_side
        Side of the leaves in largest radii, 4 or more; by default the fastest.
    """
    precision = _precision(accuracy)
    largest = float(radii.max())
    tree = octree(centers, largest * leaf_side) if leaf_side else _fastest(centers, largest, basis, precision)
    operators = box_operators(basis.order, tree.side / largest, precision)
    if not tree.levels:
        return FarField(tree, operators, np.empty((0, operators.rank), np.float32), ())
    interactions = tuple(pairs for pairs in tree.interactions() if len(pairs.targets))
    return FarField(tree, operators, _coefficients(tree, operators, centers, radii), interactions)


def _precision(accuracy: float) -> Precision:
    """The cheapest tabulated precision that reaches an accuracy."""
    enough = [tabulated for tabulated in PRECISIONS if tabulated <= accuracy * (1 + 1e-9)]
    if not enough:
        raise ValueError(f"accuracy: expected at least {min(PRECISIONS):g}, got {accuracy:g}")
    return PRECISIONS[max(enough)]


def _fastest(centers: FloatArray, largest: float, basis: MultipoleBasis, precision: Precision) -> Octree:
    """The octree of the leaf side that costs the fewest operations, near pairs included."""
    trees = [octree(centers, largest * side) for side in LEAF_SIDES]
    digits = -np.log10(precision.truncation)

    def cost(tree: Octree) -> float:
        rank = (3.1 * digits - 0.5) ** 2 * (1 + 2.2 * largest / tree.side)  # fitted to the ranks found
        across = tree.far_pairs() * 0.8 * rank**2
        return NEAR_COST * tree.near_pairs() * basis.size**2 + across + 2 * len(centers) * basis.size * rank

    return min(trees, key=cost)


def _coefficients(
    tree: Octree, operators: BoxOperators, centers: FloatArray, radii: FloatArray
) -> NDArray[np.float32]:
    """Coefficients (N M, R) of unit tractions in their leaf, spheres in the order of the tree."""
    boxes = np.repeat(tree.leaf_centers(), np.diff(tree.leaf_starts), axis=0)
    places, sizes = (centers[tree.order] - boxes) / tree.side, radii[tree.order] / tree.side
    coefficients = np.empty((len(radii), operators.basis.size, operators.rank), np.float32)
    for start in range(0, len(radii), PIECE):
        piece = slice(start, start + PIECE)
        coefficients[piece] = operators.coefficients(places[piece], sizes[piece])
    return coefficients.reshape(-1, operators.rank)


def _times(rows: FloatArray, matrix: FloatArray) -> FloatArray:
    """Rows (..., R) times a matrix as one matrix product."""
    return (rows.reshape(-1, rows.shape[-1]) @ matrix).reshape(*rows.shape[:-1], -1)
