"""Failure by tension."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import Criterion


@final
@dataclass(frozen=True)
class Tension(Criterion):
    """A contact is pulled off when its tension reaches `Bonds.tensile_strength`. Compression never fails it."""

    @property
    def strengths(self) -> tuple[str, ...]:
        """The tensile strength."""
        return ("tensile_strength",)

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Tension over tensile strength (..., C), negative in compression."""
        return loads.tension / bonds.tensile_strength
