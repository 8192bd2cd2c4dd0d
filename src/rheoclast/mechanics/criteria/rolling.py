"""Failure by rolling."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import Criterion


@final
@dataclass(frozen=True)
class Rolling(Criterion):
    """A contact rolls when its bending moment reaches `Bonds.bending_strength`."""

    @property
    def strengths(self) -> tuple[str, ...]:
        """The bending strength."""
        return ("bending_strength",)

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Bending moment over bending strength (..., C)."""
        return loads.bending / bonds.bending_strength
