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
        The law, or the bonds, that give the stiffness. Where they limit other loads too, these limits change in
        proportion to the pull-off force; where they have no pull-off force of their own, these limits stay.
    radius
        Radius in m of the two spheres of the measurement. Without it every contact gets the same force.

    Raises
    ------
    ValueError
        If force or radius is not positive.
    TypeError
        If the stiffness is neither a law nor bonds.
    """

    force: float
    stiffness: ContactLaw | Bonds
    radius: float | None = None

    def __post_init__(self) -> None:
        _checks.positive("force", self.force)
        if not isinstance(self.stiffness, Bonds):
            _checks.instance("stiffness", self.stiffness, ContactLaw, "for instance JKR(material), or Bonds")
        if self.radius is not None:
            _checks.positive("radius", self.radius)

    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds of all contacts, per contact."""
        strength = np.full(len(aggregate.pairs), self.force)
        if self.radius is not None:
            strength *= 2 / (self.radius / aggregate.spheres.radii[aggregate.pairs]).sum(axis=1)
        bonds = self.stiffness if isinstance(self.stiffness, Bonds) else self.stiffness.bonds(aggregate)
        own = bonds.strength(len(aggregate.pairs))[:, 0]
        share = np.where(np.isfinite(own), strength / own, 1.0)
        others = {name: share * getattr(bonds, name) for name in PROPORTIONAL}
        return replace(bonds, tensile_strength=strength, **others)
