"""Bonds of some contacts, and with strengths that scatter."""

import numpy as np
import pytest

import rheoclast as rc

BONDS = rc.Bonds(1.0, 2.0, 3.0, 4.0, tensile_strength=[1.0, 2.0, 3.0], shear_strength=5.0)


def test_chosen_contacts():
    chosen = BONDS.chosen(np.array([2, 0]))
    np.testing.assert_array_equal(chosen.strength(2), [[3, 5, np.inf, np.inf], [1, 5, np.inf, np.inf]])
    np.testing.assert_array_equal(chosen.stiffness(2), [[1, 2, 3, 4]] * 2)
    np.testing.assert_array_equal(BONDS.chosen(np.array([False, True, False])).tensile_strength, [2])


def test_scatter_multiplies_all_strengths_of_a_contact_alike():
    scattered = BONDS.scattered(3, modulus=2.0, seed=1)
    factor = scattered.strength(3)[:, :2] / BONDS.strength(3)[:, :2]
    np.testing.assert_allclose(factor[:, 0], factor[:, 1])
    assert len(np.unique(factor[:, 0])) == 3
    assert np.isinf(scattered.strength(3)[:, 2:]).all()
    np.testing.assert_array_equal(scattered.stiffness(3), BONDS.stiffness(3))
    np.testing.assert_array_equal(scattered.tensile_strength, BONDS.scattered(3, 2.0, seed=1).tensile_strength)
    assert (scattered.tensile_strength != BONDS.scattered(3, 2.0, seed=2).tensile_strength).all()


@pytest.mark.parametrize("modulus", [1.0, 2.5, 12.0])
def test_scatter_is_a_weibull_distribution_of_mean_one(modulus):
    """ln(−ln(survival)) = m ln x + const; mean and median within five standard errors of 40 000 draws."""
    from math import gamma, log

    x = rc.Bonds(1, 1, 1, 1, tensile_strength=1.0).scattered(40_000, modulus, seed=3).tensile_strength
    scale = 1 / gamma(1 + 1 / modulus)
    spread = scale * np.sqrt(gamma(1 + 2 / modulus) - gamma(1 + 1 / modulus) ** 2)
    assert abs(x.mean() - 1) < 5 * spread / 200
    for share in (0.1, 0.5, 0.9):
        quantile = scale * (-log(1 - share)) ** (1 / modulus)
        assert abs((x < quantile).mean() - share) < 5 * np.sqrt(share * (1 - share)) / 200


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan])
@pytest.mark.parametrize("name", ["tensile_strength", "shear_strength", "bending_strength", "twisting_strength"])
def test_strengths_are_positive(name, value):
    with pytest.raises(ValueError, match=rf"^{name}"):
        rc.Bonds(1, 1, 1, 1, **{name: value})


def test_modulus_of_the_scatter_is_positive():
    with pytest.raises(ValueError, match="modulus: expected a positive number, got 0"):
        BONDS.scattered(3, 0.0, seed=1)
