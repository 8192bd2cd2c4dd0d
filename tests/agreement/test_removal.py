"""Joints removed one after the other ↔ the remaining frame solved anew ↔ statics, where a tree is left."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

import rheoclast as rc
from rheoclast import generation
from rheoclast.frames.removal import CollapseError, removable_frame
from rheoclast.frames.springs import spring_frame
from rheoclast.frames.statics import tree_loads
from rheoclast.vectors import cross_matrix


def of_spheres(aggregate):
    """Nodes, pairs, points in units of a radius."""
    length = aggregate.spheres.radii.mean()
    return aggregate.spheres.centers / length, aggregate.pairs, aggregate.contact_points / length


def ring(count):
    angle = 2 * np.pi * np.arange(count) / count
    nodes = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) / np.sin(np.pi / count)
    return of_spheres(rc.Aggregate.touching(rc.Spheres(nodes, 1.0)))


def looped_tree(count, loops, seed):
    """A fractal cluster, with joints more between spheres that nearly touch."""
    nodes, pairs, points = of_spheres(generation.cluster_cluster(count, seed=seed))
    first, second = np.triu_indices(count, 1)
    distance = np.linalg.norm(nodes[second] - nodes[first], axis=1)
    nearest = np.lexsort((distance, distance < 2 + 1e-6))[:loops]
    closing = np.stack([first, second], axis=1)[nearest]
    return nodes, np.vstack([pairs, closing]), np.vstack([points, nodes[closing].mean(axis=1)])


def random_graph(count, joints, seed):
    """Nodes anywhere, each joined to one before it, and some joints more; points near the middle of a joint."""
    rng = np.random.default_rng(seed)
    nodes = rng.uniform(-2, 2, (count, 3))
    tree = np.stack([np.arange(1, count), [rng.integers(k) for k in range(1, count)]], axis=1)
    first = rng.integers(0, count, joints - len(tree))
    more = np.stack([first, (first + rng.integers(1, count, len(first))) % count], axis=1)
    pairs = np.vstack([tree, more])
    return nodes, pairs, nodes[pairs].mean(axis=1) + rng.uniform(-0.3, 0.3, (joints, 3))


FRAMES = {
    "fcc ball": lambda: of_spheres(generation.lattice_ball("fcc", 60)),
    "packed ball": lambda: of_spheres(generation.random_packed_ball(50, seed=1)),
    "looped tree": lambda: looped_tree(60, 25, 2),
    "ring": lambda: ring(20),
    "random graph": lambda: random_graph(30, 90, 3),
}


def spring_constants(count, seed=4):
    """Over two decades."""
    return 10 ** np.random.default_rng(seed).uniform(-1, 1, (count, 4))


def balanced(nodes, cases=5, seed=5):
    """Random loads (N, 6, K) without resultant."""
    loads = np.random.default_rng(seed).normal(size=(len(nodes), 6, cases))
    arms = cross_matrix(nodes - nodes.mean(axis=0))
    for _ in range(2):
        loads[:, :3] -= loads[:, :3].mean(axis=0)
        loads[:, 3:] -= (loads[:, 3:] + arms @ loads[:, :3]).mean(axis=0)
    return loads


def left_over(nodes, pairs, points, loads, carried):
    """Largest force or torque on any node, over the largest load."""
    total = loads.copy()
    for end, sign in ((0, 1.0), (1, -1.0)):
        force = sign * carried[:, :3]
        moment = sign * carried[:, 3:] + cross_matrix(points - nodes[pairs[:, end]]) @ force
        np.add.at(total, pairs[:, end], np.concatenate([force, moment], axis=1))
    return np.abs(total).max() / np.abs(loads).max()


def assert_solved_anew(frame, stiffness, state, tolerance):
    nodes, pairs, points = frame
    there = np.delete(np.arange(len(pairs)), state.removed)
    anew = spring_frame(nodes, pairs[there], points[there], stiffness[there]).joint_loads(state.loads)
    np.testing.assert_allclose(state.joint_loads[there], anew, rtol=0, atol=tolerance * np.abs(anew).max())
    assert np.count_nonzero(state.joint_loads[state.removed]) == 0


def parts_without(frame, removed):
    """Number of connected parts."""
    nodes, pairs, _ = frame
    pairs = np.delete(pairs, removed, axis=0)
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(nodes), len(nodes)))
    return connected_components(graph, directed=False)[0]


@pytest.mark.parametrize("name", FRAMES)
def test_every_removal_equals_solving_anew_until_a_tree_is_left(name):
    """Joints in random order; those that hold two parts together are found by a search of the graph.

    What is left at last is decided by balance alone.
    """
    frame = FRAMES[name]()
    nodes, pairs, points = frame
    stiffness = spring_constants(len(pairs))
    state = removable_frame(*frame, stiffness).loaded(balanced(nodes))
    for joint in np.random.default_rng(6).permutation(len(pairs)):
        if parts_without(frame, np.append(state.removed, joint)) > 1:
            with pytest.raises(CollapseError, match=f"^without joint {joint} the frame falls into parts of"):
                state.without(joint)
            continue
        state = state.without(joint)
        assert state.residual < 1e-9
        if len(state.removed) % 4 == 1:
            assert_solved_anew(frame, stiffness, state, 1e-8)
    there = np.delete(np.arange(len(pairs)), state.removed)
    assert len(there) == len(nodes) - 1
    assert len(state.removed) > 0
    statics = tree_loads(nodes, pairs[there], points[there], state.loads)
    np.testing.assert_allclose(state.joint_loads[there], statics, rtol=0, atol=1e-8 * np.abs(statics).max())


def test_parts_are_those_that_a_walk_reaches():
    """Of a tree, for each of its joints."""
    frame = of_spheres(generation.cluster_cluster(40, seed=7))
    nodes, pairs, _ = frame
    state = removable_frame(*frame, spring_constants(len(pairs))).loaded(balanced(nodes))
    for joint, (first, second) in enumerate(pairs):
        with pytest.raises(CollapseError) as raised:
            state.without(joint)
        rest = np.delete(pairs, joint, axis=0)
        graph = coo_array((np.ones(len(rest)), rest.T), shape=(len(nodes), len(nodes)))
        parts = raised.value.parts
        for end in (first, second):
            reached = breadth_first_order(graph, end, directed=False, return_predecessors=False)
            np.testing.assert_array_equal(np.sort(reached), np.flatnonzero(parts == parts[end]))


@settings(deadline=None, max_examples=10, derandomize=True)
@given(st.permutations(range(0, 36, 3)), st.lists(st.booleans(), min_size=11, max_size=11))
def test_order_and_grouping_do_not_matter(order, cuts):
    """The same joints one by one, some at once, or all."""
    frame = of_spheres(generation.lattice_ball("fcc", 30))
    stiffness, loads = spring_constants(len(frame[1])), balanced(frame[0])
    start = removable_frame(*frame, stiffness).loaded(loads)
    together = start.without(range(0, 36, 3))
    state = start
    for group in np.split(np.array(order), 1 + np.flatnonzero(cuts)):
        state = state.without(group)
    np.testing.assert_array_equal(state.removed, order)
    size = np.abs(together.joint_loads).max()
    np.testing.assert_allclose(state.joint_loads, together.joint_loads, rtol=0, atol=1e-10 * size)


def test_a_crack_of_three_hundred_joints():
    """Always the joint of largest tension in one flow of five that the frame can do without: balance to the end."""
    frame = of_spheres(generation.lattice_ball("fcc", 300))
    nodes, pairs, points = frame
    normals = nodes[pairs[:, 1]] - nodes[pairs[:, 0]]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    stiffness = np.tile([1.0, 0.8, 5.7e-3, 7.7e-3], (len(pairs), 1))
    state = removable_frame(*frame, stiffness).loaded(balanced(nodes))
    needed: list[int] = []
    while len(state.removed) < 300:
        tension = (normals * state.joint_loads[:, :3, 0]).sum(axis=1)
        tension[needed] = 0.0
        try:
            state = state.without(int(tension.argmax()))
        except CollapseError:
            needed.append(int(tension.argmax()))
            continue
        assert state.residual < 1e-9
        if len(state.removed) % 100 == 0:
            assert_solved_anew(frame, stiffness, state, 1e-9)
    assert left_over(nodes, pairs, points, state.loads, state.joint_loads) < 1e-8
