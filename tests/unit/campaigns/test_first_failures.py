"""First failures of one aggregate in every flow and orientation, as rows."""

import numpy as np
import pytest

import rheoclast as rc

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.setting import Flows, Setting

FLOC = rc.generation.thinned_fcc_ball(30, 4, seed=3)
RESPONSE = rc.rigid_response(FLOC.spheres, rc.FreeDraining(), 1.0)
BONDS = rc.Bonds(1.0, 0.8, 0.3, 0.2, tensile_strength=2.0, shear_strength=1.5, bending_strength=1.1)
FLOWS = {"shear": rc.simple_shear(3.0), "extension": rc.uniaxial_extension(1.0)}
ROTATIONS = rc.random_orientations(40, seed=2)
CRITERION = rc.Tension() | rc.Twisting() | rc.Rolling() | rc.Sliding(0.3)
SETTING = Setting(FLOC, RESPONSE, BONDS, CRITERION, "weakest")


def test_unknown_where_nothing_fails():
    """Two spheres along the axis of extension, and along two of compression."""
    pair = rc.generation.straight_chain(2)
    response = rc.rigid_response(pair.spheres, rc.FreeDraining(), 1.0)
    turn = np.array([np.roll(np.eye(3), k, axis=0) for k in range(3)])
    flows = Flows({"a": rc.uniaxial_extension(2.0)}, turn, np.inf)
    rows = EVENTS["first failure"].rows(Setting(pair, response, BONDS, rc.Tension(), "weakest"), flows)
    breaks = np.isfinite(rows.field("initiation_rate_per_s").to_numpy())
    assert sorted(breaks) == [False, False, True]
    for unknown in ("contact", "i", "j", "criterion", "margin", "radial_position", "depth"):
        np.testing.assert_array_equal(rows.field(unknown).is_null(), ~breaks)


def test_rows_of_first_failures():
    table = rc.contact_response(FLOC, RESPONSE, BONDS)
    rows = EVENTS["first failure"].rows(SETTING, Flows(FLOWS, ROTATIONS, np.inf)).to_pylist()
    assert [(row["flow"], row["orientation"]) for row in rows] == [(name, k) for name in FLOWS for k in range(40)]
    for row in rows[::7]:
        single = rc.initiation(
            table, BONDS, FLOWS[row["flow"]].rotated(ROTATIONS[row["orientation"]]), criterion=CRITERION
        )
        point = FLOC.contact_points[[single.contact]]
        assert row["initiation_rate_per_s"] == pytest.approx(single.rate, rel=1e-12)
        assert (row["contact"], row["criterion"]) == (single.contact, single.criterion)
        assert [row["i"], row["j"]] == FLOC.pairs[single.contact].tolist()
        assert row["radial_position"] == pytest.approx(
            np.linalg.norm(point - FLOC.spheres.center_of_mass) / rc.radius_of_gyration(FLOC.spheres)
        )
        assert row["depth"] == pytest.approx(rc.depth(FLOC, point)[0])
