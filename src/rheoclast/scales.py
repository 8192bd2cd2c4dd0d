"""Where units enter and leave: dimensionless inside, SI outside.

Inside, lengths are in mean sphere radii a, viscosity and velocity-gradient are one. The unit of force is then μ G a²,
of torque and stresslet μ G a³, with G one unit of strain rate.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass

from rheoclast._checks import FloatArray
from rheoclast.errors import UnitWarning

USUAL_RADII = 1e-10, 1e-3  # m; atoms are below
LARGEST_USUAL_VISCOSITY = 1e3  # Pa s


@dataclass(frozen=True)
class Scales:
    """Length (m) and viscosity (Pa s) that make a hydrodynamic problem dimensionless, per unit strain rate."""

    length: float
    viscosity: float

    @property
    def force(self) -> float:
        """Force per unit strain rate, μ a² (N s)."""
        return self.viscosity * self.length**2

    @property
    def torque(self) -> float:
        """Torque, and stresslet, per unit strain rate, μ a³ (N m s)."""
        return self.viscosity * self.length**3


def warn_of_radii(radii: FloatArray) -> None:
    """Warn when a radius exceeds 1 mm or is below 0.1 nm: the unit of length is probably wrong."""
    smallest, largest = USUAL_RADII
    if radii.max() > largest:
        found = f"radii up to {radii.max():.3g} m exceed 1 mm"
    elif radii.min() < smallest:
        found = f"radii down to {radii.min():.3g} m are below 0.1 nm"
    else:
        return
    advice = "give it when reading (unit='nm'), or set viscosity=1 for dimensionless work"
    warnings.warn(f"{found}: is the unit of length right? If not, {advice}", UnitWarning, stacklevel=3)


def warn_of_viscosity(viscosity: float) -> None:
    """Warn when a viscosity exceeds 10³ Pa s: water has 10⁻³, so mPa s were probably meant."""
    if viscosity > LARGEST_USUAL_VISCOSITY:
        warnings.warn(
            f"viscosity {viscosity:.3g} Pa s exceeds 1000 Pa s: is it in Pa s? (water: 1e-3)",
            UnitWarning,
            stacklevel=3,
        )
