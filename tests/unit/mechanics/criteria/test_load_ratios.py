"""Load ratios of a contact by each criterion that counts."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.mechanics.criteria.load_ratios import limited_parts, refuse_without_strength

from .cases import loads, random_bonds, random_loads


def test_every_limit_by_hand():
    """Tension 1, shear 2, bending 3, twisting −4; then compressed and twisted the other way."""
    carried = loads([1.0, -1.0], 2.0, 3.0, [-4.0, 4.0])
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=10, shear_strength=20, bending_strength=5, twisting_strength=[8, 16])
    np.testing.assert_allclose(rc.load_ratios(carried, bonds), [[0.1, 0.1, 0.6, 0.5], [-0.1, 0.1, 0.6, 0.25]])


def test_one_column_for_each_part_in_its_order():
    carried, bonds = random_loads(1, (2, 20)), random_bonds(1)
    criterion = rc.Combined(1) | rc.Tension() | rc.Sliding(0.3)
    ratios = rc.load_ratios(carried, bonds, criterion=criterion)
    assert ratios.shape == (2, 20, 3)
    for column, part in enumerate(criterion.parts):
        np.testing.assert_array_equal(ratios[..., column], part.load_ratio(carried, bonds))
    np.testing.assert_array_equal(ratios.max(axis=-1), criterion.load_ratio(carried, bonds))


def test_one_column_for_a_single_criterion():
    assert rc.load_ratios(random_loads(1), random_bonds(1), criterion=rc.Rolling()).shape == (20, 1)


def test_refused_bonds_and_criteria():
    with pytest.raises(
        ValueError, match=r"^bonds.tensile_strength: expected one value or one per contact \(20\), got 3"
    ):
        rc.load_ratios(random_loads(1), random_bonds(1, 3))
    for wrong, name in ((rc.Tension, "the class Tension"), ("tension", "str"), (None, "NoneType")):
        with pytest.raises(TypeError, match=rf"^criterion: expected Criterion, got {name}; for instance Tension\(\)$"):
            rc.load_ratios(random_loads(1), random_bonds(1), criterion=wrong)


def test_parts_that_have_a_limit():
    bonds = rc.Bonds(1, 1, 1, 1, shear_strength=[np.inf, 3.0], twisting_strength=2.0)
    np.testing.assert_array_equal(limited_parts(bonds, rc.EVERY_LIMIT), [1, 3])
    np.testing.assert_array_equal(limited_parts(bonds, rc.Rolling() | rc.Combined()), [1])
    assert len(limited_parts(bonds, rc.Tension())) == 0


def test_bonds_without_a_strength_that_the_criterion_uses():
    """One contact that can fail is enough."""
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=2.0, shear_strength=[np.inf, 3.0])
    for criterion in (rc.Tension(), rc.Sliding(0.1), rc.Combined(), rc.EVERY_LIMIT, rc.Rolling() | rc.Sliding()):
        refuse_without_strength(bonds, criterion)
    message = "bonds: expected a strength of some contact for failure by {}, got none; give for instance {}$"
    with pytest.raises(ValueError, match=message.format("rolling", "bending_strength")):
        refuse_without_strength(bonds, rc.Rolling())
    with pytest.raises(ValueError, match=message.format("twisting or rolling", "twisting_strength")):
        refuse_without_strength(bonds, rc.Twisting() | rc.Rolling())
