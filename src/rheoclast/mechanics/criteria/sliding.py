"""Failure by sliding."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import Criterion


@final
@dataclass(frozen=True)
class Sliding(Criterion):
    """A contact slides when the force across its normal reaches a limit that falls with the tension t.

    The limit is S − μ t with the shear strength S of a contact without normal load and the friction coefficient μ
    (Coulomb). With adhesion S = 2 μ F_c, F_c the pull-off force (J. S. Marshall, J. Comput. Phys. 228 (2009) 1541).

    Parameters
    ----------
    friction
        Coefficient μ; zero leaves the strength the same under tension and compression.
    """

    friction: float = 0.0

    def __post_init__(self) -> None:
        _checks.not_negative("friction", self.friction)

    @property
    def strengths(self) -> tuple[str, ...]:
        """The shear strength."""
        return ("shear_strength",)

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Shear plus μ times tension, over shear strength (..., C); zero where compression holds the contact."""
        return np.maximum(loads.shear + self.friction * loads.tension, 0.0) / bonds.shear_strength
