"""Strengths, laws other than JKR, and the first failure."""

import inspect
from dataclasses import replace

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.mechanics.laws.law import ContactLaw

SPHERES = rc.Spheres([[0, 0, 0], [3, 0, 0], [3, 6, 0]], [1.0, 2.0, 4.0])
TRIMER = rc.Aggregate.touching(SPHERES)
JKR = rc.JKR(rc.MATERIALS["polystyrene"])
EXPLICIT = rc.Uniform(normal=1.0, tangential=2.0, bending=3.0, twisting=4.0, tensile_strength=5.0)
TESTED = {rc.JKR, rc.MeasuredPullOff, rc.Uniform}


def test_every_contact_law_is_tested():
    laws = {value for _, value in inspect.getmembers(rc, inspect.isclass) if issubclass(value, ContactLaw)}
    assert laws - {ContactLaw} == TESTED


def test_uniform_law_gives_what_it_was_given():
    bonds = EXPLICIT.bonds(TRIMER)
    np.testing.assert_array_equal(bonds.stiffness(2), [[1, 2, 3, 4]] * 2)
    np.testing.assert_array_equal(bonds.strength(2), [[5, np.inf, np.inf, np.inf]] * 2)


def test_measured_pull_off_is_that_of_the_measured_spheres_and_scales_with_the_reduced_radius():
    law = rc.MeasuredPullOff(6e-9, EXPLICIT, radius=2.0)  # reduced radius 1
    strength = law.bonds(TRIMER).strength(2)[:, 0]
    np.testing.assert_allclose(strength, [6e-9 * 2 / 3, 6e-9 * 4 / 3])
    np.testing.assert_array_equal(rc.MeasuredPullOff(6e-9, JKR).bonds(TRIMER).strength(2)[:, 0], [6e-9, 6e-9])
    np.testing.assert_array_equal(law.bonds(TRIMER).stiffness(2), EXPLICIT.bonds(TRIMER).stiffness(2))


@pytest.fixture(scope="module")
def table():
    return rc.contact_response(TRIMER, rc.rigid_response(SPHERES, rc.StokesianDynamics(), 1.0))


@pytest.mark.parametrize(
    ("criterion", "load"),
    [("tension", "tension"), ("sliding", "shear"), ("rolling", "bending"), ("twisting", "twisting")],
)
def test_first_failure_by_each_limit(table, criterion, load):
    flow = rc.simple_shear(3.0).rotated(rc_rotation())
    name = {"tension": "tensile"}.get(load, load) + "_strength"
    first = rc.initiation(table, rc.Bonds(1, 1, 1, 1, **{name: [7.0, 9.0]}), flow)
    carried = np.abs(getattr(table.loads(first.flow), load))
    assert first.criterion == criterion
    assert carried[first.contact] == pytest.approx([7.0, 9.0][first.contact])
    assert (carried <= np.array([7.0, 9.0]) * (1 + 1e-12)).all() or criterion == "tension"
    assert first.flow.rate == first.rate
    np.testing.assert_allclose(first.flow.gradient * 3.0, flow.gradient * first.rate)


@pytest.mark.parametrize(
    "criterion",
    [rc.Tension(), rc.Sliding(0.5), rc.Rolling(), rc.Twisting(), rc.Combined(1), rc.Combined(), rc.EVERY_LIMIT],
    ids=lambda criterion: criterion.name,
)
def test_load_ratio_is_one_at_the_first_failure(table, criterion):
    """Largest of all contacts; and the criterion that is told is the one that is met."""
    bonds = rc.Bonds(1, 1, 1, 1, [7.0, 9.0], [5.0, 3.0], [4.0, 8.0], [2.0, 1.0])
    first = rc.initiation(table, bonds, rc.planar_extension(3.0).rotated(rc_rotation()), criterion)
    ratios = rc.load_ratios(table.loads(first.flow), bonds, criterion)
    assert ratios.max() == pytest.approx(1, rel=1e-12)
    contact, part = np.unravel_index(ratios.argmax(), ratios.shape)
    assert (first.contact, first.criterion) == (contact, criterion.parts[part].name)


def rc_rotation():
    return np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3


def test_the_strictest_criterion_decides(table):
    flow, bonds = rc.simple_shear(1.0).rotated(rc_rotation()), rc.Bonds(1, 1, 1, 1, tensile_strength=1e3)
    both = rc.initiation(table, replace(bonds, bending_strength=1e-3), flow)
    assert both.criterion == "rolling"
    assert table.loads(both.flow).bending[both.contact] == pytest.approx(1e-3)


def test_worst_orientation_is_by_tension_alone(table):
    flow = rc.planar_extension(2.0)
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=[7.0, 9.0])
    expected = rc.worst_initiation(table, bonds, flow)
    weak = rc.worst_initiation(table, replace(bonds, shear_strength=1e-9, twisting_strength=1e-9), flow)
    assert (weak.contact, weak.rate) == (expected.contact, expected.rate)
    assert table.loads(expected.flow).tension[expected.contact] == pytest.approx([7.0, 9.0][expected.contact])


def test_a_response_of_slightly_shifted_spheres_is_refused():
    shifted = rc.Spheres(SPHERES.centers + np.array([[0, 0, 0], [0, 0, 1e-6], [0, 0, 0]]), SPHERES.radii)
    with pytest.raises(rc.GeometryError, match="other spheres"):
        rc.contact_response(TRIMER, rc.rigid_response(shifted, rc.FreeDraining(), 1.0))


def test_a_response_of_smaller_spheres_is_refused():
    smaller = rc.Spheres(SPHERES.centers, SPHERES.radii / 2)
    with pytest.raises(rc.GeometryError, match="other spheres"):
        rc.contact_response(TRIMER, rc.rigid_response(smaller, rc.FreeDraining(), 1.0))


def test_a_turned_rotation_breaks_nothing():
    """Its strain rate is rounding: no contact fails, at whatever rate."""
    table = rc.contact_response(TRIMER, rc.rigid_response(SPHERES, rc.FreeDraining(), 1.0))
    flow = rc.LinearFlow([[0, 1, 0], [-1, 0, 0], [0, 0, 0]]).rotated(np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3)
    assert flow.rate == 0
    bonds = EXPLICIT.bonds(TRIMER)
    for first in (rc.initiation(table, bonds, flow), rc.worst_initiation(table, bonds, flow)):
        assert first.contact is None
        assert first.rate == np.inf
        assert first.flow is flow


def test_a_rate_of_zero_is_refused_for_a_strain():
    with pytest.raises(ValueError, match=r"^rate: expected a positive number for a flow of magnitude 1, got 0$"):
        rc.LinearFlow([[0, 1, 0], [0, 0, 0], [0, 0, 0]], rate=0)
