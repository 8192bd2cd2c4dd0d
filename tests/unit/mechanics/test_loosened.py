"""Contact loads while contacts are lost: SI units, batches, and an aggregate that never had them."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.frames.removal import CollapseError
from rheoclast.mechanics.loosened import loosenable

RADIUS = 2e-6
BALL = rc.generation.random_packed_ball(20, radius=RADIUS, seed=3)
TREE = rc.generation.cluster_cluster(12, radius=RADIUS, seed=3)


def bonds(contacts, seed=1):
    """Springs in N/m and N m, each contact its own."""
    unit = np.array([20.0, 15.0, 0.1 * RADIUS**2, 0.2 * RADIUS**2])[:, None]
    normal, tangential, bending, twisting = unit * np.random.default_rng(seed).uniform(0.5, 2.0, (4, contacts))
    return rc.Bonds(normal=normal, tangential=tangential, bending=bending, twisting=twisting)


def some(each, contacts):
    """The bonds of some contacts."""
    return rc.Bonds(
        normal=each.normal[contacts],
        tangential=each.tangential[contacts],
        bending=each.bending[contacts],
        twisting=each.twisting[contacts],
    )


def loads(aggregate, batch=(), seed=2):
    """Random loads (..., N, 3) of nanonewtons without resultant."""
    force, torque = np.random.default_rng(seed).normal(size=(2, *batch, len(aggregate), 3)) * 1e-9
    arms = aggregate.spheres.centers - aggregate.spheres.center_of_mass
    force -= force.mean(axis=-2, keepdims=True)
    torque *= RADIUS
    torque -= (torque + np.cross(arms, force)).mean(axis=-2, keepdims=True)
    return rc.SphereLoads(force, torque)


def assert_same(one, other):
    for name in ("force", "moment"):
        mine, expected = getattr(one, name), getattr(other, name)
        np.testing.assert_allclose(mine, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("batch", [(), (3,), (2, 3)])
@pytest.mark.parametrize("aggregate", [BALL, TREE], ids=["ball", "tree"])
def test_with_all_contacts_it_carries_contact_loads(aggregate, batch):
    """In N and N m, whatever the shape of the batch."""
    springs, load = bonds(len(aggregate.pairs)), loads(aggregate, batch)
    state = loosenable(aggregate, springs).loaded(load)
    assert state.loads.force.shape == (*batch, len(aggregate.pairs), 3)
    assert_same(state.loads, rc.contact_loads(aggregate, load, springs))
    assert state.lost.shape == (0,)
    assert state.residual < 1e-12


@pytest.mark.parametrize("batch", [(), (3,)])
def test_without_contacts_it_carries_what_an_aggregate_that_never_had_them_does(batch):
    springs, load = bonds(len(BALL.pairs)), loads(BALL, batch)
    state = loosenable(BALL, springs).loaded(load).without(4).without([0, 9])
    np.testing.assert_array_equal(state.lost, [4, 0, 9])
    assert state.aggregate is BALL
    left = np.delete(np.arange(len(BALL.pairs)), state.lost)
    expected = rc.contact_loads(rc.Aggregate(BALL.spheres, BALL.pairs[left]), load, some(springs, left))
    carried = rc.ContactLoads(BALL.normals[left], state.loads.force[..., left, :], state.loads.moment[..., left, :])
    assert_same(carried, expected)
    np.testing.assert_array_equal(state.loads.force[..., state.lost, :], 0)
    np.testing.assert_array_equal(state.loads.moment[..., state.lost, :], 0)
    assert state.residual < 1e-9


def test_a_tree_falls_apart_at_any_contact():
    """The two sides are those that the contact joined."""
    state = loosenable(TREE, bonds(len(TREE.pairs))).loaded(loads(TREE))
    for contact, (i, j) in enumerate(TREE.pairs):
        with pytest.raises(CollapseError, match=f"^without joint {contact} the frame falls into parts of") as raised:
            state.without(contact)
        assert raised.value.parts[i] != raised.value.parts[j]


def test_bonds_that_do_not_hold_the_spheres_are_refused():
    """With what to change; a tree does not ask."""
    square = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], 1.0))
    soft = rc.Bonds(normal=1.0, tangential=1e-40, bending=1e-40, twisting=1e-40)
    with pytest.raises(ValueError, match=r"^bonds: expected contacts that hold the spheres, got some .* closer to the"):
        loosenable(square, soft)
    assert loosenable(TREE, soft).loaded(loads(TREE)).residual == 0


def test_what_contact_loads_refuses():
    with pytest.raises(ValueError, match=r"^the aggregate is a single sphere"):
        loosenable(rc.Aggregate.touching(rc.Spheres([[0.0, 0, 0]], 1.0)), bonds(1))
    with pytest.raises(ValueError, match=r"^loads: expected one per sphere \(20\), got 12$"):
        loosenable(BALL, bonds(len(BALL.pairs))).loaded(loads(TREE))
