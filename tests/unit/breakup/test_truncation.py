"""The error of a critical rate, from its definition. Errors of loads: tests/agreement/test_orders.py."""

from dataclasses import replace

import numpy as np
import pytest

import rheoclast as rc

FLOC = rc.generation.random_packed_ball(8, seed=3)
CONTACTS = len(FLOC.pairs)
STRENGTHS = np.random.default_rng(4).uniform(1, 2, (3, CONTACTS))
SHEAR = rc.simple_shear(2.0)


def setting(model, **strengths):
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, **strengths)
    return rc.contact_response(FLOC, rc.rigid_response(FLOC.spheres, model, viscosity=1.0), bonds), bonds


@pytest.mark.parametrize(
    ("criterion", "load", "strength"),
    [
        (rc.Tension(), "tension", "tensile_strength"),
        (rc.Rolling(), "bending", "bending_strength"),
        (rc.Twisting(), "twisting", "twisting_strength"),
    ],
)
@pytest.mark.parametrize("order", [2, 3])
def test_is_the_share_of_the_load_that_is_in_doubt(criterion, load, strength, order):
    """At failure, or in the same orientation at any other rate: error over load, for the contact that fails."""
    table, bonds = setting(rc.StokesianDynamics(order), **{strength: STRENGTHS[0]})
    first = rc.initiation(table, bonds, SHEAR, criterion=criterion)
    error = getattr(rc.truncation_error(table, SHEAR), load)[first.contact]
    carried = abs(getattr(table.loads(SHEAR), load)[first.contact])
    assert 0 < error < carried
    assert rc.rate_error(table, bonds, first) == pytest.approx(error / carried, rel=1e-12)


def test_in_the_worst_orientation_and_along_an_orbit():
    response = rc.rigid_response(FLOC.spheres, rc.StokesianDynamics(), viscosity=1.0)
    table, bonds = setting(rc.StokesianDynamics(), tensile_strength=STRENGTHS[0])
    for first in (rc.worst_initiation(table, bonds, SHEAR), rc.orbit_initiation(response, table, bonds, SHEAR)):
        error = rc.truncation_error(table, SHEAR).tension[first.contact]
        carried = table.loads(SHEAR.rotated(first.rotation)).tension[first.contact]
        assert rc.rate_error(table, bonds, first) == pytest.approx(error / carried, rel=1e-9)


def test_rates_of_two_orders_differ_by_less_than_three_times_the_error():
    """Of the contact that fails first at order 2, in many orientations; half of them by less than the error."""
    strengths = {"tensile_strength": STRENGTHS[0]}
    (low, bonds), (high, _) = (setting(rc.StokesianDynamics(order), **strengths) for order in (2, 6))
    apart = []
    for turn in rc.random_orientations(40, seed=1):
        first = rc.initiation(low, bonds, SHEAR.rotated(turn))
        tension = high.loads(first.flow).tension[first.contact]
        apart.append(abs(tension / bonds.tensile_strength[first.contact] - 1) / rc.rate_error(low, bonds, first))
    assert max(apart) < 3
    assert np.median(apart) < 1


def test_not_known():
    """No lower order, no failure, or several loads at once."""
    table, bonds = setting(rc.FreeDraining(), tensile_strength=1.0)
    assert rc.rate_error(table, bonds, rc.initiation(table, bonds, SHEAR)) is None
    table, bonds = setting(rc.StokesianDynamics(), tensile_strength=1.0, shear_strength=1.0)
    for criterion in (rc.Sliding(0.2), rc.Combined()):
        assert rc.rate_error(table, bonds, rc.initiation(table, bonds, SHEAR, criterion=criterion)) is None
    nothing = replace(rc.initiation(table, bonds, SHEAR), contact=None, criterion=None, rate=np.inf)
    assert rc.rate_error(table, bonds, nothing) is None


def test_refused():
    table, bonds = setting(rc.StokesianDynamics(), tensile_strength=1.0)
    first = rc.initiation(table, bonds, SHEAR)
    with pytest.raises(ValueError, match=rf"one value or one per contact \({CONTACTS}\), got 2"):
        rc.rate_error(table, rc.Bonds(1, 1, 1, 1, tensile_strength=[1.0, 2.0]), first)
    with pytest.raises(TypeError, match=r"^first: expected Initiation, got float; make one with initiation\("):
        rc.rate_error(table, bonds, 3.0)
