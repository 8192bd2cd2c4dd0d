"""Breakups of one aggregate in flows, as rows."""

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
ROTATIONS = rc.random_orientations(4, seed=2)
CRITERION = rc.Tension() | rc.Twisting() | rc.Rolling() | rc.Sliding(0.3)


@pytest.mark.parametrize("rule", ["weakest", "overloaded"])
def test_rows_of_breakups(rule):
    setting = Setting(FLOC, RESPONSE, BONDS, CRITERION, rule)
    rows = EVENTS["breakup"].rows(setting, Flows(FLOWS, ROTATIONS, np.inf)).to_pylist()
    assert [(row["flow"], row["orientation"]) for row in rows] == [(name, k) for name in FLOWS for k in range(4)]
    for row in rows:
        flow = FLOWS[row["flow"]].rotated(ROTATIONS[row["orientation"]])
        broken = rc.break_up(FLOC, RESPONSE, BONDS, flow, rule=rule, criterion=CRITERION)
        assert row["outcome"] == broken.outcome
        assert row["fragments"] == [len(each) for each in broken.fragments]
        assert row["contacts"] == [each.contact for each in broken.failures]
        assert row["criteria"] == [each.criterion for each in broken.failures]
        assert row["rates_per_s"] == [each.rate for each in broken.failures]
        assert (row["initiation_rate_per_s"], row["breakup_rate_per_s"]) == (
            broken.initiation_rate,
            broken.breakup_rate,
        )
        assert row["surface"] == len(broken.surface)
        assert row["inwardness"] == pytest.approx(broken.inwardness, nan_ok=True)


def test_breakup_only_up_to_a_rate():
    setting = Setting(FLOC, RESPONSE, BONDS, CRITERION, "weakest")
    rows = EVENTS["breakup"].rows(setting, Flows(FLOWS, ROTATIONS, 1e-3)).to_pylist()
    assert {(row["outcome"], len(row["contacts"]), tuple(row["fragments"])) for row in rows} == {("whole", 0, (30,))}
