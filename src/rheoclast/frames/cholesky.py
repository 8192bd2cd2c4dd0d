"""Cholesky factors of a large frame, front by front along a nested dissection."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.linalg.blas import dsyrk, dtrsm
from scipy.linalg.lapack import dpotrf
from scipy.sparse import bsr_array, csr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread

THREADED = 1500  # unknowns of a front from which a second thread pays
STRIP = 128  # columns of a triangle that are added at once, with the little above its diagonal
PANEL = 768  # OpenBLAS gains nothing from threads in a Cholesky this small, and crashes in one of 16 000 unknowns


@dataclass(frozen=True, eq=False)
class Front:
    """Columns of the Cholesky factor that belong to one part of the dissection.

    Attributes
    ----------
    own
        The unknowns of the part, in the order of elimination.
    beyond
        (B,) later unknowns that they are coupled with.
    triangle, rectangle
        Rows (P, P) of the own unknowns, lower, and rows (B, P) of those beyond.
    """

    own: slice
    beyond: IntArray
    triangle: FloatArray
    rectangle: FloatArray


@dataclass(frozen=True, eq=False)
class FrontalCholesky:
    """Factors L Lᵀ of a symmetric positive definite matrix. Made by `frontal_cholesky`.

    Attributes
    ----------
    order
        The unknowns in the order of elimination.
    fronts
        Their factors in that order.
    """

    order: IntArray
    fronts: tuple[Front, ...]

    @property
    def pivots(self) -> FloatArray:
        """Squares (n,) of the diagonal of L, in the order of the unknowns."""
        pivots = np.empty(len(self.order))
        pivots[self.order] = np.concatenate([front.triangle.diagonal() for front in self.fronts]) ** 2
        return pivots

    def solve(self, rhs: FloatArray, /) -> FloatArray:
        """Solution (n, K) for right-hand sides (n, K)."""
        return self.backward(self.forward(rhs)[0])

    def forward(self, rhs: FloatArray, /) -> tuple[FloatArray, list[slice]]:
        """Half of a solution, y (n, K) with L y = b in the order of elimination, and the rows where it is not zero.

        Right-hand sides b (n, K) that are zero in most places cost little.
        """
        y = rhs[self.order]
        filled = []
        for front in self.fronts:
            if y[front.own].any():
                y[front.own] = dtrsm(1.0, front.triangle, y[front.own], lower=1)
                y[front.beyond] -= front.rectangle @ y[front.own]
                filled.append(front.own)
        return y, filled

    def backward(self, half: FloatArray, /) -> FloatArray:
        """The other half, x (n, K) with Lᵀ x = y, from y in the order of elimination, which is used up."""
        for front in reversed(self.fronts):
            rest = half[front.own] - front.rectangle.T @ half[front.beyond]
            half[front.own] = dtrsm(1.0, front.triangle, rest, lower=1, trans_a=1)
        solution = np.empty_like(half)
        solution[self.order] = half
        return solution


def frontal_cholesky(matrix: bsr_array, part: IntArray) -> FrontalCholesky:
    """Factorize a symmetric positive definite block matrix.

    The multifrontal method (Duff & Reid 1983): a front is a dense matrix of the unknowns of one part and of those they
    meet later. Eliminating the former leaves an update of the latter, which is added to the front of the next of them.

    Parameters
    ----------
    matrix
        n by n square blocks, both triangles.
    part
        (n,) parts of the block rows by `dissection`.

    Raises
    ------
    ArithmeticError
        If the matrix is not positive definite to rounding.
    """
    order = _leaves_first(part)
    permuted, part, size = _permuted(matrix, order), part[order], matrix.blocksize[0]
    bounds = np.flatnonzero(np.diff(part, prepend=0, append=0))
    arriving: dict[int, list[_Update]] = {}
    fronts = []
    for start, stop in pairwise(bounds.tolist()):
        front, update = _eliminated(permuted, start, stop, arriving.pop(int(part[start]), []))
        fronts.append(front)
        if len(update.blocks):
            arriving.setdefault(int(part[update.blocks[0]]), []).append(update)
    return FrontalCholesky(unknowns(order, size), tuple(fronts))


@dataclass(frozen=True, eq=False)
class _Update:
    """What a front adds to those after it: its block rows, and the lower triangle of a matrix of their unknowns."""

    blocks: IntArray
    matrix: FloatArray


def _eliminated(matrix: bsr_array, start: int, stop: int, arrived: list[_Update]) -> tuple[Front, _Update]:
    """The front of the block rows from start to stop, and its update of those beyond."""
    size = matrix.blocksize[0]
    beyond, corner, rectangle, update = _assembled(matrix, start, stop, arrived)
    with one_blas_thread(when=sum(rectangle.shape) < THREADED):
        triangle = _cholesky(corner)
        if len(beyond):
            rectangle = dtrsm(1.0, triangle, rectangle, side=1, lower=1, trans_a=1, overwrite_b=1)
            update = dsyrk(-1.0, rectangle, beta=1.0, c=update, lower=1, overwrite_c=1)
    return Front(slice(size * start, size * stop), unknowns(beyond, size), triangle, rectangle), _Update(beyond, update)


def _assembled(
    matrix: bsr_array, start: int, stop: int, arrived: list[_Update]
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Block rows beyond the front, and its matrix before elimination: own corner, rows beyond, update so far."""
    size = matrix.blocksize[0]
    rows, columns, blocks = _later_entries(matrix, start, stop)
    inside = columns < stop
    beyond = np.unique(np.concatenate([columns[~inside], *(each.blocks[each.blocks >= stop] for each in arrived)]))
    own, rest = size * (stop - start), size * len(beyond)
    corner, rectangle, update = (np.zeros(shape, order="F") for shape in ((own, own), (rest, own), (rest, rest)))
    _as_blocks(corner, size)[columns[inside] - start, :, rows[inside]] = blocks[inside]
    _as_blocks(rectangle, size)[np.searchsorted(beyond, columns[~inside]), :, rows[~inside]] = blocks[~inside]
    for each in arrived:
        split = int(np.searchsorted(each.blocks, stop))
        low = unknowns(each.blocks[:split] - start, size)
        high = unknowns(np.searchsorted(beyond, each.blocks[split:]), size)
        split *= size
        _add_lower(corner, low, each.matrix[:split, :split])
        _add(rectangle, high, low, each.matrix[split:, :split])
        _add_lower(update, high, each.matrix[split:, split:])
    return beyond, corner, rectangle, update


def _add(matrix: FloatArray, rows: IntArray, columns: IntArray, part: FloatArray) -> None:
    """Add to some rows and columns of a matrix, in the order of its storage."""
    matrix.T[np.ix_(columns, rows)] += part.T


def _add_lower(matrix: FloatArray, places: IntArray, part: FloatArray) -> None:
    """Add a lower triangle to some places of another, some columns at a time."""
    for start in range(0, len(places), STRIP):
        strip = places[start : start + STRIP]
        _add(matrix, places[start:], strip, part[start:, start : start + STRIP])


def _later_entries(matrix: bsr_array, start: int, stop: int) -> tuple[IntArray, IntArray, FloatArray]:
    """Row within the front, column, and transposed block of every entry of the block rows from start to stop."""
    entries = slice(matrix.indptr[start], matrix.indptr[stop])
    rows = np.repeat(np.arange(stop - start), np.diff(matrix.indptr[start : stop + 1]))
    columns = matrix.indices[entries]
    later = columns >= start
    return rows[later], columns[later].astype(np.intp), matrix.data[entries][later].transpose(0, 2, 1)


def _as_blocks(matrix: FloatArray, size: int) -> FloatArray:
    """View (m, size, n, size) of a matrix stored by columns."""
    return matrix.T.reshape(matrix.shape[1] // size, size, matrix.shape[0] // size, size).transpose(2, 3, 0, 1)


def _cholesky(matrix: FloatArray) -> FloatArray:
    """Lower triangular Cholesky factor; of the argument only the lower triangle counts, and it is used up."""
    if len(matrix) <= PANEL:
        with one_blas_thread():
            factor, info = dpotrf(matrix, lower=1, clean=1, overwrite_a=1)
        if info:
            raise ArithmeticError("the matrix is not positive definite to rounding")
        return factor
    half = len(matrix) // 2
    factor = np.zeros_like(matrix, order="F")
    factor[:half, :half] = triangle = _cholesky(np.asfortranarray(matrix[:half, :half]))
    factor[half:, :half] = side = dtrsm(1.0, triangle, matrix[half:, :half], side=1, lower=1, trans_a=1)
    factor[half:, half:] = _cholesky(dsyrk(-1.0, side, beta=1.0, c=matrix[half:, half:], lower=1))
    return factor


def _leaves_first(part: IntArray) -> IntArray:
    """Order in which every part of the heap comes after all that descend from it, branch by branch."""
    depth = np.floor(np.log2(part)).astype(np.intp)
    last_leaf = (part + 1) << (depth.max() - depth)
    return np.lexsort((-depth, last_leaf))


def _permuted(matrix: bsr_array, order: IntArray) -> bsr_array:
    """Block matrix with rows and columns in another order."""
    count = len(order)
    number = csr_array((np.arange(1, len(matrix.indices) + 1), matrix.indices, matrix.indptr), shape=(count, count))
    number = number[order][:, order]
    return bsr_array((matrix.data[number.data - 1], number.indices, number.indptr), shape=matrix.shape)


def unknowns(blocks: IntArray, size: int) -> IntArray:
    """Indices (size·B,) of the rows of some blocks (B,) of rows."""
    return (size * blocks[:, None] + np.arange(size)).ravel()
