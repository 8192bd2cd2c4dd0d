"""The first failure."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc

SPHERES = rc.Spheres([[0, 0, 0], [3, 0, 0], [3, 6, 0]], [1.0, 2.0, 4.0])
TRIMER = rc.Aggregate.touching(SPHERES)


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
    first = rc.initiation(table, bonds, rc.planar_extension(3.0).rotated(rc_rotation()), criterion=criterion)
    ratios = rc.load_ratios(table.loads(first.flow), bonds, criterion=criterion)
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
    bonds = rc.Bonds(1.0, 2.0, 3.0, 4.0, tensile_strength=5.0)
    for first in (rc.initiation(table, bonds, flow), rc.worst_initiation(table, bonds, flow)):
        assert first.contact is None
        assert first.rate == np.inf
        assert first.flow is flow


@pytest.mark.parametrize("axis", [[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 2]])
def test_a_doublet_that_symmetry_spares_is_not_broken(axis):
    """n·E·n vanishes for these axes in simple shear: what tension there is, is rounding."""
    direction = np.array(axis) / np.linalg.norm(axis)
    spheres = rc.Spheres(np.array([-direction, direction]) * 1e-6, 1e-6)
    response = rc.rigid_response(spheres, rc.StokesianDynamics(order=3), 1e-3)
    doublet = rc.Aggregate.touching(spheres)
    bonds = rc.jkr_bonds(doublet, rc.MATERIALS["polystyrene"])
    table = rc.contact_response(doublet, response, bonds)
    assert rc.initiation(table, bonds, rc.simple_shear(1.0)).contact is None
    assert rc.break_up(doublet, response, bonds, rc.simple_shear(1.0)).outcome == "whole"
    if axis == [0, 0, 1]:  # along the vorticity it stays
        assert rc.orbit_initiation(response, table, bonds, rc.simple_shear(1.0)).contact is None
    slightly = rc.initiation(table, bonds, rc.simple_shear(1.0).rotated(Rotation.from_rotvec([1e-3, 2e-3, 3e-3])))
    assert (slightly.contact is not None) == (table.loads(slightly.flow).tension[0] > 0)


@pytest.mark.parametrize("factor", [1e-6, 1e-9, 1e-11])
def test_a_weak_contact_that_is_pressed_does_not_hide_the_one_that_fails(factor):
    star = rc.generation.cross(2)
    response = rc.rigid_response(star.spheres, rc.FreeDraining(), 1.0)
    table, flow = rc.contact_response(star, response), rc.planar_extension(1.0)
    tension = table.loads(flow).tension
    strength = np.where(np.arange(len(tension)) == tension.argmin(), factor, 1.0)
    bonds = rc.Bonds(1.0, 1.0, 1.0, 1.0, tensile_strength=strength)
    first = rc.initiation(table, bonds, flow)
    assert first.rate == pytest.approx(1 / tension.max())
    assert rc.break_up(star, response, bonds, flow).failures[0].rate == pytest.approx(first.rate)


def test_a_rate_of_zero_is_refused_for_a_strain():
    with pytest.raises(ValueError, match=r"^rate: expected a positive number for a flow of magnitude 1, got 0$"):
        rc.LinearFlow([[0, 1, 0], [0, 0, 0], [0, 0, 0]], rate=0)


class TestManyOrientations:
    FLOC = rc.generation.thinned_fcc_ball(30, 4, seed=3)
    RESPONSE = rc.rigid_response(FLOC.spheres, rc.FreeDraining(), 1.0)
    BONDS = rc.Bonds(1.0, 0.8, 0.3, 0.2, tensile_strength=2.0, shear_strength=1.5, bending_strength=1.1)
    TABLE = rc.contact_response(FLOC, RESPONSE, BONDS)
    FLOWS = (rc.simple_shear(3.0), rc.uniaxial_extension(1.0))
    ROTATIONS = rc.random_orientations(40, seed=2)
    CRITERION = rc.Tension() | rc.Sliding(0.1) | rc.Twisting() | rc.Rolling() | rc.Sliding(0.6)

    @pytest.mark.parametrize("criterion", [CRITERION, rc.Tension(), rc.Combined(), rc.EVERY_LIMIT])
    @pytest.mark.parametrize("flow", FLOWS)
    def test_rate_and_contact_are_by_definition(self, flow, criterion):
        """At the rate told the largest load ratio is one, in the contact and by the criterion told."""
        found = rc.initiations(self.TABLE, self.BONDS, flow, self.ROTATIONS, criterion=criterion)
        assert found.criteria == criterion.part_names
        for k, rotation in enumerate(self.ROTATIONS):
            loads = self.TABLE.loads(flow.rotated(rotation).scaled(found.rate[k] / flow.rate))
            ratios = rc.load_ratios(loads, self.BONDS, criterion=criterion)
            assert ratios.max() == pytest.approx(1, rel=1e-12)
            assert (found.contact[k], found.criterion[k]) == np.unravel_index(ratios.argmax(), ratios.shape)

    def test_one_orientation_is_an_initiation(self):
        found = rc.initiations(self.TABLE, self.BONDS, self.FLOWS[0], self.ROTATIONS, criterion=self.CRITERION)
        for k, rotation in enumerate(self.ROTATIONS):
            flow = self.FLOWS[0].rotated(rotation)
            single = rc.initiation(self.TABLE, self.BONDS, flow, criterion=self.CRITERION)
            assert (single.contact, single.criterion) == (found.contact[k], found.criteria[found.criterion[k]])
            assert single.rate == pytest.approx(found.rate[k], rel=1e-12)
        assert {"sliding 2", "rolling"} <= {found.criteria[part] for part in found.criterion}

    def test_margin_is_that_of_the_first_failure_of_a_breakup(self):
        found = rc.initiations(self.TABLE, self.BONDS, self.FLOWS[0], self.ROTATIONS, criterion=self.CRITERION)
        turned = [self.FLOWS[0].rotated(each) for each in self.ROTATIONS]
        broken = rc.break_up_each(self.FLOC, self.RESPONSE, self.BONDS, turned, criterion=self.CRITERION)
        np.testing.assert_allclose(found.margin, [each.failures[0].margin for each in broken], atol=1e-9)

    def test_nothing_fails_where_all_is_compressed(self):
        """Two spheres along the axis of extension, and along two of compression."""
        pair = rc.generation.straight_chain(2)
        response = rc.rigid_response(pair.spheres, rc.FreeDraining(), 1.0)
        axis = (pair.spheres.centers[1] - pair.spheres.centers[0]) / 2
        turn = np.array([np.roll(np.eye(3), k, axis=0) for k in range(3)])
        flow = rc.uniaxial_extension(2.0)
        pulled = np.array([axis @ each @ flow.strain_rate @ each.T @ axis for each in turn]) > 0
        assert sorted(pulled) == [False, False, True]
        table = rc.contact_response(pair, response)
        found = rc.initiations(table, self.BONDS, flow, turn, criterion=rc.Tension())
        np.testing.assert_array_equal(found.contact, np.where(pulled, 0, -1))
        np.testing.assert_array_equal(found.criterion, np.where(pulled, 0, -1))
        np.testing.assert_array_equal(np.isfinite(found.rate), pulled)
        np.testing.assert_array_equal(found.margin, np.where(pulled, 1, 0))

    def test_rotations_of_scipy(self):
        found, again = (
            rc.initiations(self.TABLE, self.BONDS, self.FLOWS[1], each)
            for each in (self.ROTATIONS, Rotation.from_matrix(self.ROTATIONS.copy()))
        )
        np.testing.assert_allclose(found.rate, again.rate, rtol=1e-12)
        with pytest.raises(ValueError, match="read-only"):
            found.rate[0] = 1

    def test_refused(self):
        with pytest.raises(ValueError, match="bonds: expected a strength"):
            rc.initiations(self.TABLE, rc.Bonds(1, 1, 1, 1), self.FLOWS[0], self.ROTATIONS)
        with pytest.raises(ValueError, match=r"rotations: expected shape \(n, 3, 3\), got \(3, 3\)"):
            rc.initiations(self.TABLE, self.BONDS, self.FLOWS[0], np.eye(3))
        wrong = np.stack([np.eye(3), -np.eye(3)])
        with pytest.raises(ValueError, match=r"rotations\[1\]: expected a rotation matrix, .* determinant -1$"):
            rc.initiations(self.TABLE, self.BONDS, self.FLOWS[0], wrong)
        with pytest.raises(TypeError, match=r"^table: expected ContactResponse, got RigidResponse; make one with con"):
            rc.initiation(self.RESPONSE, self.BONDS, self.FLOWS[0])
        with pytest.raises(TypeError, match=r"^flow: expected LinearFlow, got ndarray; for instance simple_shear"):
            rc.worst_initiation(self.TABLE, self.BONDS, np.eye(3))
