"""A measured pull-off force, with the stiffness of another law."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.particles.aggregate import Aggregate

PROPORTIONAL = ("shear_strength", "bending_strength", "twisting_strength")


@final
@dataclass(frozen=True)
class MeasuredPullOff(ContactLaw):
    """Pull-off force as measured, for instance by atomic force microscopy.

    Parameters
    ----------
    force
        Pull-off force in N of two spheres of radius `radius`; contacts of other spheres scale with R*.
    stiffness
        The law that gives the stiffness. Where it limits other loads too, these limits are changed in proportion.
    radius
        Radius in m of the two spheres of the measurement. Without it every contact gets the same force.
    """

    force: float
    stiffness: ContactLaw
    radius: float | None = None

    def __post_init__(self) -> None:
        _checks.positive("force", self.force)
        _checks.instance("stiffness", self.stiffness, ContactLaw, "for instance JKR(material)")
        if self.radius is not None:
            _checks.positive("radius", self.radius)

    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds of all contacts, per contact."""
        strength = np.full(len(aggregate.pairs), self.force)
        if self.radius is not None:
            strength *= 2 / (self.radius / aggregate.spheres.radii[aggregate.pairs]).sum(axis=1)
        bonds = self.stiffness.bonds(aggregate)
        share = strength / bonds.tensile_strength
        others = {name: share * getattr(bonds, name) for name in PROPORTIONAL}
        return replace(bonds, tensile_strength=strength, **others)
