"""What happens to one aggregate: all orientations at once against one after the other."""

import numpy as np
import pytest

import rheoclast as rc

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.first_failures import first_failures
from rheoclast.campaigns.setting import Flows, Setting

FLOC = rc.generation.thinned_fcc_ball(30, 4, seed=3)
RESPONSE = rc.rigid_response(FLOC.spheres, rc.FreeDraining(), 1.0)
BONDS = rc.Bonds(1.0, 0.8, 0.3, 0.2, tensile_strength=2.0, shear_strength=1.5, bending_strength=1.1)
FLOWS = {"shear": rc.simple_shear(3.0), "extension": rc.uniaxial_extension(1.0)}
ROTATIONS = rc.random_orientations(40, seed=2)
CRITERION = rc.Tension() | rc.Twisting() | rc.Rolling() | rc.Sliding(0.3)
SETTING = Setting(FLOC, RESPONSE, BONDS, CRITERION, "weakest")


@pytest.fixture(scope="module")
def table():
    return rc.contact_response(FLOC, RESPONSE, BONDS)


@pytest.mark.parametrize("criterion", [CRITERION, rc.Tension(), rc.Combined(), rc.EVERY_LIMIT])
@pytest.mark.parametrize("flow", FLOWS.values())
def test_all_orientations_at_once_are_each_in_turn(table, flow, criterion, monkeypatch):
    monkeypatch.setattr("rheoclast.campaigns.first_failures.CHUNK", 200)
    found = first_failures(table, BONDS, flow, ROTATIONS, criterion)
    for k, rotation in enumerate(ROTATIONS):
        single = rc.initiation(table, BONDS, flow.rotated(rotation), criterion)
        assert found.contact[k] == single.contact
        assert criterion.parts[found.criterion[k]].name == single.criterion
        assert found.rate[k] == pytest.approx(single.rate, rel=1e-12)


def test_margin_is_that_of_the_first_failure_of_a_breakup(table):
    found = first_failures(table, BONDS, FLOWS["shear"], ROTATIONS, CRITERION)
    turned = [FLOWS["shear"].rotated(each) for each in ROTATIONS]
    broken = rc.break_up_each(FLOC, RESPONSE, BONDS, turned, criterion=CRITERION)
    np.testing.assert_allclose(found.margin, [each.failures[0].margin for each in broken], atol=1e-9)


def test_nothing_fails_where_all_is_compressed():
    """Two spheres along the axis of extension, and along two of compression."""
    pair = rc.generation.straight_chain(2)
    response = rc.rigid_response(pair.spheres, rc.FreeDraining(), 1.0)
    axis = (pair.spheres.centers[1] - pair.spheres.centers[0]) / 2
    turn = np.array([np.roll(np.eye(3), k, axis=0) for k in range(3)])
    flow = rc.uniaxial_extension(2.0)
    pulled = np.array([axis @ each @ flow.strain_rate @ each.T @ axis for each in turn]) > 0
    assert sorted(pulled) == [False, False, True]
    found = first_failures(rc.contact_response(pair, response), BONDS, flow, turn, rc.Tension())
    np.testing.assert_array_equal(found.contact, np.where(pulled, 0, -1))
    np.testing.assert_array_equal(np.isfinite(found.rate), pulled)
    np.testing.assert_array_equal(found.margin[pulled], 1)
    rows = EVENTS["first failure"].rows(
        Setting(pair, response, BONDS, rc.Tension(), "weakest"), Flows({"a": flow}, turn, np.inf)
    )
    for unknown in ("contact", "i", "j", "criterion", "margin", "radial_position", "depth"):
        np.testing.assert_array_equal(rows.field(unknown).is_null(), ~pulled)


def test_without_a_strength_nothing_can_fail(table):
    with pytest.raises(ValueError, match="bonds: expected a strength"):
        first_failures(table, rc.Bonds(1, 1, 1, 1), FLOWS["shear"], ROTATIONS)


def test_rows_of_first_failures(table):
    rows = EVENTS["first failure"].rows(SETTING, Flows(FLOWS, ROTATIONS, np.inf)).to_pylist()
    assert [(row["flow"], row["orientation"]) for row in rows] == [(name, k) for name in FLOWS for k in range(40)]
    for row in rows[::7]:
        single = rc.initiation(table, BONDS, FLOWS[row["flow"]].rotated(ROTATIONS[row["orientation"]]), CRITERION)
        point = FLOC.contact_points[[single.contact]]
        assert row["initiation_rate_per_s"] == pytest.approx(single.rate, rel=1e-12)
        assert (row["contact"], row["criterion"]) == (single.contact, single.criterion)
        assert [row["i"], row["j"]] == FLOC.pairs[single.contact].tolist()
        assert row["radial_position"] == pytest.approx(
            np.linalg.norm(point - FLOC.spheres.center_of_mass) / rc.radius_of_gyration(FLOC.spheres)
        )
        assert row["depth"] == pytest.approx(rc.depth(FLOC, point)[0])
