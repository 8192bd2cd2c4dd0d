"""Failure by whichever of several criteria is met first."""

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
@dataclass(frozen=True, init=False)
class AnyOf(Criterion):
    """A contact fails by the first of several criteria that is met. ``Tension() | Sliding()`` makes the same.

    Raises
    ------
    ValueError
        If there is no criterion.
    TypeError
        If something is not a criterion.
    """

    criteria: tuple[Criterion, ...]

    def __init__(self, *criteria: Criterion) -> None:
        if not criteria:
            raise ValueError("AnyOf: expected at least one criterion, got none; give for instance Tension()")
        for criterion in criteria:
            _checks.instance("AnyOf", criterion, Criterion, "for instance Tension()")
        object.__setattr__(self, "criteria", tuple(part for criterion in criteria for part in criterion.parts))

    @property
    def name(self) -> str:
        """The names of all."""
        return " or ".join(part.name for part in self.parts)

    @property
    def parts(self) -> tuple[Criterion, ...]:
        """The criteria."""
        return self.criteria

    @property
    def strengths(self) -> tuple[str, ...]:
        """The strengths that any of them uses."""
        return tuple(dict.fromkeys(strength for part in self.parts for strength in part.strengths))

    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """The largest ratio (..., C)."""
        return np.max([part.load_ratio(loads, bonds) for part in self.parts], axis=0)
