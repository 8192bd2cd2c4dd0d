"""Removal of joints from a loaded tree."""

import numpy as np
import pytest

from rheoclast.frames.removable_tree import RemovableTree
from rheoclast.frames.removal import CollapseError, removable_frame
from rheoclast.vectors import cross_matrix


def grown(count, seed):
    """Nodes, pairs and points of a random tree; joints in random order, either way round."""
    rng = np.random.default_rng(seed)
    nodes, pairs = [np.zeros(3)], []
    for new in range(1, count):
        old, step = int(rng.integers(new)), rng.normal(size=3)
        nodes.append(nodes[old] + 2 * step / np.linalg.norm(step))
        pairs.append(rng.permutation([old, new]))
    nodes, pairs = np.array(nodes), rng.permutation(np.array(pairs))
    return nodes, pairs, nodes[pairs].mean(axis=1)


def balanced(nodes, cases=2, seed=0):
    """Random loads (N, 6, K) without resultant."""
    loads = np.random.default_rng(seed).normal(size=(len(nodes), 6, cases))
    arms = nodes - nodes.mean(axis=0)
    loads[:, :3] -= loads[:, :3].mean(axis=0)
    loads[:, 3:] -= (loads[:, 3:] + cross_matrix(arms) @ loads[:, :3]).mean(axis=0)
    return loads


def chain(count):
    nodes = np.outer(2.0 * np.arange(count), [1, 0, 0])
    pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    return nodes, pairs, nodes[pairs].mean(axis=1)


@pytest.mark.parametrize("seed", range(4))
def test_carries_what_a_frame_of_any_stiffness_carries(seed):
    nodes, pairs, points = grown(20, seed)
    stiffness = np.random.default_rng(seed).uniform(0.1, 2.0, (19, 4))
    expected = removable_frame(nodes, pairs, points, stiffness).loaded(balanced(nodes))
    state = RemovableTree(nodes, pairs, points).loaded(balanced(nodes))
    np.testing.assert_allclose(state.joint_loads, expected.joint_loads, atol=1e-9)
    assert state.removed.shape == (0,)
    assert state.residual == 0
    with pytest.raises(ValueError, match="read-only"):
        state.joint_loads[0] = 0


@pytest.mark.parametrize("seed", range(4))
def test_every_joint_parts_it_into_its_two_sides(seed):
    """Those of a frame with the same joints."""
    nodes, pairs, points = grown(12, seed)
    state = RemovableTree(nodes, pairs, points).loaded(balanced(nodes))
    frame = removable_frame(nodes, pairs, points, np.ones((11, 4))).loaded(balanced(nodes))
    for joint in range(11):
        with pytest.raises(
            CollapseError, match=rf"^without joint {joint} the frame falls into parts of \d+, \d"
        ) as one:
            state.without(joint)
        with pytest.raises(CollapseError) as other:
            frame.without(joint)
        np.testing.assert_array_equal(one.value.parts, other.value.parts)
        first, second = one.value.parts[pairs[joint]]
        assert first != second
        kept = np.delete(pairs, joint, axis=0)
        assert (one.value.parts[kept[:, 0]] == one.value.parts[kept[:, 1]]).all()


def test_several_joints_at_once():
    """R joints make R + 1 parts; all joints make nodes that are alone."""
    nodes, pairs, points = chain(6)
    state = RemovableTree(nodes, pairs, points).loaded(balanced(nodes))
    with pytest.raises(
        CollapseError, match=r"^without joints 3, 1 the frame falls into parts of 2, 2, 2 nodes$"
    ) as two:
        state.without([3, 1])
    np.testing.assert_array_equal(two.value.parts, [0, 0, 1, 1, 2, 2])
    with pytest.raises(CollapseError, match=r"parts of 1, 1, 1, 1, 1, 1 nodes$") as every:
        state.without(np.arange(5))
    np.testing.assert_array_equal(every.value.parts, np.arange(6))


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        (5, r"^joints: expected indices from 0 to 4, got 5$"),
        (-1, r"^joints: expected indices from 0 to 4, got -1$"),
        ([2, 0, 2], r"^joints: joint 2 is given 2 times; give each once$"),
        ([], r"^joints: expected an index or a sequence of indices of joints, got \[\]$"),
        (0.0, r"^joints: expected an index or a sequence of indices of joints, got 0.0$"),
    ],
)
def test_refused_joints(joints, message):
    nodes, pairs, points = chain(6)
    with pytest.raises(ValueError, match=message):
        RemovableTree(nodes, pairs, points).loaded(balanced(nodes)).without(joints)


def test_refused_loads():
    nodes, pairs, points = chain(6)
    with pytest.raises(ValueError, match=r"^loads: expected shape \(6, 6, K\), got \(5, 6, 1\)$"):
        RemovableTree(nodes, pairs, points).loaded(np.zeros((5, 6, 1)))
