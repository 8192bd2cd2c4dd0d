"""The modes of traction on a sphere, rank by rank: force, torque and stresslet, and on.

Modes are the vector spherical harmonics of the unit vector u,

    W_nm = ∇s Y + n Y u,    X_nm = u × ∇s Y,    V_nm = ∇s Y − (n + 1) Y u,

normalized to one. The Cartesian components of each are scalar harmonics of one degree, its *rank* l: n − 1 for W, n
for X, n + 1 for V. Rank l is the moment of the traction that the mode carries, and its flow decays like r^−(l+1).
Order p keeps ranks 0 … p − 1, so orders are nested: 3 modes, then 11 (force, torque, stresslet), 26, 47, 3p² − 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.stokes.harmonics import raising
from rheoclast.vectors import LEVI_CIVITA, STRAIN_BASIS

Kind = Literal["V", "W", "X"]

HIGHEST_CLOSED_ORDER = 2
"""Up to which pairs are summed in closed form (Faxén); blocks of higher orders are stored."""


class Family(NamedTuple):
    """The 2n + 1 modes m = −n … n of one kind and degree n."""

    kind: Kind
    degree: int

    @property
    def rank(self) -> int:
        """Degree of the harmonics in the Cartesian components."""
        return self.degree + {"W": -1, "X": 0, "V": 1}[self.kind]

    @property
    def size(self) -> int:
        """Number of modes, 2n + 1."""
        return 2 * self.degree + 1

    @property
    def norm(self) -> float:
        """Root of ∫|ψ|² over the unit sphere before normalization."""
        n = self.degree
        return float(np.sqrt({"W": n * (2 * n + 1), "X": n * (n + 1), "V": (n + 1) * (2 * n + 1)}[self.kind]))

    @property
    def self_mobility(self) -> float:
        """Velocity on a unit sphere over the traction, both along this family (viscosity one)."""
        n = self.degree
        return {"W": (n + 1) / ((2 * n + 1) * (2 * n - 1)), "X": 1 / (2 * n + 1), "V": n / ((2 * n + 1) * (2 * n + 3))}[
            self.kind
        ]

    @property
    def components(self) -> FloatArray:
        """Cartesian components (3, 2l + 1, 2n + 1) of the normalized modes on the harmonics of degree l = rank."""
        n = self.degree
        if self.kind == "V":
            field = -(2 * n + 1) * raising(n)
        else:
            gradient = (2 * n + 1) * raising(n - 1).transpose(0, 2, 1)
            field = (
                gradient if self.kind == "W" else np.einsum("ijk,jab,kbc->iac", LEVI_CIVITA, raising(n - 1), gradient)
            )
        return field / self.norm


@dataclass(frozen=True)
class MultipoleBasis:
    """Modes of one sphere up to multipole order p, family after family in increasing rank.

    Within a rank the order is V, X, W; within a family m = −n … n. Order 2 is therefore W_1 (force), X_1 (torque),
    W_2 (stresslet).
    """

    order: int

    def __post_init__(self) -> None:
        _checks.whole_number("order", self.order, least=1)

    @cached_property
    def families(self) -> tuple[Family, ...]:
        """The families in their order."""
        by_rank = [(Family("V", rank - 1), Family("X", rank), Family("W", rank + 1)) for rank in range(self.order)]
        return tuple(family for families in by_rank for family in families if family.degree > 0)

    @cached_property
    def slices(self) -> tuple[slice, ...]:
        """Where each family stands among the modes."""
        ends = np.cumsum([family.size for family in self.families]).tolist()
        return tuple(slice(end - family.size, end) for family, end in zip(self.families, ends, strict=True))

    @property
    def size(self) -> int:
        """Number of modes M on a sphere: 3 for order 1, 3p² − 1 above."""
        return self.slices[-1].stop

    @cached_property
    def rank(self) -> IntArray:
        """Rank l of every mode, (M,)."""
        return _checks.frozen(np.concatenate([np.full(family.size, family.rank) for family in self.families]))

    @cached_property
    def self_mobility(self) -> FloatArray:
        """Diagonal (M,) of the mobility of one unit sphere."""
        return _checks.frozen(np.concatenate([np.full(f.size, f.self_mobility) for f in self.families]))

    @cached_property
    def elementary_projections(self) -> FloatArray:
        """Projections (11, M) of e_k, e_k × u and B_k·u on the modes: three streams, three rotations, five strains.

        The same matrix turns mode amplitudes into force, torque and stresslet of a unit sphere.
        """
        projection = np.zeros((11, self.size))
        for family, where in zip(self.families, self.slices, strict=True):
            if family.rank == 0:
                projection[:3, where] = np.sqrt(4 * np.pi) * family.components[:, 0]
            elif family.rank == 1:
                moment = np.sqrt(4 * np.pi / 3) * family.components[:, [2, 0, 1]]  # ∫ ψ_i u_j
                projection[3:6, where] = np.einsum("ikj,ijm->km", LEVI_CIVITA, moment)
                projection[6:, where] = np.einsum("kij,ijm->km", STRAIN_BASIS, moment)
        return _checks.frozen(projection)
