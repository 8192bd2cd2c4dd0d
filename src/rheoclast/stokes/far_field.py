"""Velocities that spheres raise on spheres far away, in time linear in their number, for every multipole order.

The elements are those of `pair_blocks` to a requested accuracy, summed over an octree: tractions of the spheres of a
leaf become coefficients of the leaf, those of eight children coefficients of their parent; boxes act on the children of
their parents' neighbours that are not neighbours themselves, and velocities come down by the transposes. Near pairs, in
neighbouring leaves, are left to the caller.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
from numba import get_num_threads
from numpy.typing import NDArray

from rheoclast._checks import FloatArray
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.interpolation import BoxOperators, Offset, Precision, box_operators
from rheoclast.stokes.near_field import pair_cost
from rheoclast.stokes.octree import Octree, Pairs, octree

INTERPOLATION_ERROR = 1.0
TRUNCATION = 0.3
ACCURACIES = (1e-7, 1e-2)  # within which the rules of `_precision` were measured
SINGLE_PRECISION = 1e-5
"""Accuracy from which on 24-bit arithmetic, half the time and memory, adds a hundredth of the error."""
Floats = NDArray[np.floating[Any]]

LEAF_SIDES = (6, 8, 12, 16, 24)  # in largest radii; few, because the operators of each are made once and kept
SPHERE_PIECE = 2048  # spheres whose coefficients are made at a time
BOX_PIECE = 128  # pairs of boxes at a time, so that what is gathered stays in the cache


@dataclass(frozen=True, eq=False)
class FarField:
    """The far part of the mobility of N spheres: all ordered pairs that are not in neighbouring leaves.

    Attributes
    ----------
    tree
        Leaves, with the order that makes their spheres contiguous. Leaf b holds the spheres
        `tree.order[tree.leaf_starts[b] : tree.leaf_starts[b + 1]]`. With `starts, leaves = tree.neighbours`, near to
        these are all spheres of `leaves[starts[b] : starts[b + 1]]`, b itself among them.
    operators
        Constant matrices between the coefficients of boxes.
    coefficients
        (N M, R) coefficients of unit tractions in their leaf, spheres in the order of the tree. Their precision, single
        or double, is that of all that follows: the operator is symmetric to the rounding of one or the other.
    interactions
        Pairs of boxes by offset.
    """

    tree: Octree
    operators: BoxOperators
    coefficients: Floats
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

    def lowered(self, basis: MultipoleBasis) -> FarField:
        """The far field of a lower multipole order, whose modes are the first of this one's."""
        by_sphere = self.coefficients.reshape(len(self.tree.order), -1, self.rank)
        return replace(self, coefficients=by_sphere[:, : basis.size].reshape(-1, self.rank))

    def apply(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) of all spheres from the tractions (N, M, K) of the spheres far from each."""
        if not self.levels:
            return np.zeros_like(tractions)
        count, modes, columns = tractions.shape
        sorted_tractions = tractions[self.tree.order].reshape(-1, columns).astype(self.coefficients.dtype)
        local = self._across(self._upward(sorted_tractions))
        velocities = np.empty((count, modes, columns))
        velocities[self.tree.order] = self._downward(local).reshape(count, modes, columns)
        return velocities

    @cached_property
    def _transfers(self) -> Floats:
        return self.operators.transfers.astype(self.coefficients.dtype)

    @cached_property
    def _factors(self) -> list[tuple[Floats, Floats]]:
        """Factors (R, R_t) of the operator for every offset of `interactions`."""
        dtype = self.coefficients.dtype
        return [_factors(self.operators, pairs.offset, dtype) for pairs in self.interactions]

    def _upward(self, tractions: Floats) -> Floats:
        """Coefficients (B, K, R) of all boxes from tractions (N M, K)."""
        coefficients = np.zeros((self.tree.box_starts[-1], tractions.shape[1], self.rank), tractions.dtype)
        for box, rows in self._leaves():
            coefficients[box] = tractions[rows].T @ self.coefficients[rows]
        for level in reversed(self.tree.levels[1:]):
            for octant, children, parents in self.tree.families(level):
                coefficients[parents] += _times(coefficients[children], self._transfers[octant])
        return coefficients

    def _across(self, sources: Floats) -> Floats:
        """Coefficients (B, K, R) of the velocities in all boxes, raised by the boxes that they interact with.

        Each thread takes its share of the offsets: matrices of this size gain nothing from threads of their own.
        """
        work = list(zip(self.interactions, self._factors, strict=True))
        threads = get_num_threads()
        with ThreadPoolExecutor(threads) as pool:
            parts = list(pool.map(lambda share: _raised(sources, work[share::threads]), range(threads)))
        targets = sum(parts[1:], start=parts[0])
        targets /= (8 * np.pi * self.tree.box_sides[:, None, None]).astype(targets.dtype)
        return targets

    def _downward(self, coefficients: Floats) -> Floats:
        """Velocities (N M, K) from the coefficients (B, K, R) of all boxes, which are changed."""
        for level in self.tree.levels[1:]:
            for octant, children, parents in self.tree.families(level):
                coefficients[children] += _times(coefficients[parents], self._transfers[octant].T)
        velocities = np.empty((len(self.coefficients), coefficients.shape[1]), coefficients.dtype)
        for box, rows in self._leaves():
            velocities[rows] = self.coefficients[rows] @ coefficients[box].T
        return velocities

    def _leaves(self) -> list[tuple[int, slice]]:
        """Number of each leaf among the boxes, and the rows of its spheres' modes."""
        modes = len(self.coefficients) // len(self.tree.order)
        ends = (self.tree.leaf_starts * modes).tolist()
        first = self.tree.boxes(self.tree.depth).start
        return [(first + leaf, slice(*ends[leaf : leaf + 2])) for leaf in range(len(ends) - 1)]


def far_field(
    centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, accuracy: float, leaf_side: int | None = None
) -> FarField:
    """Far field of spheres (N, 3), (N,) to an accuracy.

    Parameters
    ----------
    accuracy
        Error of the velocities in the 2-norm over the 2-norm of those that all other spheres raise, near and far, from
        1e-7 to 1e-2. It holds for tractions that are random from sphere to sphere; smooth ones err a tenth of it.
    leaf_side
        Side of the leaves in largest radii, 4 or more; by default the fastest.
    """
    if not ACCURACIES[0] <= accuracy <= ACCURACIES[1]:
        raise ValueError(f"accuracy: expected {ACCURACIES[0]:g} to {ACCURACIES[1]:g}, got {accuracy:g}")
    largest = float(radii.max())
    tree = octree(centers, largest * leaf_side) if leaf_side else _fastest(centers, largest, basis, accuracy)
    sides_per_radius = float(leaf_side or round(tree.side / largest))
    operators = box_operators(basis.order, sides_per_radius, _precision(accuracy, sides_per_radius))
    dtype = arithmetic(accuracy)
    if not tree.levels:
        return FarField(tree, operators, np.empty((0, operators.rank), dtype), ())
    interactions = tuple(pairs for pairs in tree.interactions() if len(pairs.targets))
    return FarField(tree, operators, _coefficients(tree, operators, centers, radii, dtype), interactions)


def arithmetic(accuracy: float) -> type[np.floating[Any]]:
    """Single or double precision, whichever an accuracy asks for."""
    return np.float32 if accuracy >= SINGLE_PRECISION else np.float64


@cache
def _factors(operators: BoxOperators, offset: Offset, dtype: np.dtype[np.floating[Any]]) -> tuple[Floats, Floats]:
    """Kept with the operators: for small clusters they take as long to make as several iterations."""
    target, source = operators.factors(offset)
    return target.astype(dtype), source.astype(dtype)


def _precision(accuracy: float, sides_per_radius: float) -> Precision:
    """Nodes and truncation that reach an accuracy.

    Flows from beyond the neighbours are analytic up to 3/2 − ε sides from the centre of a box enlarged to 1/2 + ε, so
    that n nodes interpolate with an error ~ ρ^−n, ln ρ = arcosh of the ratio (Bernstein's ellipse). The prefactors are
    measured on touching spheres with random tractions.
    """
    reach = 1 / sides_per_radius
    ratio = (1.5 - reach) / (0.5 + reach)
    nodes = np.log(INTERPOLATION_ERROR / accuracy) / np.arccosh(ratio)
    return Precision(int(np.ceil(nodes)), TRUNCATION * accuracy)


def _fastest(centers: FloatArray, largest: float, basis: MultipoleBasis, accuracy: float) -> Octree:
    """The octree of the leaf side that costs the fewest operations, near pairs included."""
    trees = [octree(centers, largest * side) for side in LEAF_SIDES]
    digits = -np.log10(TRUNCATION * accuracy)

    def cost(tree: Octree) -> float:
        rank = (3.1 * digits - 0.5) ** 2 * (1 + 2.2 * largest / tree.side)  # fitted to the ranks found
        return tree.near_pairs() * pair_cost(basis) + tree.far_pairs() * 0.6 * rank**2

    return min(trees, key=cost)


def _coefficients(
    tree: Octree, operators: BoxOperators, centers: FloatArray, radii: FloatArray, dtype: type[np.floating[Any]]
) -> Floats:
    """Coefficients (N M, R) of unit tractions in their leaf, spheres in the order of the tree."""
    boxes = np.repeat(tree.leaf_centers(), np.diff(tree.leaf_starts), axis=0)
    places, sizes = (centers[tree.order] - boxes) / tree.side, radii[tree.order] / tree.side
    coefficients = np.empty((len(radii), operators.basis.size, operators.rank), dtype)
    for start in range(0, len(radii), SPHERE_PIECE):
        piece = slice(start, start + SPHERE_PIECE)
        coefficients[piece] = operators.coefficients(places[piece], sizes[piece])
    return coefficients.reshape(-1, operators.rank)


def _raised(sources: Floats, work: list[tuple[Pairs, tuple[Floats, Floats]]]) -> Floats:
    """Coefficients (B, K, R) raised by sources (B, K, R) through some of the interactions, both ways."""
    targets = np.zeros_like(sources)
    for pairs, (target, source) in work:
        for start in range(0, len(pairs.targets), BOX_PIECE):
            ones, others = (side[start : start + BOX_PIECE] for side in (pairs.targets, pairs.sources))
            targets[ones] += _times(_times(sources[others], source), target.T)
            targets[others] += _times(_times(sources[ones], target), source.T)
    return targets


def _times(rows: Floats, matrix: Floats) -> Floats:
    """Rows (..., R) times a matrix as one matrix product."""
    return (rows.reshape(-1, rows.shape[-1]) @ matrix).reshape(*rows.shape[:-1], matrix.shape[1])
