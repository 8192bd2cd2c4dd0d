"""Johnson–Kendall–Roberts adhesion, for soft or strongly adhering spheres.

K. L. Johnson, K. Kendall & A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

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

    Only the tensile strength is limited: sliding, rolling and twisting limits need further data.
    """

    material: Material

    def contact_radius(self, reduced_radius: FloatArray) -> FloatArray:
        """Contact radius c at zero load in m, from R* in m."""
        material = self.material
        return np.cbrt(4.5 * np.pi * material.work_of_adhesion * reduced_radius**2 / material.contact_modulus)

    def bonds(self, aggregate: Aggregate) -> Bonds:
        """Bonds of all contacts, per contact."""
        material = self.material
        reduced_radius = 1 / (1 / aggregate.spheres.radii[aggregate.pairs]).sum(axis=1)
        radius = self.contact_radius(reduced_radius)
        return Bonds(
            normal=1.2 * material.contact_modulus * radius,
            tangential=4 * material.shear_modulus * radius / (2 - material.poisson_ratio),
            bending=4 / 3 * material.contact_modulus * radius**3,
            twisting=8 / 3 * material.shear_modulus * radius**3,
            tensile_strength=1.5 * np.pi * material.work_of_adhesion * reduced_radius,
        )


def jkr_bonds(aggregate: Aggregate, material: Material) -> Bonds:
    """Bonds of an aggregate by the JKR law, see `JKR`."""
    return JKR(material).bonds(aggregate)
