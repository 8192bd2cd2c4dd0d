"""Cascades: fragments break by their own hydrodynamics until all hold."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cluster_cluster, compacted_cluster, straight_chain

ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))


def setting(aggregate, strength=1.0, model=None):
    response = rc.rigid_response(aggregate.spheres, model or rc.FreeDraining(), viscosity=1.0)
    return aggregate, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=strength)


def largest_ratio(aggregate, bonds, flow, model):
    """Largest load ratio in tension of an aggregate by itself, the definition of holding."""
    response = rc.rigid_response(aggregate.spheres, model, viscosity=1.0)
    carried = rc.contact_loads(aggregate, response.loads(flow), bonds)
    return (carried.tension / bonds.tensile_strength).max()


@pytest.mark.parametrize("factor", [0.9, 1.1, 3.9, 4.1, 1e3])
def test_chain_halves_until_it_holds(factor):
    """A free-draining chain of 2n spheres carries 6π n² in its middle per unit rate: 16, 8, 4, 2, 1 in turn."""
    strength = 6 * np.pi * 64
    result = rc.cascade(*setting(straight_chain(16), strength), ALONG_X.scaled(factor))
    size = 16
    while size > 1 and factor * (size // 2) ** 2 > 64:
        size //= 2
    assert result.sizes.tolist() == [size] * (16 // size)
    generations = int(np.log2(16 // size))
    assert max(piece.generation for piece in result.pieces) == generations
    assert len(result.pieces) == 2 ** (generations + 1) - 1


@pytest.mark.parametrize("orientation", ["given", "worst", "orbit"])
@pytest.mark.parametrize(
    "aggregate", [cluster_cluster(50, seed=1), compacted_cluster(40, amount=0.4, seed=2)], ids=["tree", "compacted"]
)
def test_genealogy(aggregate, orientation):
    """Parents come before their children, which share their spheres; what holds is all spheres once."""
    whole = setting(aggregate)
    splits = rc.break_up(*whole, rc.simple_shear(1.0)).breakup_rate
    result = rc.cascade(*whole, rc.simple_shear(3 * splits), orientation=orientation)
    assert result.pieces[0].parent is None
    for position, piece in enumerate(result.pieces):
        children = [result.pieces[k] for k in result.children(position)]
        assert bool(children) == (not piece.holds)
        if children:
            together = np.sort(np.concatenate([child.spheres for child in children]))
            np.testing.assert_array_equal(together, piece.spheres)
            assert all(child.generation == piece.generation + 1 for child in children)
        np.testing.assert_array_equal(piece.aggregate.spheres.centers, aggregate.spheres.centers[piece.spheres])
        assert piece.parent is None or piece.parent < position
    assert result.sizes.sum() == len(aggregate)
    assert len(result.remaining) > 1


def test_what_holds_holds_by_itself_and_what_breaks_does_not():
    """At order 2, every fragment solved anew on its own."""
    model = rc.StokesianDynamics()
    whole = setting(cluster_cluster(60, seed=4), 30.0, model)
    flow = rc.simple_shear(3 * rc.break_up(*whole, rc.simple_shear(1.0)).breakup_rate)
    result = rc.cascade(*whole, flow)
    assert 2 < len(result.remaining) < 60
    for piece in result.pieces:
        if len(piece.aggregate) > 1:
            assert (largest_ratio(piece.aggregate, whole[2], flow, model) < 1) == piece.holds


def test_worst_orientation_leaves_nothing_that_any_orientation_breaks():
    whole = setting(cluster_cluster(40, seed=5), 30.0, rc.StokesianDynamics())
    table = rc.contact_response(whole[0], whole[1])
    flow = rc.simple_shear(2 * rc.worst_initiation(table, whole[2], rc.simple_shear(1.0)).rate)
    remaining = rc.cascade(*whole, flow, orientation="worst").remaining
    assert len(remaining) > 1
    for fragment in remaining:
        if len(fragment) > 1:
            own = rc.contact_response(fragment, rc.rigid_response(fragment.spheres, rc.StokesianDynamics(), 1.0))
            assert rc.worst_initiation(own, whole[2], flow).rate >= flow.rate


def test_strength_stays_with_its_contact():
    """One contact of a chain that nothing breaks: its two spheres stay together in the strongest flow."""
    strength = np.full(7, 1.0)
    strength[5] = 1e12
    aggregate, response, _ = setting(straight_chain(8))
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=strength)
    result = rc.cascade(aggregate, response, bonds, ALONG_X.scaled(1e6))
    assert result.sizes.tolist() == [2, 1, 1, 1, 1, 1, 1]
    (pair,) = (piece.spheres for piece in result.pieces if piece.holds and len(piece.spheres) == 2)
    assert tuple(pair) == tuple(aggregate.pairs[5])


def test_a_piece_that_is_weakened_but_does_not_split():
    """Between the rates of initiation and of the split it loses contacts, and goes on as one child with the rest."""
    whole = setting(compacted_cluster(40, amount=0.4, seed=2))
    full = rc.break_up(*whole, rc.simple_shear(1.0))
    rate = 0.5 * (full.initiation_rate + full.breakup_rate)
    result = rc.cascade(*whole, rc.simple_shear(rate))
    lost = [failure.contact for failure in full.failures if failure.reached <= rate]
    assert 0 < len(lost) < len(full.failures)
    assert len(result.remaining) == 1
    assert len(result.pieces) == 2
    np.testing.assert_array_equal(result.remaining[0].pairs, np.delete(whole[0].pairs, lost, axis=0))


def test_table_has_a_row_per_piece():
    whole = setting(straight_chain(8), 6 * np.pi * 16)
    result = rc.cascade(*whole, ALONG_X.scaled(1.5))
    table = result.table()
    assert {len(column) for column in table.values()} == {3}
    assert table["parent"].tolist() == [-1, 0, 0]
    assert table["spheres"].tolist() == [8, 4, 4]
    assert table["holds"].tolist() == [0, 1, 1]
    assert table["breakup_rate_per_s"][0] == pytest.approx(ALONG_X.rate)
    assert np.isinf(table["breakup_rate_per_s"][1:]).all()
    assert table["radius_of_gyration_m"][1] == pytest.approx(np.sqrt(5 + 3 / 5))


def test_progress_ends_at_one():
    seen = []
    rc.cascade(*setting(straight_chain(8), 10.0), ALONG_X, progress=lambda step, share: seen.append(share))
    assert seen == sorted(seen)
    assert seen[-1] == 1.0


def test_unknown_orientation():
    with pytest.raises(
        ValueError, match="orientation: expected one of 'given', 'worst', 'orbit' or a rotation, got 'any'"
    ):
        rc.cascade(*setting(straight_chain(3)), ALONG_X, orientation="any")


def test_by_a_rotation_as_if_the_flow_were_turned():
    turn = rc.random_orientations(1, seed=2)[0]
    whole, flow = setting(cluster_cluster(20, seed=1)), rc.simple_shear(0.2)
    turned = rc.cascade(*whole, flow, orientation=turn)
    given = rc.cascade(*whole, flow.rotated(turn))
    assert len(turned.pieces) > 3
    assert [piece.spheres.tolist() for piece in turned.pieces] == [piece.spheres.tolist() for piece in given.pieces]
    assert turned.flow is flow


@pytest.mark.parametrize("gradient", [np.zeros((3, 3)), [[0, -1.0, 0], [1, 0, 0], [0, 0, 0]]])
def test_flow_without_strain(gradient):
    with pytest.raises(ValueError, match="flow: expected a strain rate that is not zero, got none; a rotation loads"):
        rc.cascade(*setting(straight_chain(3)), rc.LinearFlow(gradient))


def test_nonsense_is_refused_whatever_the_aggregate():
    """A single sphere, of which nothing can break, and spheres that the response does not belong to."""
    one = rc.Aggregate.touching(rc.Spheres([[0, 0, 0]], 1.0))
    response = rc.rigid_response(one.spheres, rc.FreeDraining(), 1.0)
    bonds, flow = rc.Bonds(1.0, 1.0, 1.0, 1.0, 1.0), rc.simple_shear(1.0)
    assert len(rc.cascade(one, response, bonds, flow).pieces) == 1
    with pytest.raises(ValueError, match=r"^orientation: expected one of 'given', .* or a rotation, got 'best'$"):
        rc.cascade(one, response, bonds, flow, orientation="best")
    with pytest.raises(ValueError, match=r"^rule: expected 'weakest' or 'overloaded', got 'strongest'$"):
        rc.cascade(one, response, bonds, flow, rule="strongest")
    with pytest.raises(rc.GeometryError, match="solved for other spheres"):
        rc.cascade(rc.generation.straight_chain(3), response, bonds, flow)
