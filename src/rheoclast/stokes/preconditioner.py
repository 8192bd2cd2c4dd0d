"""Sparse inverse Cholesky factor of the mobility: A⁻¹ ≈ U Uᵀ, spheres ordered from coarse to fine.

Each sphere's block column is conditioned on the coarser spheres within a few of its own length scales: the factor that
is nearest to the truth in the sense of Kullback and Leibler for that pattern (F. Schäfer, M. Katzfuss & H. Owhadi, SIAM
J. Sci. Comput. 43 (2021) A2019).
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.errors import GeometryError
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.block_rows import BlockRows
from rheoclast.stokes.pair_blocks import PairCoefficients
from rheoclast.stokes.pair_kernels import AxialElements, lower_triangle
from rheoclast.stokes.solver import NOT_DEFINITE


def inverse_factor(
    centers: FloatArray, radii: FloatArray, basis: MultipoleBasis, reach: float
) -> tuple[BlockRows, BlockRows]:
    """The factor U and its transpose, in single precision, which suffices for a preconditioner.

    Parameters
    ----------
    centers, radii, basis
        Spheres and modes, as for `Mobility`.
    reach
        A sphere is conditioned on coarser spheres within `reach` times its length scale.

    Raises
    ------
    GeometryError
        If the mobility of some neighbours is not positive definite, which happens when spheres overlap.
    """
    order, scale = coarse_to_fine(centers)
    starts, members = _conditioning_sets(centers, order, scale, reach)
    numbers = np.empty(len(members) * basis.size**2, np.float32)
    elements = PairCoefficients.of(basis).elements
    with one_blas_thread():
        try:
            _block_columns(centers, radii, basis.self_mobility, elements, starts, members, numbers)
        except (SystemError, np.linalg.LinAlgError):  # how Numba tells of an error in a parallel loop
            raise GeometryError(NOT_DEFINITE) from None
    lower = BlockRows(starts, members, numbers)
    return lower.transposed(), lower


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
    ordered = np.ascontiguousarray(centers[order].T)
    squares = (reach * scale) ** 2
    squares[0] = 0.0  # the first sphere has none before it
    sizes = np.empty(len(order), np.intp)
    sizes[order] = _count_near_before(ordered, squares)
    starts = np.concatenate([[0], np.cumsum(sizes)])
    members = np.empty(starts[-1], np.intp)
    _list_near_before(ordered, squares, order, starts, members)
    return starts, members


@njit(parallel=True, fastmath=True, cache=True)
def _count_near_before(points: FloatArray, squares: FloatArray) -> IntArray:
    """Number of points (3, N) up to each one, itself among them, within the root of its square (N,)."""
    counts = np.empty(squares.size, np.intp)
    for i in prange(squares.size):
        x, y, z, most = points[0, i], points[1, i], points[2, i], squares[i]
        near = 0
        for j in range(i + 1):
            square = (points[0, j] - x) ** 2 + (points[1, j] - y) ** 2 + (points[2, j] - z) ** 2
            near += square <= most
        counts[i] = near
    return counts


@njit(parallel=True, fastmath=True, cache=True)
def _list_near_before(
    points: FloatArray, squares: FloatArray, order: IntArray, starts: IntArray, members: IntArray
) -> None:
    """The spheres that `_count_near_before` counts, by sphere."""
    for i in prange(squares.size):
        x, y, z, most = points[0, i], points[1, i], points[2, i], squares[i]
        place = starts[order[i]]
        for j in range(i + 1):
            if (points[0, j] - x) ** 2 + (points[1, j] - y) ** 2 + (points[2, j] - z) ** 2 <= most:
                members[place] = order[j]
                place += 1


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def _block_columns(
    centers: FloatArray,
    radii: FloatArray,
    self_mobility: FloatArray,
    elements: AxialElements,
    starts: IntArray,
    members: IntArray,
    numbers: NDArray[np.float32],
) -> None:
    """Write every set's block column of U, transposed, to `numbers` as `BlockRows` has them.

    With the set's mobility C Cᵀ and the sphere itself last, the column is the last block column of C⁻ᵀ.
    """
    modes = self_mobility.size
    for each in prange(starts.size - 1):
        begin, end = starts[each], starts[each + 1]
        size = (end - begin) * modes
        matrix = lower_triangle(centers, radii, members[begin:end], self_mobility, elements)
        lower = np.linalg.cholesky(matrix)
        for m in range(modes):
            solution = np.zeros(size)
            solution[size - modes + m] = 1.0
            for row in range(size - modes + m, -1, -1):
                value = solution[row] / lower[row, row]
                solution[row] = value
                for above in range(row):
                    solution[above] -= lower[row, above] * value
            place = begin * modes**2 + m * size
            numbers[place : place + size] = solution
