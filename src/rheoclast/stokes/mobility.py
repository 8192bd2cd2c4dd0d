"""The mobility operator of many spheres: surface velocity from surface traction.

Unknown on each sphere is a² times the traction, on the modes of a `MultipoleBasis`; the operator is symmetric and
positive definite for spheres that do not overlap, whatever their radii.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.progress import Progress
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.pair_blocks import PairCoefficients
from rheoclast.vectors import elementary_velocities

PAIR_CHUNK_BYTES = 64e6
ROWS_AT_A_TIME = 64


@dataclass(frozen=True, eq=False)
class Mobility:
    """Mobility of N spheres by direct sums over pairs.

    Parameters
    ----------
    centers, radii
        (N, 3) and (N,), in one unit of length; the viscosity is one.
    basis
        The modes on each sphere.
    """

    centers: FloatArray
    radii: FloatArray
    basis: MultipoleBasis

    @cached_property
    def _coefficients(self) -> PairCoefficients:
        return PairCoefficients.of(self.basis)

    def __matmul__(self, tractions: FloatArray) -> FloatArray:
        """Velocities (N, M, K) from tractions (N, M, K), without storing the matrix."""
        velocities = self.basis.self_mobility[:, None] / self.radii[:, None, None] * tractions
        for i, others, blocks in self._rows():
            velocities[i] += np.einsum("pab,pbk->ak", blocks, tractions[others])
            velocities[others] += np.einsum("pab,ak->pbk", blocks, tractions[i])
        return velocities

    def matrix(self, progress: Progress | None = None) -> FloatArray:
        """The dense matrix (M, N, M, N), mode before sphere: its leading part is the matrix of every lower order."""
        from rheoclast.stokes.pair_kernels import matrix_rows

        count, modes = len(self.radii), self.basis.size
        matrix = np.empty((modes, count, modes, count))
        piece = max(ROWS_AT_A_TIME, count // 20)
        for first in range(0, count, piece):
            last = min(first + piece, count)
            matrix_rows(self.centers, self.radii, self._coefficients.elements, first, last, matrix)
            if progress is not None:
                progress("pair mobilities", last / count)
        own = np.arange(count)
        matrix[:, own, :, own] = np.diag(self.basis.self_mobility) / self.radii[:, None, None]
        return matrix

    def _rows(self) -> Iterator[tuple[int, slice, FloatArray]]:
        """Blocks (P, M, M) of sphere i with spheres j < i, for each i in pieces of limited memory."""
        piece = max(1, int(PAIR_CHUNK_BYTES / (8 * self.basis.size**2)))
        for i in range(1, len(self.radii)):
            for start in range(0, i, piece):
                others = slice(start, min(i, start + piece))
                radii_j = self.radii[others]
                separations = self.centers[i] - self.centers[others]
                yield i, others, self._coefficients.blocks(separations, np.full_like(radii_j, self.radii[i]), radii_j)

    def ambient_velocities(self) -> FloatArray:
        """Velocities (N, M, 11) that the eleven elementary flows have on the surfaces."""
        unit = self.basis.elementary_projections
        velocities = elementary_velocities(self.centers) @ unit[:3]
        velocities[:, 3:] += self.radii[:, None, None] * unit[3:]
        return velocities.transpose(0, 2, 1)

    def moments(self, tractions: FloatArray) -> FloatArray:
        """Force, torque and stresslet components (N, 11, K) of every sphere from the tractions (N, M, K).

        The tractions may be those of a lower order, with fewer modes.
        """
        moments = self.basis.elementary_projections[:, : tractions.shape[1]] @ tractions
        moments[:, 3:] *= self.radii[:, None, None]
        return moments
