"""The interface of every failure criterion, and failure by whichever of several is met first."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections import Counter
from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads

BETWEEN_WORDS = re.compile("(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


class Criterion(ABC):
    """When a contact fails: where its load ratio reaches one.

    A load ratio must be proportional to the loads. The rate at which a contact fails is then the rate of the flow over
    the ratio. Combine criteria with ``|``: a contact then fails by the first that is met.
    """

    @property
    def name(self) -> str:
        """What a failure by this criterion is called: its class in words, "neck stress" for ``NeckStress``."""
        return BETWEEN_WORDS.sub(" ", type(self).__name__).lower()

    @property
    def parts(self) -> tuple[Criterion, ...]:
        """The criteria that this one is made of; itself if it is not a combination."""
        return (self,)

    @property
    def part_names(self) -> tuple[str, ...]:
        """What a failure by each of `parts` is called; equal names are numbered, "sliding 1" and "sliding 2"."""
        names = [part.name for part in self.parts]
        counts = Counter(names)
        return tuple(
            name if counts[name] == 1 else f"{name} {names[: k + 1].count(name)}" for k, name in enumerate(names)
        )

    @property
    @abstractmethod
    def strengths(self) -> tuple[str, ...]:
        """Names of the strengths of `Bonds` that it uses. Where all are infinite the criterion is off."""

    @abstractmethod
    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Load over strength (..., C): 1 at failure, zero or negative where no rate makes the contact fail."""

    def __or__(self, other: Criterion) -> AnyOf:
        """The criterion that is met where this one or the other is."""
        return AnyOf(self, other) if isinstance(other, Criterion) else NotImplemented


@final
@dataclass(frozen=True, init=False, repr=False)
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
            _checks.instance("AnyOf", criterion, Criterion)
        _checks.set_fields(self, criteria=tuple(part for criterion in criteria for part in criterion.parts))

    def __repr__(self) -> str:
        return f"AnyOf({', '.join(map(repr, self.criteria))})"

    @property
    def name(self) -> str:
        """The names of all."""
        return " or ".join(self.part_names)

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
