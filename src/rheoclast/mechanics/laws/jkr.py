"""Johnson–Kendall–Roberts adhesion, for soft or strongly adhering spheres.

K. L. Johnson, K. Kendall & A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.material import Material
from rheoclast.particles.aggregate import Aggregate


@final
@dataclass(frozen=True)
class JKR(ContactLaw):
    """JKR contacts of one material, linearised at zero load; radii may differ (1/R* = 1/a_i + 1/a_j).

    With contact radius c³ = 9πWR*²/(2E*) at zero load:

    - tensile strength, the pull-off force (3/2)πWR*,
    - normal stiffness dP/dδ = (6/5)E*c at zero load (the Hertz value is 5/3 of it),
    - tangential stiffness 4Gc/(2 − ν) (Mindlin, no slip, equal materials),
    - bending stiffness (4/3)E*c³, that of two half-spaces joined on a disc (equal to 4 R* times the pull-off force),
    - twisting stiffness (8/3)Gc³, that of two half-spaces joined on a disc.

    and, where the further data that they need are given,

    - shear strength 2μF_c, with which sliding begins under no load, F_c the pull-off force (C. Thornton, J. Phys. D 24
      (1991) 1942),
    - twisting strength (3π/16)c times that, which turns a whole contact with Hertz's distribution of pressure,
    - bending strength 4F_cξ (C. Dominik & A. G. G. M. Tielens, Phil. Mag. A 72 (1995) 783, Astrophys. J. 480
      (1997) 647).

    Bending moments in aggregates are of the order of force times radius: with ξ of nanometres contacts roll long before
    they are pulled off.

    Parameters
    ----------
    material
        Of the spheres.
    friction
        Coefficient μ of sliding; None sets no limit to shear and twisting.
    rolling_distance
        Distance ξ in m by which a contact rolls before it yields, of the order of an atom to a few nanometres; None
        sets no limit to bending.
    """

    material: Material
    friction: float | None = None
    rolling_distance: float | None = None

    def __post_init__(self) -> None:
        for name in ("friction", "rolling_distance"):
            if getattr(self, name) is not None:
                _checks.positive(name, getattr(self, name))

    def contact_radius(self, reduced_radius: FloatArray) -> FloatArray:
        """Contact radius c at zero load in m, from R* in m."""
        material = self.material
        return np.cbrt(4.5 * np.pi * material.work_of_adhesion * reduced_radius**2 / material.contact_modulus)

    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds of all contacts, per contact."""
        material = self.material
        reduced_radius = 1 / (1 / aggregate.spheres.radii[aggregate.pairs]).sum(axis=1)
        radius = self.contact_radius(reduced_radius)
        pull_off = 1.5 * np.pi * material.work_of_adhesion * reduced_radius
        sliding = np.inf if self.friction is None else 2 * self.friction * pull_off
        rolling = np.inf if self.rolling_distance is None else 4 * self.rolling_distance * pull_off
        return Bonds(
            normal=1.2 * material.contact_modulus * radius,
            tangential=4 * material.shear_modulus * radius / (2 - material.poisson_ratio),
            bending=4 / 3 * material.contact_modulus * radius**3,
            twisting=8 / 3 * material.shear_modulus * radius**3,
            tensile_strength=pull_off,
            shear_strength=np.asarray(sliding),
            bending_strength=np.asarray(rolling),
            twisting_strength=3 * np.pi / 16 * radius * sliding,
        )


def jkr_bonds(
    aggregate: Aggregate, material: Material, friction: float | None = None, rolling_distance: float | None = None
) -> Bonds:
    """Bonds of an aggregate by the JKR law, see `JKR`."""
    return JKR(material, friction, rolling_distance).bonds(aggregate)
