"""Failure by loads that act together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, load_ratios


@final
@dataclass(frozen=True)
class Combined(Criterion):
    """Tension, shear, bending and twisting use up the strength together: Σ r^p = 1 with r each load over its strength.

    p = 1 adds them up, as tension and bending add up in the outermost fibre of a solid bridge; p = 2 is the quadratic
    interaction of adhesive joints. Compression neither helps nor harms. Loads whose strength is infinite do not count.

    Parameters
    ----------
    exponent
        p, at least 1.
    """

    exponent: float = 2.0

    def __post_init__(self) -> None:
        exponent = _checks.positive("exponent", self.exponent)
        if exponent < 1:
            raise ValueError(f"exponent: expected a number of at least 1, got {exponent:g}")

    @property
    def strengths(self) -> tuple[str, ...]:
        """All four strengths."""
        return EVERY_LIMIT.strengths

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """(Σ r^p)^(1/p) (..., C), proportional to the loads."""
        ratios = np.maximum(load_ratios(loads, bonds), 0.0)
        largest = ratios.max(axis=-1)
        relative = ratios / np.where(largest > 0, largest, 1.0)[..., None]  # whose high powers do not vanish
        return largest * np.linalg.norm(relative, ord=self.exponent, axis=-1)
