"""Sparse matrices of small dense blocks, one block row and column per sphere, compiled by Numba."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray

Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, eq=False)
class BlockSparse:
    """A matrix A of N × N blocks, stored block column after block column.

    Attributes
    ----------
    starts, members
        The blocks of column j stand in the rows `members[starts[j] : starts[j + 1]]`, (N + 1,) and (E,).
    blocks
        (E, M, M) in single or double precision.
    """

    starts: IntArray
    members: IntArray
    blocks: Floats

    def __matmul__(self, vectors: FloatArray) -> FloatArray:
        """A x of vectors (N, M, K)."""
        result = np.zeros_like(vectors)
        _by_rows(*self._rows, self.blocks, vectors, result)
        return result

    def transposed(self, vectors: FloatArray) -> FloatArray:
        """Aᵀ x of vectors (N, M, K)."""
        result = np.zeros_like(vectors)
        _by_columns(self.starts, self.members, self.blocks, vectors, result)
        return result

    @cached_property
    def _rows(self) -> tuple[IntArray, IntArray, IntArray]:
        """The same row after row: first entry (N + 1,) of each row, blocks (E,) and their columns (E,)."""
        count = len(self.starts) - 1
        entries = np.argsort(self.members, kind="stable")
        row_starts = np.concatenate([[0], np.cumsum(np.bincount(self.members, minlength=count))])
        columns = np.repeat(np.arange(count), np.diff(self.starts))
        return row_starts, entries, columns[entries]


@njit(parallel=True, fastmath=True, cache=True)
def _by_rows(
    starts: IntArray, entries: IntArray, columns: IntArray, blocks: Floats, vectors: FloatArray, result: FloatArray
) -> None:
    for row in prange(starts.size - 1):
        for place in range(starts[row], starts[row + 1]):
            block, vector = blocks[entries[place]], vectors[columns[place]]
            for m in range(block.shape[0]):
                for n in range(block.shape[1]):
                    for k in range(vector.shape[1]):
                        result[row, m, k] += block[m, n] * vector[n, k]


@njit(parallel=True, fastmath=True, cache=True)
def _by_columns(starts: IntArray, members: IntArray, blocks: Floats, vectors: FloatArray, result: FloatArray) -> None:
    for column in prange(starts.size - 1):
        for entry in range(starts[column], starts[column + 1]):
            block, vector = blocks[entry], vectors[members[entry]]
            for n in range(block.shape[0]):
                for m in range(block.shape[1]):
                    for k in range(vector.shape[1]):
                        result[column, m, k] += block[n, m] * vector[n, k]
