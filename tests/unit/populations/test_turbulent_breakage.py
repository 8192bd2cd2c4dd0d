"""Kusters' law against its numbers, and the fit against laws with known scatter."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.populations.turbulent_breakage import (
    critical_dissipation,
    fitted_critical_dissipation,
    turbulent_breakage_rate,
)

WATER = 1e-6
DISSIPATIONS = np.geomspace(0.01, 10, 12)


def test_rate_by_hand():
    """At ε = ε_c = 1 m²/s³ in water: 1000/s · 0.29135 / e; far above, proportional to the square root."""
    assert turbulent_breakage_rate(1.0, WATER, 1.0) == pytest.approx(1000 * 0.291346 / 2.718282, rel=1e-5)
    high = turbulent_breakage_rate([1e12, 4e12], WATER, 1.0)
    assert high[1] / high[0] == pytest.approx(2, rel=1e-9)
    assert turbulent_breakage_rate(np.ones((2, 3)), WATER, 1.0).shape == (2, 3)


@pytest.mark.parametrize("flow", [rc.simple_shear(40.0), rc.uniaxial_extension(40.0), rc.planar_extension(40.0)])
def test_critical_dissipation_is_that_of_the_flow(flow):
    """Energy dissipated per mass and time is 2 ν E:E, which `GradientHistory.dissipation` averages."""
    steady = rc.GradientHistory([0.0, 1.0], [flow.gradient, flow.gradient])
    assert critical_dissipation(flow.magnitude, WATER) == pytest.approx(steady.dissipation(WATER), rel=1e-12)


def test_magnitudes_by_name():
    assert critical_dissipation(rc.simple_shear(2.0).magnitude, 3.0) == pytest.approx(3 * 4)
    assert critical_dissipation(rc.uniaxial_extension(2.0).magnitude, 3.0) == pytest.approx(3 * 3 * 4)
    assert critical_dissipation(rc.planar_extension(2.0).magnitude, 3.0) == pytest.approx(3 * 4 * 4)


def test_fit_restores_the_law():
    rates = turbulent_breakage_rate(DISSIPATIONS, WATER, 0.07)
    found = fitted_critical_dissipation(DISSIPATIONS, rates, WATER)
    assert found.value == pytest.approx(0.07, rel=1e-9)
    np.testing.assert_allclose(found.interval, 0.07, rtol=1e-6)


def test_interval_covers_as_often_as_it_says():
    rng = np.random.default_rng(5)
    covered = 0
    for _ in range(1000):
        rates = turbulent_breakage_rate(DISSIPATIONS, WATER, 0.07) * np.exp(0.4 * rng.normal(size=12))
        found = fitted_critical_dissipation(DISSIPATIONS, rates, WATER, confidence=0.9)
        covered += found.interval[0] < 0.07 < found.interval[1]
    assert covered / 1000 == pytest.approx(0.9, abs=0.03)


def test_refused():
    with pytest.raises(ValueError, match="dissipations: expected at least 2, got 1; measure at more"):
        fitted_critical_dissipation([1.0], [1.0], WATER)
    with pytest.raises(ValueError, match=r"rates\[1\]: expected a positive number, got 0"):
        fitted_critical_dissipation([1.0, 2.0], [1.0, 0.0], WATER)
    with pytest.raises(ValueError, match=r"got up to 3.43 times that; fit a power law instead"):
        fitted_critical_dissipation([1.0, 4.0], [1000.0, 2000.0], WATER)
    with pytest.raises(ValueError, match="kinematic_viscosity: expected a positive number, got 0"):
        turbulent_breakage_rate(1.0, 0.0, 1.0)
    with pytest.raises(ValueError, match="magnitude: expected a positive number, got -1"):
        critical_dissipation(-1.0, WATER)
