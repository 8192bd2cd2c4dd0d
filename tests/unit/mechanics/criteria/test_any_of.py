"""Failure by whichever of several criteria is met first."""

import numpy as np
import pytest

import rheoclast as rc

from .cases import loads, random_bonds, random_loads


def test_largest_ratio_of_all():
    """Ratios 1.5 and ½, then −1.5 and ½."""
    carried = loads([3.0, -3.0], 2.0, 9.0, 9.0)
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=2.0, shear_strength=4.0)
    np.testing.assert_allclose(rc.AnyOf(rc.Tension(), rc.Sliding()).load_ratio(carried, bonds), [1.5, 0.5])


def test_order_and_repetition_do_not_matter():
    carried, bonds = random_loads(1), random_bonds(1)
    expected = rc.AnyOf(rc.Tension(), rc.Rolling()).load_ratio(carried, bonds)
    for other in (rc.AnyOf(rc.Rolling(), rc.Tension()), rc.AnyOf(rc.Tension(), rc.Rolling(), rc.Tension())):
        np.testing.assert_array_equal(other.load_ratio(carried, bonds), expected)


def test_alternatives_of_alternatives_are_one_list():
    """With the strengths of all, each named once."""
    nested = rc.AnyOf(rc.AnyOf(rc.Rolling(), rc.Combined()), rc.Sliding(0.1))
    assert nested.parts == nested.criteria == (rc.Rolling(), rc.Combined(), rc.Sliding(0.1))
    assert nested.strengths == ("bending_strength", "tensile_strength", "shear_strength", "twisting_strength")
    assert nested.name == "rolling or combined or sliding"


def test_one_alternative_is_that_criterion():
    carried, bonds = random_loads(2), random_bonds(2)
    np.testing.assert_array_equal(
        rc.AnyOf(rc.Twisting()).load_ratio(carried, bonds), rc.Twisting().load_ratio(carried, bonds)
    )


def test_refused_alternatives():
    with pytest.raises(ValueError, match=r"^AnyOf: expected at least one criterion, got none; give for instance Ten"):
        rc.AnyOf()
    with pytest.raises(TypeError, match=r"^AnyOf: expected Criterion, got the class Tension; for instance Tension\(\)"):
        rc.AnyOf(rc.Tension)
    with pytest.raises(TypeError, match=r"^AnyOf: expected Criterion, got str; for instance Tension\(\)$"):
        rc.AnyOf(rc.Tension(), "sliding")
