"""Failure by loads that act together."""

import numpy as np
import pytest

import rheoclast as rc

from .cases import loads, random_bonds, random_loads, times

BONDS = rc.Bonds(1, 1, 1, 1, 2.0, 4.0, 5.0, 8.0)


@pytest.mark.parametrize(("exponent", "expected"), [(1, 2.0), (2, np.sqrt(1.5)), (3, 1.25 ** (1 / 3))])
def test_by_hand(exponent, expected):
    """Ratios 1, ½, 0 and ½."""
    carried = loads(2.0, 2.0, 0.0, -4.0)
    assert rc.Combined(exponent).load_ratio(carried, BONDS)[0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("exponent", [1, 1.5, 2, 8])
def test_shares_of_the_strength_add_up_to_one_at_failure(exponent):
    carried, bonds = random_loads(3), random_bonds(3)
    ratio = rc.Combined(exponent).load_ratio(carried, bonds)
    parts = np.stack([carried.tension, carried.shear, carried.bending, np.abs(carried.twisting)]) / ratio
    shares = np.maximum(parts / bonds.strength(20).T, 0) ** exponent
    np.testing.assert_allclose(shares.sum(axis=0), 1, rtol=1e-12)


def test_compression_neither_helps_nor_harms():
    compressed, without = (loads(tension, 2.0, 1.0, -4.0) for tension in (-50.0, 0.0))
    for exponent in (1, 2):
        criterion = rc.Combined(exponent)
        np.testing.assert_allclose(
            criterion.load_ratio(compressed, BONDS), criterion.load_ratio(without, BONDS), rtol=1e-12
        )


def test_loads_without_a_limit_do_not_count():
    carried, bonds = random_loads(6), random_bonds(6)
    alone = rc.Bonds(1, 1, 1, 1, bending_strength=bonds.bending_strength)
    expected = rc.Rolling().load_ratio(carried, bonds)
    np.testing.assert_allclose(rc.Combined(2).load_ratio(carried, alone), expected, rtol=1e-14)


def test_weaker_than_each_alone_and_the_more_so_the_lower_the_exponent():
    carried, bonds = random_loads(7), random_bonds(7)
    ratios = [rc.Combined(exponent).load_ratio(carried, bonds) for exponent in (1, 1.2, 2, 5, 20)]
    ratios.append(rc.EVERY_LIMIT.load_ratio(carried, bonds))
    assert (np.diff(ratios, axis=0) <= 1e-12 * ratios[0]).all()
    assert (ratios[0] > ratios[-1]).any()


def test_large_exponents_do_not_underflow():
    """Loads of a slow flow are a small share of the strength: 1e-6 to the power of 60 is not zero."""
    carried, bonds = random_loads(8), random_bonds(8)
    criterion = rc.Combined(60)
    np.testing.assert_allclose(
        criterion.load_ratio(times(1e-8, carried), bonds), 1e-8 * criterion.load_ratio(carried, bonds), rtol=1e-12
    )


@pytest.mark.parametrize(
    ("exponent", "message"),
    [
        (0.5, r"^exponent: expected a number of at least 1, got 0.5$"),
        (0, r"^exponent: expected a positive number, got 0$"),
        (np.inf, r"^exponent: expected a finite number, got inf$"),
    ],
)
def test_refused_exponents(exponent, message):
    with pytest.raises(ValueError, match=message):
        rc.Combined(exponent)
