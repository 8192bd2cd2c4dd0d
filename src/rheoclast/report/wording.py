"""Numbers and flows in words, as the page shows them."""

from __future__ import annotations

import numpy as np

from rheoclast.flows import LinearFlow
from rheoclast.view.quantities import minus, quoted

SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
PREFIXED = ("m", "N", "N m")
ALIKE = 1e-6  # share of the magnitude by which rates of one flow may differ


def written(value: float, unit: str = "", digits: int = 4) -> str:
    """A number and its unit, such as "1.316 × 10⁵ 1/s" and "17.9 nN"."""
    if unit in PREFIXED:
        return quoted(value, unit)
    mantissa, _, exponent = f"{value:.{digits}g}".partition("e")
    power = f" × 10{str(int(exponent)).translate(SUPERSCRIPTS)}" if exponent else ""
    return f"{minus(mantissa)}{power} {unit}".rstrip()


def percent(share: float) -> str:
    """A share such as 0.0297 as "3.0 %"."""
    return f"{100 * share:.2g} %"


def flow_name(flow: LinearFlow) -> str:
    """What kind of flow a gradient is, in any orientation.

    A shear Γ = γ a⊗b, a ⊥ b, is known by Γ·Γ = 0; extensions have no spin, and are told by their principal rates.
    """
    size = flow.magnitude
    if size == 0:
        return "rotation" if np.any(flow.gradient) else "liquid at rest"
    if np.abs(flow.gradient @ flow.gradient).max() < ALIKE * size**2:
        return "simple shear"
    if np.abs(flow.angular_velocity).max() > ALIKE * size:
        return "linear flow"
    first, second, third = flow.principal_rates
    kinds = {"uniaxial": second - third, "biaxial": first - second, "planar": second}
    return next((f"{kind} extension" for kind, rate in kinds.items() if abs(rate) < ALIKE * size), "pure strain")
