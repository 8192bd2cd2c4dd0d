"""Power laws with known exponent, prefactor and scatter."""

import numpy as np
import pytest

from rheoclast.populations.power_law import power_law

PLACES = np.geomspace(0.01, 50, 15)


def test_exact_law():
    law = power_law(PLACES, 0.3 * PLACES**-2.5)
    assert law.exponent == pytest.approx(-2.5, rel=1e-12)
    assert law.prefactor == pytest.approx(0.3, rel=1e-12)
    np.testing.assert_allclose([*law.exponent_interval, *law.prefactor_interval], [-2.5, -2.5, 0.3, 0.3], rtol=1e-9)
    np.testing.assert_allclose(law([[1.0, 4.0]]), [[0.3, 0.3 / 32]], rtol=1e-9)


def test_intervals_cover_as_often_as_they_say():
    rng = np.random.default_rng(2)
    exponents = prefactors = 0
    for _ in range(1000):
        law = power_law(PLACES, 7.0 * PLACES**0.4 * np.exp(0.5 * rng.normal(size=len(PLACES))))
        exponents += law.exponent_interval[0] < 0.4 < law.exponent_interval[1]
        prefactors += law.prefactor_interval[0] < 7.0 < law.prefactor_interval[1]
    assert exponents / 1000 == pytest.approx(0.95, abs=0.02)
    assert prefactors / 1000 == pytest.approx(0.95, abs=0.02)


def test_units_change_the_prefactor_only():
    measured = 2 * PLACES**1.7 * np.linspace(0.9, 1.1, 15)
    metres, microns = power_law(PLACES, measured), power_law(1e6 * PLACES, measured)
    assert metres.exponent == pytest.approx(microns.exponent, rel=1e-10)
    assert metres.exponent_interval == pytest.approx(microns.exponent_interval, rel=1e-8)
    assert microns(2e6) == pytest.approx(metres(2.0), rel=1e-9)


def test_refused():
    with pytest.raises(ValueError, match="x: expected at least 3 points, got 2; measure at more places"):
        power_law([1, 2], [1, 2])
    with pytest.raises(ValueError, match=r"x: expected several places, got 3 times 2; measure at other places"):
        power_law([2, 2, 2], [1, 2, 3])
    with pytest.raises(ValueError, match=r"y\[1\]: expected a positive number, got 0"):
        power_law([1, 2, 3], [1, 0, 3])
    with pytest.raises(ValueError, match=r"y: expected shape \(3,\), got \(2,\)"):
        power_law([1, 2, 3], [1, 3])
    with pytest.raises(ValueError, match="confidence: expected a share between 0 and 1, got 1"):
        power_law([1, 2, 3], [1, 3, 4], confidence=1)
