"""Scales by definition, and warnings of values in the wrong unit."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.scales import Scales, warn_of_radii, warn_of_viscosity


def test_scales_change_with_units_like_forces_and_torques():
    """μ a² and μ a³ by definition; counted in half metres the force per rate stays and the torque doubles."""
    si, half_metres = Scales(length=2e-6, viscosity=1e-3), Scales(length=4e-6, viscosity=1e-3 / 4)
    assert si.force == pytest.approx(4e-15, rel=1e-15)
    assert si.torque == pytest.approx(8e-21, rel=1e-15)
    assert half_metres.force == pytest.approx(si.force, rel=1e-15)
    assert half_metres.torque == pytest.approx(2 * si.torque, rel=1e-15)


def test_usual_colloids_pass_silently():
    """No warning up to 1 mm and 1000 Pa s (warnings are errors here)."""
    warn_of_radii(np.array([1e-10, 1e-3]))
    warn_of_viscosity(1e-3)
    warn_of_viscosity(1e3)


def test_large_radii_warn():
    """The largest radius is quoted, and the ways out are named."""
    with pytest.warns(
        rc.UnitWarning,
        match=r"^radii up to 0\.002 m exceed 1 mm: is the unit of length right\? "
        r"If not, give it when reading \(unit='nm'\), or set viscosity=1 for dimensionless work$",
    ):
        warn_of_radii(np.array([1e-6, 2e-3]))


def test_radii_below_atoms_warn():
    with pytest.warns(rc.UnitWarning, match=r"^radii down to 5e-13 m are below 0\.1 nm: is the unit of length right\?"):
        warn_of_radii(np.array([5e-13, 1e-6]))


def test_large_viscosity_warns():
    """Millipascal seconds given as pascal seconds are noticed."""
    with pytest.warns(
        rc.UnitWarning, match=r"^viscosity 1e\+06 Pa s exceeds 1000 Pa s: is it in Pa s\? \(water: 1e-3\)$"
    ):
        warn_of_viscosity(1e6)
