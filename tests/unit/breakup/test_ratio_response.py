"""Load ratios for many strain rates at once, against the definition, one flow after the other."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.breakup import ratio_response
from rheoclast.breakup.ratio_response import RatioResponse
from rheoclast.vectors import STRAIN_BASIS

FLOC = rc.generation.thinned_fcc_ball(25, 4, seed=1)
CONTACTS = len(FLOC.pairs)
TABLE = rc.contact_response(FLOC, rc.rigid_response(FLOC.spheres, rc.FreeDraining(), 1.0), rc.Bonds(1.0, 0.8, 0.3, 0.2))
BONDS = rc.Bonds(1.0, 0.8, 0.3, 0.2, *(np.random.default_rng(1).uniform(1, 3, (4, CONTACTS))))
TENSION_ONLY = rc.Bonds(1.0, 0.8, 0.3, 0.2, tensile_strength=BONDS.tensile_strength)
COMPONENTS = np.random.default_rng(2).normal(size=(30, 5))
CASES = [
    (BONDS, rc.EVERY_LIMIT),
    (BONDS, rc.Tension()),
    (BONDS, rc.Rolling() | rc.Sliding(0.1) | rc.Sliding(0.5)),
    (BONDS, rc.Combined()),
    (TENSION_ONLY, rc.Rolling() | rc.Tension()),
]


def each_alone(bonds, criterion):
    """Ratios (C, K) in every flow."""
    for components in COMPONENTS:
        flow = rc.LinearFlow(np.einsum("k,kij->ij", components, STRAIN_BASIS))
        yield rc.load_ratios(TABLE.loads(flow), bonds, criterion=criterion)


@pytest.mark.parametrize("pieces", [None, 1, 7 * CONTACTS])
@pytest.mark.parametrize(("bonds", "criterion"), CASES)
def test_largest_and_next_of_all_flows_are_those_of_each(bonds, criterion, pieces, monkeypatch):
    if pieces:
        monkeypatch.setattr(ratio_response, "RATIOS_AT_ONCE", pieces)
    ratios = RatioResponse(TABLE, bonds, criterion)
    ratio, contact, part, following = ratios.largest_two(COMPONENTS)
    for k, expected in enumerate(each_alone(bonds, criterion)):
        assert ratio[k] == pytest.approx(expected.max(), rel=1e-12)
        assert (contact[k], part[k]) == np.unravel_index(expected.argmax(), expected.shape)
        limited = expected[:, np.abs(expected).max(axis=0) > 0]
        assert following[k] == pytest.approx(np.delete(limited, contact[k], axis=0).max(), rel=1e-12)
    for one, other in zip(ratios.largest(COMPONENTS), (ratio, contact, part), strict=True):
        np.testing.assert_array_equal(one, other)


def test_criteria_are_named_with_their_position():
    criterion = rc.Rolling() | rc.Sliding(0.1) | rc.Sliding(0.5)
    assert RatioResponse(TABLE, BONDS, criterion).criteria == ("rolling", "sliding 1", "sliding 2")


def test_no_flow_no_ratio():
    ratio, contact, part = RatioResponse(TABLE, BONDS, rc.EVERY_LIMIT).largest(np.empty((0, 5)))
    assert len(ratio) == len(contact) == len(part) == 0


def test_refused():
    with pytest.raises(ValueError, match="bonds: expected a strength of some contact for failure by rolling"):
        RatioResponse(TABLE, TENSION_ONLY, rc.Rolling())
    with pytest.raises(ValueError, match=rf"one value or one per contact \({CONTACTS}\), got 2"):
        RatioResponse(TABLE, rc.Bonds(1, 1, 1, 1, tensile_strength=[1.0, 2.0]), rc.Tension())
