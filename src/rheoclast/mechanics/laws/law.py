"""The interface of every contact law."""

from __future__ import annotations

from abc import ABC, abstractmethod

from rheoclast.mechanics.bonds import Bonds
from rheoclast.particles.aggregate import Aggregate


class ContactLaw(ABC):
    """Gives stiffness and strength of every contact, linearised about the unloaded state."""

    @abstractmethod
    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds of all contacts of an aggregate."""
