"""Sparse inverse Cholesky factor of the mobility: A⁻¹ ≈ U Uᵀ, spheres ordered from coarse to fine.

Each sphere's block column is conditioned on the coarser spheres within a few of its own length scales: the factor that
is nearest to the truth in the sense of Kullback and Leibler for that pattern (F. Schäfer, M. Katzfuss & H. Owhadi, SIAM
J. Sci. Comput. 43 (2021) A2019).
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.block_sparse import BlockSparse
from rheoclast.stokes.pair_blocks import PairCoefficients

SPHERES_AT_A_TIME = 4096


def inverse_factor(centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, reach: float) -> BlockSparse:
    """The factor U, in single precision, which suffices for a preconditioner.

    Parameters
    ----------
    centers, radii, basis
        Spheres and modes, as for `Mobility`.
    reach
        A sphere is conditioned on coarser spheres within `reach` times its length scale.
    """
    order, scale = coarse_to_fine(centers)
    starts, members = _conditioning_sets(centers, order, scale, reach)
    count, modes = len(radii), basis.size
    coefficients = PairCoefficients.of(basis)
    columns = np.zeros((len(members), modes, modes), np.float32)
    for first in range(0, count, SPHERES_AT_A_TIME):
        part = starts[first : first + SPHERES_AT_A_TIME + 1]
        local, blocks = _pair_blocks(centers, radii, coefficients, part, members)
        with one_blas_thread():
            _block_columns(part, members, radii, basis.self_mobility, *local, blocks, columns)
    return BlockSparse(starts, members, columns)


@njit(cache=True, fastmath=True)
def coarse_to_fine(centers: FloatArray) -> tuple[IntArray, FloatArray]:
    """Maximin ordering (N,) of points (N, 3) and each ordered point's distance (N,) from all points before it.

    The first point is the one nearest to the mean; each next is the farthest from all before it.
    """
    count = len(centers)
    middle = np.zeros(3)
    for i in range(count):
        middle += centers[i]
    middle /= count
    order, scale = np.empty(count, np.intp), np.empty(count)
    x, y, z = centers[:, 0].copy(), centers[:, 1].copy(), centers[:, 2].copy()
    distance = (x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2
    chosen = np.argmin(distance)
    distance[:] = np.inf
    for position in range(count):
        order[position], scale[position] = chosen, np.sqrt(distance[chosen])
        cx, cy, cz = x[chosen], y[chosen], z[chosen]
        for i in range(count):
            square = (x[i] - cx) ** 2 + (y[i] - cy) ** 2 + (z[i] - cz) ** 2
            distance[i] = min(distance[i], square)
        chosen = np.argmax(distance)
    return order, scale


def _conditioning_sets(
    centers: FloatArray, order: IntArray, scale: FloatArray, reach: float
) -> tuple[IntArray, IntArray]:
    """Spheres that each sphere is conditioned on and, last, itself: starts (N + 1,) and members."""
    count = len(order)
    position = np.empty(count, np.intp)
    position[order] = np.arange(count)
    sets: list[IntArray] = [np.empty(0, np.intp)] * count
    sets[order[0]] = order[:1]
    first = 1
    while first < count:
        # Length scales never grow along the order: a stretch within a factor two shares one search tree.
        last = int(np.searchsorted(-scale, -scale[first] / 2, side="right"))
        last = max(last, first + 1)
        stretch = order[first:last]
        near = cKDTree(centers[order[:last]]).query_ball_point(centers[stretch], reach * scale[first:last])
        for sphere, found in zip(stretch, near, strict=True):
            earlier = np.array(found, np.intp)
            sets[sphere] = np.append(order[earlier[earlier < position[sphere]]], sphere)
        first = last
    starts = np.concatenate([[0], np.cumsum([len(each) for each in sets])])
    return starts.astype(np.intp), np.concatenate(sets)


def _pair_blocks(
    centers: FloatArray, radii: FloatArray, coefficients: PairCoefficients, starts: IntArray, members: IntArray
) -> tuple[tuple[IntArray, IntArray], FloatArray]:
    """Blocks (P, M, M) of all pairs within some sets, each pair once, and where each set's pairs are among them.

    The pairs (a, b), b < a, of a set follow one another row by row from `first[set]` in `index`.
    """
    sizes = np.diff(starts)
    first = np.concatenate([[0], np.cumsum(sizes * (sizes - 1) // 2)])
    keys = np.empty(first[-1], np.int64)
    for size in np.unique(sizes[sizes > 1]):
        chosen = np.flatnonzero(sizes == size)
        sets = members[starts[chosen][:, None] + np.arange(size)]
        a, b = np.tril_indices(size, -1)
        low, high = np.minimum(sets[:, a], sets[:, b]), np.maximum(sets[:, a], sets[:, b])
        keys[first[chosen][:, None] + np.arange(len(a))] = low * len(radii) + high
    unique, index = np.unique(keys, return_inverse=True)
    low, high = np.divmod(unique, len(radii))
    return (first, index), coefficients.blocks(centers[low] - centers[high], radii[low], radii[high])


@njit(parallel=True, fastmath=True, cache=True)
def _block_columns(
    starts: IntArray,
    members: IntArray,
    radii: FloatArray,
    self_mobility: FloatArray,
    first: IntArray,
    index: IntArray,
    blocks: FloatArray,
    columns: NDArray[np.float32],
) -> None:
    """Write the blocks of U in every set's column to `columns` at the places of its members.

    With the set's mobility C Cᵀ and the sphere itself last, the column is the last block column of C⁻ᵀ.
    """
    modes = self_mobility.size
    for each in prange(starts.size - 1):
        begin, end = starts[each], starts[each + 1]
        size = (end - begin) * modes
        matrix = np.zeros((size, size))
        pair = first[each]
        for a in range(end - begin):
            row, sphere = a * modes, members[begin + a]
            for m in range(modes):
                matrix[row + m, row + m] = self_mobility[m] / radii[sphere]
            for b in range(a):
                column, block = b * modes, blocks[index[pair]]
                pair += 1
                if sphere < members[begin + b]:
                    matrix[row : row + modes, column : column + modes] = block
                else:
                    matrix[row : row + modes, column : column + modes] = block.T
        lower = np.linalg.cholesky(matrix)
        for m in range(modes):
            solution = np.zeros(size)
            solution[size - modes + m] = 1.0
            for row in range(size - modes + m, -1, -1):
                value = solution[row] / lower[row, row]
                solution[row] = value
                for above in range(row):
                    solution[above] -= lower[row, above] * value
            for a in range(end - begin):
                columns[begin + a, :, m] = solution[a * modes : (a + 1) * modes]
