"""The interface of every failure criterion."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads

if TYPE_CHECKING:
    from rheoclast.mechanics.criteria.any_of import AnyOf


class Criterion(ABC):
    """When a contact fails: where its load ratio reaches one.

    A load ratio must be proportional to the loads. The rate at which a contact fails is then the rate of the flow over
    the ratio. Combine criteria with ``|``: a contact then fails by the first that is met.
    """

    @property
    def name(self) -> str:
        """What a failure by this criterion is called."""
        return type(self).__name__.lower()

    @property
    def parts(self) -> tuple[Criterion, ...]:
        """The criteria that this one is made of; itself if it is not a combination."""
        return (self,)

    @property
    @abstractmethod
    def strengths(self) -> tuple[str, ...]:
        """Names of the strengths of `Bonds` that it uses. Where all are infinite the criterion is off."""

    @abstractmethod
    def load_ratio(self, loads: ContactLoads, bonds: Bonds) -> FloatArray:
        """Load over strength (..., C): 1 at failure, zero or negative where no rate makes the contact fail."""

    def __or__(self, other: Criterion) -> AnyOf:
        """The criterion that is met where this one or the other is."""
        from rheoclast.mechanics.criteria.any_of import AnyOf

        if not isinstance(other, Criterion):
            return NotImplemented
        return AnyOf(*self.parts, *other.parts)
