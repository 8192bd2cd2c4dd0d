"""Mobility of a pair of spheres, in closed form for every multipole order.

The element for mode ψ on sphere i and ψ' on sphere j is (1/8π) ∫∫ ψ(u)·G(x_i + a_i u − x_j − a_j u')·ψ'(u'), with the
Oseen tensor G = (1∇² − ∇∇) r. Components of a mode of rank l are harmonics Y_l, and for a biharmonic function f

    ∫ Y_lm(u) f(x + a u) du = 4π a^l / (2l + 1)!! · 𝒴_lm(∇) [1 + a² ∇² / (2(2l + 3))] f(x),

so the element is a polynomial in derivatives acting on r. In the frame whose z axis runs from j to i these are known:
∂z^k r vanishes on the axis for k ≥ 2 and ∇² r = 2/r. Only equal m meet, and with ρ = a/r the block is

    (1/r) ρ_i^l ρ_j^l' [direct + extended · (ρ_i² / (2(2l + 3)) + ρ_j² / (2(2l' + 3)))],

two constant matrices for all pairs of all sizes. The block in the fixed frame follows by rotating each family.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from math import factorial, prod
from typing import TYPE_CHECKING

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.stokes.basis import Family, MultipoleBasis
from rheoclast.stokes.harmonics import quarter_turn

ROUNDING = 1e-9  # exceeds that of elements that vanish by symmetry; the others are of order one

if TYPE_CHECKING:
    from rheoclast.stokes.pair_kernels import AxialElements


@dataclass(frozen=True, eq=False)
class PairCoefficients:
    """The constant matrices (M, M) of the block in the frame of the pair."""

    basis: MultipoleBasis
    direct: FloatArray
    extended: FloatArray

    @classmethod
    @cache
    def of(cls, basis: MultipoleBasis) -> PairCoefficients:
        """Coefficients for a basis of any order."""
        direct, extended = np.zeros((2, basis.size, basis.size))
        for family, rows in zip(basis.families, basis.slices, strict=True):
            for other, columns in zip(basis.families, basis.slices, strict=True):
                direct[rows, columns], extended[rows, columns] = _family_coefficients(family, other)
        return cls(basis, _checks.frozen(direct), _checks.frozen(extended))

    def blocks(self, separations: FloatArray, radii_i: FloatArray, radii_j: FloatArray) -> FloatArray:
        """Mobility blocks (P, M, M) of pairs in the fixed frame.

        Parameters
        ----------
        separations
            (P, 3) centre of sphere i minus centre of sphere j.
        radii_i, radii_j
            (P,) radii.
        """
        from rheoclast.stokes.pair_kernels import pair_blocks

        blocks = np.empty((len(radii_i), self.basis.size, self.basis.size))
        pair_blocks(separations, radii_i, radii_j, self.elements, blocks)
        return blocks

    @cached_property
    def elements(self) -> AxialElements:
        """Those that differ from zero, as the compiled sums take them."""
        from rheoclast.stokes.pair_kernels import AxialElements

        modes = np.array(np.nonzero(np.abs(self.direct) + np.abs(self.extended) > ROUNDING))
        families = list(zip(self.basis.families, self.basis.slices, strict=True))
        starts = np.concatenate([np.full(family.size, where.start) for family, where in families])[modes]
        degrees = np.concatenate([np.full(family.size, family.degree) for family, where in families])[modes]
        direct, extended = self.direct[*modes], self.extended[*modes]
        turns = _quarter_turns(self.basis.order)
        return AxialElements(starts, modes - starts, degrees, self.basis.rank[modes], direct, extended, turns)


def _quarter_turns(order: int) -> FloatArray:
    """Turns from z to y of the harmonics of degrees 0 … p, each in the leading corner of (2p + 1, 2p + 1)."""
    turns = np.zeros((order + 1, 2 * order + 1, 2 * order + 1))
    for degree in range(1, order + 1):
        turns[degree, : 2 * degree + 1, : 2 * degree + 1] = quarter_turn(degree)
    return turns


def _family_coefficients(family: Family, other: Family) -> tuple[FloatArray, FloatArray]:
    """Blocks (2n + 1, 2n' + 1) of the two coefficient matrices."""
    rank, other_rank = family.rank, other.rank
    prefactor = (-1) ** other_rank * 2 * np.pi / (_odd_factorial(2 * rank + 1) * _odd_factorial(2 * other_rank + 1))
    laplacian = 2 * _axial_derivatives_of_inverse(rank, other_rank)
    direct = np.einsum("kam,ab,kbn->mn", family.components, laplacian, other.components)
    extended = np.zeros_like(direct)
    divergences = _divergence(family) * _divergence(other)
    if family.kind == other.kind == "W":
        direct -= divergences * _axial_derivatives_of_distance(family.degree, other.degree)
        extended -= divergences * 2 * _axial_derivatives_of_inverse(family.degree, other.degree)
    elif {family.kind, other.kind} == {"V", "W"}:
        direct -= divergences * 2 * _axial_derivatives_of_inverse(family.degree, other.degree)
    return prefactor * direct, prefactor * extended


def _divergence(family: Family) -> float:
    """Factor of ψ(x)·x, the solid mode times its argument: n 𝒴_n for W, −(n + 1) |x|² 𝒴_n for V, zero for X."""
    factor = {"W": family.degree, "X": 0, "V": -(family.degree + 1)}[family.kind]
    return factor / family.norm


def _axial_derivatives_of_inverse(n: int, k: int) -> FloatArray:
    """𝒴_nm(∇) 𝒴_km'(∇) (1/r) at r = ẑ for real m, m': (2n + 1, 2k + 1), zero unless m = m'."""
    return _on_equal_order(n, k, lambda _: (-1) ** (n + k) * factorial(n + k))


def _axial_derivatives_of_distance(n: int, k: int) -> FloatArray:
    """𝒴_nm(∇) 𝒴_km'(∇) r at r = ẑ for real m, m' and n, k ≥ 1: (2n + 1, 2k + 1), zero unless m = m'.

    To first order in ∇², 𝒴_nm 𝒴_km = c (∂z^(n+k) − s ∂z^(n+k−2) ∇²), and the first term vanishes on the axis.
    """

    def value(m: int) -> float:
        shift = m + sum((d - m) * (d - m - 1) / (2 * (2 * d - 1)) for d in (n, k))
        return -shift * 2 * (-1) ** (n + k) * factorial(n + k - 2)

    return _on_equal_order(n, k, value)


def _on_equal_order(n: int, k: int, value: Callable[[int], float]) -> FloatArray:
    """Spread c_nm c_km (−1)^m value(m) over the elements of equal order of a (2n + 1, 2k + 1) matrix."""
    matrix = np.zeros((2 * n + 1, 2 * k + 1))
    for order in range(-min(n, k), min(n, k) + 1):
        m = abs(order)
        matrix[n + order, k + order] = (-1) ** m * _leading(n, m) * _leading(k, m) * value(m)
    return matrix


def _leading(n: int, m: int) -> float:
    """Coefficient c_nm in 𝒴_nm = c_nm (x + iy)^m (z^(n−m) + terms with |x|²), 𝒴_nm normalized on the unit sphere."""
    norm = np.sqrt((2 * n + 1) / (4 * np.pi) * factorial(n - m) / factorial(n + m))
    return float(norm * _odd_factorial(2 * n - 1) / factorial(n - m))


def _odd_factorial(n: int) -> int:
    """Double factorial n!! of an odd number, (−1)!! = 1."""
    return prod(range(n, 0, -2))
