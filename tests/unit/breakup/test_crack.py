"""Breakup: what its result says, and what is refused."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cross, lattice_ball, random_packed_ball, straight_chain


def broken(aggregate, flow, rule="weakest", **strength):
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1.0)
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, **(strength or {"tensile_strength": 2.0}))
    return rc.break_up(aggregate, response, bonds, flow, rule)


ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))


class TestChain:
    """In extension along a chain of free-draining spheres the tension is largest in the middle."""

    def test_breaks_in_the_middle_at_the_rate_of_stokes_drag(self):
        """Ten spheres at x = ±1 … ±9: the middle contact carries 6π Σ x = 6π · 25 per unit rate."""
        breakup = broken(straight_chain(10), ALONG_X)
        (failure,) = breakup.failures
        assert failure.pair == (4, 5)
        assert failure.criterion == "tension"
        assert failure.depth == pytest.approx(0, abs=1e-12)
        assert failure.rate == pytest.approx(ALONG_X.rate * 2.0 / (6 * np.pi * 25), rel=1e-9)
        assert breakup.is_single_bond
        assert [len(fragment) for fragment in breakup.fragments] == [5, 5]

    def test_rate_of_the_flow_does_not_matter(self):
        slow, fast = (broken(straight_chain(6), ALONG_X.scaled(factor)) for factor in (1e-3, 1e6))
        assert slow.breakup_rate == pytest.approx(fast.breakup_rate, rel=1e-12)

    def test_stronger_contact_sends_the_failure_elsewhere(self):
        strength = np.full(9, 2.0)
        strength[4] = 20.0
        breakup = broken(straight_chain(10), ALONG_X, tensile_strength=strength)
        assert breakup.failures[0].pair in ((3, 4), (5, 6))
        assert breakup.failures[0].margin == pytest.approx(0, abs=1e-9)

    def test_criterion_that_fails_is_told(self):
        tilted = rc.LinearFlow([[0, 1.0, 0], [1.0, 0, 0], [0, 0, 0]])
        breakup = broken(straight_chain(6), tilted, shear_strength=1.0)
        assert {failure.criterion for failure in breakup.failures} == {"shear"}

    def test_compression_breaks_nothing(self):
        breakup = broken(straight_chain(6), rc.LinearFlow(np.diag([-1.0, 0.5, 0.5])))
        assert not breakup.splits
        assert breakup.failures == ()
        assert breakup.initiation_rate == breakup.breakup_rate == np.inf
        assert len(breakup.fragments[0]) == 6


def test_several_fragments_at_once():
    """A cross stretched along both its arms, all overloaded contacts failing: the four inner ones tie."""
    flow = rc.LinearFlow(np.diag([0.5, 0.5, -1.0]))
    breakup = broken(cross(3), flow, rule="overloaded")
    assert sorted(map(len, breakup.fragments)) == [1, 3, 3, 3, 3]
    assert len(breakup.failures) == 4
    assert not breakup.is_single_bond


def test_fragments_are_the_spheres_and_contacts_that_are_left():
    aggregate = random_packed_ball(60, seed=1)
    breakup = broken(aggregate, rc.uniaxial_extension(1.0))
    assert sorted(np.concatenate(breakup.spheres).tolist()) == list(range(60))
    for fragment, spheres in zip(breakup.fragments, breakup.spheres, strict=True):
        np.testing.assert_array_equal(fragment.spheres.centers, aggregate.spheres.centers[spheres])
    whole = {tuple(pair) for pair in aggregate.pairs.tolist()}
    inside = {tuple(s[p].tolist()) for f, s in zip(breakup.fragments, breakup.spheres, strict=True) for p in f.pairs}
    lost = {failure.pair for failure in breakup.failures}
    assert inside | lost == whole
    assert not inside & lost
    assert [len(fragment) for fragment in breakup.fragments] == sorted(map(len, breakup.fragments), reverse=True)


def test_rates_of_breakup_and_initiation():
    breakup = broken(lattice_ball("fcc", 43), rc.simple_shear(1.0))
    rates = [failure.rate for failure in breakup.failures]
    assert breakup.initiation_rate == rates[0]
    assert breakup.breakup_rate == max(rates) >= rates[0]


class TestRefusals:
    def test_flow_without_strain(self):
        spin = rc.LinearFlow([[0, -1.0, 0], [1.0, 0, 0], [0, 0, 0]])
        with pytest.raises(ValueError, match="flow: expected a strain rate that is not zero, got none"):
            broken(straight_chain(3), spin)

    def test_bonds_without_strength(self):
        with pytest.raises(ValueError, match="bonds: expected a strength of some contact, got none"):
            broken(straight_chain(3), ALONG_X, tensile_strength=np.inf)

    def test_unknown_rule(self):
        with pytest.raises(ValueError, match="rule: expected 'weakest' or 'overloaded', got 'all'"):
            broken(straight_chain(3), ALONG_X, rule="all")
