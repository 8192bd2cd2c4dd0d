"""Sparse matrices of small dense blocks, one block row per sphere, compiled by Numba."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray

Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, eq=False)
class BlockRows:
    """A matrix A of N × N blocks of M × M numbers. The blocks of a row are joined, so that its product is one long sum.

    Attributes
    ----------
    starts, members
        Row i has blocks in the columns `members[starts[i] : starts[i + 1]]`, (N + 1,) and (E,).
    numbers
        (E M²,) in single or double precision: row i of blocks, E_i of them, as a matrix (M, E_i M).
    """

    starts: IntArray
    members: IntArray
    numbers: Floats

    def __matmul__(self, vectors: FloatArray) -> FloatArray:
        """A x of vectors (N, M, K)."""
        result = np.empty_like(vectors)
        _multiply(self.starts, self.members, self.numbers, np.ascontiguousarray(vectors.transpose(2, 0, 1)), result)
        return result

    def transposed(self) -> BlockRows:
        """The transposed matrix."""
        count = len(self.starts) - 1
        entries = np.argsort(self.members, kind="stable")
        starts = np.concatenate([[0], np.cumsum(np.bincount(self.members, minlength=count))])
        rows = np.repeat(np.arange(count), np.diff(self.starts))
        numbers = np.empty_like(self.numbers)
        modes = round(np.sqrt(len(numbers) / len(entries)))
        _transpose(self.starts, self.numbers, entries, rows, starts, modes, numbers)
        return BlockRows(starts, rows[entries], numbers)


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def _multiply(starts: IntArray, members: IntArray, numbers: Floats, vectors: FloatArray, result: FloatArray) -> None:
    """Vectors (K, N, M) into result (N, M, K). Four columns at a time share what is read of the matrix."""
    columns, modes = vectors.shape[0], vectors.shape[2]
    for row in prange(starts.size - 1):
        first, end = starts[row], starts[row + 1]
        width = (end - first) * modes
        joined = np.empty((columns, width))
        for k in range(columns):
            for e in range(end - first):
                joined[k, e * modes : (e + 1) * modes] = vectors[k, members[first + e]]
        for k in range(0, columns, 4):
            last = columns - 1
            x0, x1, x2, x3 = joined[k], joined[min(k + 1, last)], joined[min(k + 2, last)], joined[min(k + 3, last)]
            for m in range(modes):
                line = numbers[first * modes**2 + m * width : first * modes**2 + (m + 1) * width]
                y0 = y1 = y2 = y3 = 0.0
                for n in range(width):
                    y0 += line[n] * x0[n]
                    y1 += line[n] * x1[n]
                    y2 += line[n] * x2[n]
                    y3 += line[n] * x3[n]
                result[row, m, k] = y0
                result[row, m, min(k + 1, last)] = y1
                result[row, m, min(k + 2, last)] = y2
                result[row, m, min(k + 3, last)] = y3


@njit(parallel=True, cache=True)
def _transpose(
    starts: IntArray,
    numbers: Floats,
    entries: IntArray,
    rows: IntArray,
    starts_of_transposed: IntArray,
    modes: int,
    out: Floats,
) -> None:
    for column in prange(starts_of_transposed.size - 1):
        first = starts_of_transposed[column]
        width = (starts_of_transposed[column + 1] - first) * modes
        for place in range(first, starts_of_transposed[column + 1]):
            entry = entries[place]
            row = rows[entry]
            given = starts[row] * modes**2 + (entry - starts[row]) * modes
            given_width = (starts[row + 1] - starts[row]) * modes
            for m in range(modes):
                for n in range(modes):
                    into = first * modes**2 + m * width + (place - first) * modes + n
                    out[into] = numbers[given + n * given_width + m]
