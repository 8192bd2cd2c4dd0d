"""Failure by sliding."""

import numpy as np
import pytest

import rheoclast as rc

from .cases import loads, random_bonds, random_loads


def test_without_friction_shear_over_shear_strength():
    """Whatever its direction across the normal, under tension and compression alike."""
    bonds = rc.Bonds(1, 1, 1, 1, shear_strength=[2.0, 4.0, 5.0])
    for seed in range(3):
        carried = loads([9.0, -9.0, 9.0], [3.0, 3.0, 0.0], 9.0, -9.0, seed)
        np.testing.assert_allclose(rc.Sliding().load_ratio(carried, bonds), [1.5, 0.75, 0], atol=1e-14)


def test_friction_by_hand():
    """3 + 0.5 · 2 over 8; compression by 4 and by 8 takes off 2 and more than there is."""
    carried = loads([2.0, -4.0, -8.0], 3.0, 0.0, 0.0)
    bonds = rc.Bonds(1, 1, 1, 1, shear_strength=8.0)
    np.testing.assert_allclose(rc.Sliding(0.5).load_ratio(carried, bonds), [0.5, 1 / 8, 0], atol=1e-15)


@pytest.mark.parametrize("friction", [0.1, 0.6, 2.0])
@pytest.mark.parametrize("seed", range(3))
def test_slides_where_shear_reaches_the_limit_of_coulomb(friction, seed):
    """Loads times λ = 1 / ratio have shear = S − μ tension; where the ratio is zero none has, however large."""
    carried, bonds = random_loads(seed), random_bonds(seed)
    ratio = rc.Sliding(friction).load_ratio(carried, bonds)
    slides = ratio > 0
    assert slides.any()
    assert not slides.all()
    factor = 1 / ratio[slides]
    limit = bonds.shear_strength[slides] - friction * factor * carried.tension[slides]
    np.testing.assert_allclose(factor * carried.shear[slides], limit, rtol=1e-9, atol=1e-9)
    for large in (1.0, 1e6, 1e12):
        held = (
            large * carried.shear[~slides] < bonds.shear_strength[~slides] - friction * large * carried.tension[~slides]
        )
        assert held.all()


def test_refused_friction():
    with pytest.raises(ValueError, match=r"^friction: expected zero or a positive number, got -0.1$"):
        rc.Sliding(-0.1)
    with pytest.raises(ValueError, match=r"^friction: expected a number, got 'steel'$"):
        rc.Sliding("steel")
