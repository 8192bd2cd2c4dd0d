"""The flow as an aggregate meets it: always the same flow, only turned."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc

FLOC = rc.generation.cluster_cluster(20, seed=2)
RESPONSE = rc.rigid_response(FLOC.spheres, rc.StokesianDynamics(), viscosity=1.0)
BONDS = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=np.linspace(1, 2, 19), bending_strength=0.5)
TURN = rc.random_orientations(1, seed=3)[0]
FLOWS = {"shear": rc.simple_shear(3.0), "extension": rc.uniaxial_extension(0.5)}


@pytest.fixture(scope="module")
def table():
    return rc.contact_response(FLOC, RESPONSE, BONDS)


def met(flow, orientation, **options):
    return rc.flow_met(FLOC, RESPONSE, BONDS, flow, orientation=orientation, **options)


@pytest.mark.parametrize("orientation", ["given", "worst", "orbit", TURN], ids=["given", "worst", "orbit", "rotation"])
@pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS)
def test_is_the_same_flow_at_the_same_rate(flow, orientation):
    turned = met(flow, orientation)
    assert turned.rate == flow.rate
    assert turned.magnitude == pytest.approx(flow.magnitude)
    np.testing.assert_allclose(turned.principal_rates, flow.principal_rates, atol=1e-12)


@pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS)
def test_the_first_failure_in_it_is_the_one_that_was_sought(flow, table):
    worst = rc.worst_initiation(table, BONDS, flow)
    assert rc.initiation(table, BONDS, met(flow, "worst"), criterion=rc.Tension()).rate == pytest.approx(worst.rate)
    for criterion in (rc.EVERY_LIMIT, rc.Tension()):
        along = rc.orbit_initiation(RESPONSE, table, BONDS, flow, criterion=criterion)
        found = rc.initiation(table, BONDS, met(flow, "orbit", criterion=criterion), criterion=criterion)
        assert (found.contact, found.criterion) == (along.contact, along.criterion)
        assert found.rate == pytest.approx(along.rate)


@pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS)
def test_rotation_of_an_initiation_turns_the_flow_into_its_own(flow, table):
    along = rc.orbit_initiation(RESPONSE, table, BONDS, flow, start=TURN)
    for first in (rc.initiation(table, BONDS, flow), rc.worst_initiation(table, BONDS, flow), along):
        turned = first.rotation @ flow.gradient @ first.rotation.T
        np.testing.assert_allclose(turned * first.rate / flow.rate, first.flow.gradient, atol=1e-12 * first.rate)


def test_as_given_and_by_a_rotation():
    flow = FLOWS["shear"]
    assert met(flow, "given") is flow
    for turn in (TURN, Rotation.from_matrix(TURN.copy())):
        np.testing.assert_allclose(met(flow, turn).gradient, TURN @ flow.gradient @ TURN.T, atol=1e-15)


def test_a_table_that_is_there_is_used(table):
    """That of another strength of the hydrodynamics tells: nothing is worked out anew."""
    reversed_table = rc.ContactResponse(table.normals, -table.force, -table.moment)
    flow = FLOWS["extension"]
    found = met(flow, "worst", table=reversed_table)
    expected = flow.rotated(rc.worst_initiation(reversed_table, BONDS, flow).rotation)
    np.testing.assert_array_equal(found.gradient, expected.gradient)
    assert not np.allclose(found.gradient, met(flow, "worst").gradient)


@pytest.mark.parametrize(
    ("orientation", "message"),
    [
        ("any", "^orientation: expected one of 'given', 'worst', 'orbit' or a rotation, got 'any'$"),
        (2 * TURN, "^orientation: expected a rotation matrix, got one with"),
        (None, r"^orientation: expected numbers in an array of shape \(3, 3\), got None"),
    ],
)
def test_refused_orientations(orientation, message):
    with pytest.raises(ValueError, match=message):
        met(FLOWS["shear"], orientation)
