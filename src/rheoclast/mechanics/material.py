"""Elastic and adhesive properties of the particles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from rheoclast import _checks


@dataclass(frozen=True)
class Material:
    """An isotropic elastic solid that adheres to itself.

    Parameters
    ----------
    youngs_modulus
        E in Pa.
    poisson_ratio
        ν, above −1 and at most 0.5.
    work_of_adhesion
        W in J/m², twice the surface energy: the work that separates unit area of contact, in the liquid.
    """

    youngs_modulus: float
    poisson_ratio: float
    work_of_adhesion: float

    def __post_init__(self) -> None:
        _checks.positive("youngs_modulus", self.youngs_modulus)
        _checks.positive("work_of_adhesion", self.work_of_adhesion)
        ratio = float(_checks.real_array("poisson_ratio", self.poisson_ratio, ()))
        if not -1 < ratio <= 0.5:
            raise ValueError(f"poisson_ratio: expected a number above -1 and at most 0.5, got {ratio:g}")

    @property
    def shear_modulus(self) -> float:
        """G = E / 2(1 + ν) in Pa."""
        return self.youngs_modulus / (2 * (1 + self.poisson_ratio))

    @property
    def contact_modulus(self) -> float:
        """E* of two bodies of this material, 1/E* = 2(1 − ν²)/E, in Pa."""
        return self.youngs_modulus / (2 * (1 - self.poisson_ratio**2))


MATERIALS: Mapping[str, Material] = MappingProxyType(
    {"polystyrene": Material(youngs_modulus=3.4e9, poisson_ratio=0.33, work_of_adhesion=0.02)}
)
"""Materials by name, for water at rest.

The elastic constants are those of the bulk. The work of adhesion is an order of magnitude: van der Waals attraction
A/(12πD²) across water with the Hamaker constant A = 0.9·10⁻²⁰ J (P. Walstra, Physical Chemistry of Foods, table 12.2)
and contact distance D = 0.165 nm gives 0.009 J/m², and surface charge, roughness and surfactant change it severalfold.
Critical rates are proportional to it: measure the pull-off force where the number matters.
"""
