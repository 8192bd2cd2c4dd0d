"""The same, explicitly given bond at every contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from rheoclast import _checks
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.particles.aggregate import Aggregate


@final
@dataclass(frozen=True)
class Uniform(ContactLaw):
    """Explicit stiffness and pull-off force, the same at every contact.

    Parameters
    ----------
    normal, tangential
        Stiffness in N/m.
    bending, twisting
        Stiffness in N m/rad.
    tensile_strength
        Pull-off force in N.
    """

    normal: float
    tangential: float
    bending: float
    twisting: float
    tensile_strength: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            _checks.positive(name, value)

    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds that hold for any number of contacts."""
        return Bonds(**vars(self))
