"""A measured pull-off force over the stiffness of another law, or of bonds."""

import numpy as np
import pytest

import rheoclast as rc

TRIMER = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [3, 0, 0], [3, 6, 0]], [1.0, 2.0, 4.0]))
JKR = rc.JKR(rc.MATERIALS["polystyrene"], friction=0.2, rolling_distance=1e-9)
BONDS = rc.Bonds(normal=1.0, tangential=2.0, bending=3.0, twisting=4.0)


def test_force_is_that_of_the_measured_spheres_and_scales_with_the_reduced_radius():
    law = rc.MeasuredPullOff(6e-9, JKR, radius=2.0)  # reduced radius 1
    np.testing.assert_allclose(law.bonds(TRIMER).tensile_strength, [6e-9 * 2 / 3, 6e-9 * 4 / 3])
    np.testing.assert_array_equal(rc.MeasuredPullOff(6e-9, JKR).bonds(TRIMER).tensile_strength, [6e-9, 6e-9])


@pytest.mark.parametrize("stiffness", [JKR, BONDS], ids=["law", "bonds"])
def test_stiffness_is_that_of_the_law_or_the_bonds(stiffness):
    bonds = stiffness.bonds(TRIMER) if isinstance(stiffness, rc.ContactLaw) else stiffness
    measured = rc.MeasuredPullOff(6e-9, stiffness).bonds(TRIMER)
    np.testing.assert_array_equal(measured.stiffness(2), bonds.stiffness(2))


def test_other_limits_change_in_proportion():
    own, measured = JKR.bonds(TRIMER).strength(2), rc.MeasuredPullOff(6e-9, JKR).bonds(TRIMER).strength(2)
    np.testing.assert_allclose(measured / measured[:, :1], own / own[:, :1], rtol=1e-12)


def test_other_limits_stay_where_there_is_no_pull_off_force():
    """Some contacts with one, some without: neither makes a number that is none."""
    given = rc.Bonds(1.0, 1.0, 1.0, 1.0, tensile_strength=[np.inf, 2.0], shear_strength=[7.0, 8.0])
    measured = rc.MeasuredPullOff(6.0, given).bonds(TRIMER)
    np.testing.assert_allclose(measured.tensile_strength, 6.0)
    np.testing.assert_allclose(measured.shear_strength, [7.0, 24.0])
    assert np.isinf(measured.strength(2)[:, 2:]).all()


def test_refusals():
    for values, message in (
        ({"force": 0.0}, "force: expected a positive number, got 0"),
        ({"radius": -1.0}, "radius: expected a positive number, got -1"),
    ):
        with pytest.raises(ValueError, match=f"^{message}$"):
            rc.MeasuredPullOff(**{"force": 1.0, "stiffness": BONDS, **values})
    with pytest.raises(TypeError, match=r"^stiffness: expected ContactLaw, got float; for instance JKR\(material\)"):
        rc.MeasuredPullOff(1.0, 2.0)
    with pytest.raises(ValueError, match=r"expected one value or one per contact \(2\), got 3"):
        rc.MeasuredPullOff(1.0, rc.Bonds(1.0, 1.0, 1.0, 1.0, tensile_strength=[1.0, 2.0, 3.0])).bonds(TRIMER)
