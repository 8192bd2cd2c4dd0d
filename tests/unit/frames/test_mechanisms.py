"""Parts of a frame that move against each other without resistance."""

import numpy as np
import pytest
from scipy.linalg import null_space

from rheoclast.frames import mechanisms
from rheoclast.frames.mechanisms import moving_parts
from rheoclast.frames.springs import spring_frame
from rheoclast.graphs import connected_parts
from rheoclast.vectors import cross_matrix

STIFF = np.array([1.0, 0.8, 5.7e-3, 7.7e-3])
BALL = np.array([1.0, 0.8, 0.0, 0.0])  # takes no moment
TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]])
TETRAHEDRON = np.vstack([TRIANGLE, [1, 1 / np.sqrt(3), np.sqrt(8 / 3)]])
TWO_TETRAHEDRA = np.vstack([TETRAHEDRON, TETRAHEDRON * [1, 1, -1] - [0, 0, 2]])
NONE = np.empty(0, dtype=np.intp)


def touching(nodes):
    """Joints of unit spheres that touch."""
    first, second = np.triu_indices(len(nodes), 1)
    near = np.linalg.norm(nodes[second] - nodes[first], axis=1) < 2.01
    return np.stack([first[near], second[near]], axis=1)


def block(side):
    """Part of an fcc lattice of unit spheres."""
    sites = np.indices((side, side, side)).reshape(3, -1).T
    return np.sqrt(2.0) * sites[sites.sum(axis=1) % 2 == 0]


def chain(count):
    return np.outer(2.0 * np.arange(count), [1, 0, 0])


def ring(count):
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) / np.sin(np.pi / count)


def parts(nodes, pairs, stiffness, removed=NONE):
    """`moving_parts` of nodes joined halfway."""
    constants = np.broadcast_to(stiffness, (len(pairs), 4))
    frame = spring_frame(nodes, pairs, nodes[pairs].mean(axis=1), constants)
    return moving_parts(frame.without(np.asarray(removed, dtype=np.intp)))


def parts_by_constraints(nodes, pairs, takes_moment):
    """The same from the null space of kinematics: the point of a joint is one point of both its nodes.

    Nodes are of one part if they are joined by nodes that in every motion turn and move as one body.
    """
    rows = []
    for (i, j), stiff in zip(pairs, takes_moment, strict=True):
        point = nodes[[i, j]].mean(axis=0)
        row = np.zeros((6, len(nodes), 6))
        for node, sign in ((i, 1.0), (j, -1.0)):
            row[:3, node, :3], row[:3, node, 3:] = sign * np.eye(3), -sign * cross_matrix(point - nodes[node])
            row[3:, node, 3:] = sign * np.eye(3) * stiff
        rows.append(row.reshape(6, -1))
    motion = null_space(np.vstack(rows), rcond=1e-10).reshape(len(nodes), 6, -1)
    turning = motion[:, 3:]
    of_origin = motion[:, :3] - np.cross(turning, nodes[:, :, None], axis=1)
    body = np.concatenate([turning, of_origin], axis=1)
    one = np.abs(body[pairs[:, 0]] - body[pairs[:, 1]]).max(axis=(1, 2)) < 1e-9
    return connected_parts(len(nodes), pairs[one])


@pytest.mark.parametrize("removed", range(3))
def test_two_bodies_on_a_hinge(removed):
    """Two tetrahedra, base on base: two of three joints between them that take no moment."""
    pairs = touching(TWO_TETRAHEDRA)
    between = np.flatnonzero((pairs[:, 0] < 4) & (pairs[:, 1] >= 4))
    found = parts(TWO_TETRAHEDRA, pairs, BALL, between[[removed]])
    np.testing.assert_array_equal(found, [0, 0, 0, 0, 1, 1, 1, 1])


@pytest.mark.parametrize("held", range(5))
def test_a_sphere_on_one_joint(held):
    """Whichever node is the one that is held: the sphere and the tetrahedron."""
    order = np.roll(np.arange(5), held)
    nodes = np.vstack([TETRAHEDRON, [-2, 0, 0]])[order]
    found = parts(nodes, touching(nodes), BALL)
    np.testing.assert_array_equal(found == found[np.flatnonzero(order == 4)], order == 4)
    assert found.max() == 1


@pytest.mark.parametrize("count", [2, 3, 5])
def test_links_of_a_chain(count):
    """Stiff pieces of four spheres on ball joints."""
    nodes = chain(4 * count)
    pairs = touching(nodes)
    stiffness = np.where((pairs[:, [0]] % 4 == 3), BALL, STIFF)
    np.testing.assert_array_equal(parts(nodes, pairs, stiffness), np.repeat(np.arange(count), 4))


def test_a_ring_of_ball_joints_is_all_links():
    np.testing.assert_array_equal(parts(ring(7), touching(ring(7)), BALL), np.arange(7))


def test_spheres_that_only_normal_springs_hold_turn_each_by_itself():
    pairs = touching(TETRAHEDRON)
    np.testing.assert_array_equal(parts(TETRAHEDRON, pairs, [1.0, 0, 0, 0]), np.arange(4))


@pytest.mark.parametrize("seed", range(12))
def test_parts_are_the_bodies_of_kinematics(seed):
    """Part of a lattice that some random joints hold, most of them without moment."""
    rng = np.random.default_rng(seed)
    nodes = block(3)[rng.permutation(14)]
    pairs = touching(nodes)
    while True:
        there = np.flatnonzero(rng.random(len(pairs)) < 0.55)
        if not connected_parts(len(nodes), pairs[there]).any():
            break
    takes_moment = rng.random(len(pairs)) < 0.3
    expected = parts_by_constraints(nodes, pairs[there], takes_moment[there])
    assert 0 < expected.max() < len(nodes) - 1
    removed = np.setdiff1d(np.arange(len(pairs)), there)
    np.testing.assert_array_equal(parts(nodes, pairs, np.where(takes_moment[:, None], STIFF, BALL), removed), expected)


def two_blocks_on_a_ball_joint(side):
    """Two pieces of a lattice, joined by one joint of another kind: nodes, joints, stiffnesses and parts."""
    one = block(side)
    nodes = np.vstack([one, one + one[-1] + [2, 0, 0]])
    pairs = touching(nodes)
    bridge = (pairs[:, 0] < len(one)) & (pairs[:, 1] >= len(one))
    return nodes, pairs, np.where(bridge[:, None], BALL, STIFF), np.repeat([0, 1], len(one))


@pytest.mark.parametrize("factor", [1e-20, 1e20])
def test_unit_of_stiffness_does_not_matter(factor):
    nodes, pairs, stiffness, expected = two_blocks_on_a_ball_joint(3)
    np.testing.assert_array_equal(parts(nodes, pairs, factor * stiffness), expected)


def test_joints_removed_and_joints_that_never_were():
    nodes, pairs, stiffness, expected = two_blocks_on_a_ball_joint(3)
    bridge = stiffness[:, 2] == 0
    lost = np.flatnonzero(~bridge)[[3, 20, 41]]
    np.testing.assert_array_equal(parts(nodes, pairs, stiffness, lost), expected)
    np.testing.assert_array_equal(
        parts(nodes, np.delete(pairs, lost, axis=0), np.delete(stiffness, lost, axis=0)), expected
    )


@pytest.mark.parametrize("bending", [1e-3, 1e-6, 1e-9])
def test_soft_is_not_loose(bending):
    """Joints that hardly resist bending still make one body of their nodes."""
    nodes, pairs, stiffness, expected = two_blocks_on_a_ball_joint(3)
    soft = np.where(stiffness == 0, 0, np.minimum(stiffness, [1, 1, bending, bending]))
    np.testing.assert_array_equal(parts(nodes, pairs, soft), expected)


class TestLargeFrames:
    """Above `DENSE` unknowns, only some of the softest motions are computed."""

    def test_one_ball_joint(self):
        nodes, pairs, stiffness, expected = two_blocks_on_a_ball_joint(5)
        assert 6 * len(nodes) > mechanisms.DENSE
        np.testing.assert_array_equal(parts(nodes, pairs, stiffness), expected)

    @pytest.mark.parametrize("seed", range(3))
    def test_as_with_all_motions(self, monkeypatch, seed):
        """Some spheres on two joints each."""
        rng = np.random.default_rng(seed)
        nodes = block(4)
        pairs = touching(nodes)
        loose = rng.choice(np.flatnonzero(np.bincount(pairs.ravel()) == 3), 2, replace=False)
        removed = [np.flatnonzero((pairs == node).any(axis=1))[0] for node in loose]
        expected = parts(nodes, pairs, BALL, removed)
        assert sorted(np.bincount(expected).tolist()) == [1, 1, len(nodes) - 2]
        monkeypatch.setattr(mechanisms, "DENSE", 0)
        np.testing.assert_array_equal(parts(nodes, pairs, BALL, removed), expected)

    @pytest.mark.parametrize("count", [2, 8, 9])
    def test_spheres_that_each_stand_on_one_other(self, count):
        """Three free motions for each of them; there may be more than `MOST_MOTIONS`."""
        nodes = block(6)
        sites = np.rint(nodes / np.sqrt(2))
        apart = nodes[(sites[:, 2] == 5) & (sites[:, 0] % 2 == 0)][:count]
        assert len(apart) == count
        nodes = np.vstack([nodes, apart + np.array([0, 0, 2])])
        assert 6 * len(nodes) > mechanisms.DENSE
        found = parts(nodes, touching(nodes), BALL)
        np.testing.assert_array_equal(found, np.maximum(np.arange(len(nodes)) - 107, 0))

    @pytest.mark.parametrize("layers", [1, 2])
    def test_layers_of_spheres_on_top(self, layers):
        """Square layers whose spheres each stand on one other, above and below: only spheres of the block hold."""
        lattice, step = block(6), np.array([0, 0, 2])
        ends = [lattice[lattice[:, 2] == edge] for edge in (lattice[:, 2].max(), lattice[:, 2].min())]
        nodes = np.vstack([lattice, ends[0] + step, ends[1] - step][: 1 + layers])
        np.testing.assert_array_equal(parts(nodes, touching(nodes), BALL), np.maximum(np.arange(len(nodes)) - 107, 0))


@pytest.mark.parametrize("count", [20, 90, 200])
def test_slender_is_not_loose(count):
    """A straight chain of stiff joints on whose end a sphere turns about the line of two joints."""
    nodes = np.vstack([chain(count), [2 * count - 3, np.sqrt(3), 0]])
    pairs = touching(nodes)
    stiffness = np.where((pairs == count).any(axis=1)[:, None], BALL, STIFF)
    np.testing.assert_array_equal(parts(nodes, pairs, stiffness), np.arange(count + 1) == count)
