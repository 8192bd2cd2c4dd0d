"""Aggregates, and the flows that they meet."""

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


@pytest.mark.parametrize("event", ["first failure", "breakup"])
def test_worst_orientation_is_that_for_tension(event):
    table = rc.contact_response(FLOC, RESPONSE, BONDS)
    rows = (
        EVENTS[event]
        .rows(Setting(FLOC, RESPONSE, BONDS, rc.Tension(), "weakest"), Flows(FLOWS, None, np.inf))
        .to_pylist()
    )
    worst = [rc.worst_initiation(table, BONDS, flow).rate for flow in FLOWS.values()]
    assert [row["initiation_rate_per_s"] for row in rows] == pytest.approx(worst, rel=1e-9)
    assert [row["orientation"] for row in rows] == [0, 0]
