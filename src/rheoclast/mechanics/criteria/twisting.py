"""Failure by twisting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import Criterion


@final
@dataclass(frozen=True)
class Twisting(Criterion):
    """A contact twists off when the moment about its normal, either way, reaches `Bonds.twisting_strength`."""

    @property
    def strengths(self) -> tuple[str, ...]:
        """The twisting strength."""
        return ("twisting_strength",)

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Size of the twisting moment over twisting strength (..., C)."""
        return np.abs(loads.twisting) / bonds.twisting_strength
