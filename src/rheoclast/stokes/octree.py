"""An octree of uniform depth over points, of occupied boxes only, and who interacts with whom at which level.

Boxes are numbered level after level, the coarsest first, and within a level along the Morton curve, whose keys
interleave the bits of the three cell numbers: the parent of key k is k >> 3 and its octant k & 7. Hard spheres bound
the density of points, so that uniform depth wastes nothing and every neighbour of a leaf is a leaf.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import NamedTuple

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray

DEPTH_LIMIT = 20  # 3 × 20 bits fit the key
COARSEST = 2  # at depth one all boxes are neighbours

NEIGHBOUR_OFFSETS = np.array(list(product((-1, 0, 1), repeat=3)))
FAR_OFFSETS = np.array([t for t in product(range(-3, 4), repeat=3) if max(map(abs, t)) > 1])
"""The (316, 3) offsets, in boxes, between children of neighbours that are not neighbours themselves."""


class Pairs(NamedTuple):
    """Box `sources[p]` lies `offset` boxes from box `targets[p]`; no box occurs twice on one side."""

    offset: tuple[int, int, int]
    targets: IntArray
    sources: IntArray


@dataclass(frozen=True, eq=False)
class Octree:
    """Occupied boxes over N points.

    Attributes
    ----------
    corner, side
        Lower corner (3,) of the root and side of a leaf.
    depth
        Level of the leaves; the root is level zero.
    order
        (N,) indices that sort the points by leaf.
    leaf_starts
        (L + 1,) where each leaf begins among the sorted points.
    leaf_keys
        (L,) Morton keys of the leaves, increasing.
    """

    corner: FloatArray
    side: float
    depth: int
    order: IntArray
    leaf_starts: IntArray
    leaf_keys: IntArray

    @cached_property
    def levels(self) -> range:
        """Levels that have interactions, coarsest first; empty for a tree of neighbours only."""
        return range(COARSEST, self.depth + 1)

    def keys(self, level: int) -> IntArray:
        """Morton keys (B,) of the boxes of a level, increasing."""
        return np.unique(self.leaf_keys >> 3 * (self.depth - level))

    @cached_property
    def box_starts(self) -> IntArray:
        """First box of each of `levels`, and the number of all boxes."""
        return np.cumsum([0, *(len(self.keys(level)) for level in self.levels)])

    def boxes(self, level: int) -> slice:
        """Numbers of the boxes of a level among all boxes."""
        position = level - COARSEST
        return slice(int(self.box_starts[position]), int(self.box_starts[position + 1]))

    @cached_property
    def box_sides(self) -> FloatArray:
        """Side (B,) of every box."""
        sides = [self.side * 2.0 ** (self.depth - level) for level in self.levels]
        return np.repeat(sides, np.diff(self.box_starts))

    def families(self, level: int) -> Iterator[tuple[int, IntArray, IntArray]]:
        """Octant, children and their parents (numbers of boxes), for the eight octants of the boxes of a level."""
        keys = self.keys(level)
        parents = np.searchsorted(self.keys(level - 1), keys >> 3) + self.boxes(level - 1).start
        for octant in range(8):
            chosen = np.flatnonzero(keys & 7 == octant)
            yield octant, chosen + self.boxes(level).start, parents[chosen]

    def interactions(self) -> Iterator[Pairs]:
        """Pairs of boxes that interact, each unordered pair once: half of the offsets, all levels together."""
        for offset in FAR_OFFSETS[len(FAR_OFFSETS) // 2 :]:
            found = [self._at_offset(level, offset) for level in self.levels]
            targets, sources = (np.concatenate(side) for side in zip(*found, strict=True))
            yield Pairs((int(offset[0]), int(offset[1]), int(offset[2])), targets, sources)

    def _at_offset(self, level: int, offset: IntArray) -> tuple[IntArray, IntArray]:
        keys, cells = self._cells[level]
        others = cells + offset
        candidates = np.flatnonzero(np.abs((others >> 1) - (cells >> 1)).max(axis=1) <= 1)
        targets, sources = _occupied(keys, others[candidates])
        start = self.boxes(level).start
        return candidates[targets] + start, sources + start

    @cached_property
    def _cells(self) -> dict[int, tuple[IntArray, IntArray]]:
        return {level: (keys := self.keys(level), _cells_of(keys)) for level in self.levels}

    @cached_property
    def neighbours(self) -> tuple[IntArray, IntArray]:
        """Neighbours of the leaves, each leaf its own among them, as starts (L + 1,) and leaves (total,)."""
        leaves, others = _neighbours(self.leaf_keys)
        by_leaf = np.lexsort((others, leaves))
        starts = np.searchsorted(leaves[by_leaf], np.arange(len(self.leaf_keys) + 1))
        return starts, others[by_leaf]

    def leaf_centers(self) -> FloatArray:
        """Centres (L, 3) of the leaves."""
        return self.corner + self.side * (_cells_of(self.leaf_keys) + 0.5)

    def near_pairs(self) -> int:
        """Number of ordered pairs of points, each point with itself among them, in neighbouring leaves."""
        leaves, others = _neighbours(self.leaf_keys)
        population = np.diff(self.leaf_starts)
        return int(population[leaves] @ population[others])

    def near_point_pairs(self) -> tuple[IntArray, IntArray]:
        """Points i ≠ j of every ordered pair of points in neighbouring leaves, sorted by the first."""
        starts, neighbours = self.neighbours
        leaves = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
        population = np.diff(self.leaf_starts)
        width = population[neighbours]
        sizes = population[leaves] * width
        meeting = np.repeat(np.arange(len(leaves)), sizes)  # the pair of leaves of each pair of points
        place = np.arange(len(meeting)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        one = self.order[self.leaf_starts[leaves[meeting]] + place // width[meeting]]
        other = self.order[self.leaf_starts[neighbours[meeting]] + place % width[meeting]]
        by_first = np.argsort(one, kind="stable")
        one, other = one[by_first], other[by_first]
        different = one != other
        return one[different], other[different]

    def far_pairs(self) -> int:
        """Number of ordered pairs of boxes that interact: children of neighbours less neighbours."""
        total = 0
        for level in self.levels:
            parents, children = np.unique(self.keys(level) >> 3, return_counts=True)
            one, other = _neighbours(parents)
            total += int(children[one] @ children[other]) - len(_neighbours(self.keys(level))[0])
        return total


def octree(points: FloatArray, side: float) -> Octree:
    """Octree over points (N, 3) with leaves of a given side, the root centred on the points."""
    lowest, highest = points.min(axis=0), points.max(axis=0)
    depth = max(0, int(np.ceil(np.log2(max(float((highest - lowest).max()) / side, 1.0)))))
    if depth > DEPTH_LIMIT:
        raise ValueError(
            f"centers: expected at most {2**DEPTH_LIMIT} leaves across, got 2^{depth}; parts lie too far apart"
        )
    corner = (lowest + highest) / 2 - side * 2.0**depth / 2
    cells = np.clip(np.floor((points - corner) / side).astype(np.intp), 0, 2**depth - 1)
    keys = _keys_of(cells)
    order = np.argsort(keys, kind="stable")
    leaf_keys, starts = np.unique(keys[order], return_index=True)
    leaf_starts = np.append(starts, len(points))
    for array in (order, leaf_starts, leaf_keys):
        _checks.frozen(array)
    return Octree(corner, side, depth, order, leaf_starts, leaf_keys)


def _neighbours(keys: IntArray) -> tuple[IntArray, IntArray]:
    """All ordered pairs of neighbouring boxes among the boxes with these sorted keys, a box with itself included."""
    cells = _cells_of(keys)
    found = [_occupied(keys, cells + offset) for offset in NEIGHBOUR_OFFSETS]
    one, other = (np.concatenate(side) for side in zip(*found, strict=True))
    return one, other


def _occupied(keys: IntArray, cells: IntArray) -> tuple[IntArray, IntArray]:
    """Which of the cells (C, 3) are occupied, and the positions of their boxes among the sorted keys."""
    valid = np.flatnonzero((cells >= 0).all(axis=1))  # beyond the upper faces no key is found
    wanted = _keys_of(cells[valid])
    position = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    hit = keys[position] == wanted
    return valid[hit], position[hit]


def _keys_of(cells: IntArray) -> IntArray:
    return (_spread_bits(cells[:, 0]) << 2) | (_spread_bits(cells[:, 1]) << 1) | _spread_bits(cells[:, 2])


def _cells_of(keys: IntArray) -> IntArray:
    return np.stack([_gather_bits(keys >> 2), _gather_bits(keys >> 1), _gather_bits(keys)], axis=1)


BIT_STEPS = (
    (32, 0x1F00000000FFFF),
    (16, 0x1F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)


def _spread_bits(number: IntArray) -> IntArray:
    """Put two zero bits between the bits of numbers below 2^21."""
    for shift, mask in BIT_STEPS:
        number = (number | number << shift) & mask
    return number


def _gather_bits(number: IntArray) -> IntArray:
    """Every third bit: the inverse of `_spread_bits`."""
    masks = [0x1FFFFF, *(mask for _, mask in BIT_STEPS)]
    number = number & masks[-1]
    for (shift, _), mask in zip(reversed(BIT_STEPS), reversed(masks[:-1]), strict=True):
        number = (number | number >> shift) & mask
    return number
