"""Motion of the sides of a joint, from its definition."""

import numpy as np
import pytest

from rheoclast.frames.kinematics import joint_axes, side_displacements

RANDOM = np.random.default_rng(4)
NODES = RANDOM.normal(size=(6, 3))
PAIRS = np.array([[0, 1], [2, 1], [4, 2], [3, 5], [5, 0]])
POINTS = RANDOM.normal(size=(5, 3))


@pytest.mark.parametrize("direction", [*np.eye(3), *-np.eye(3), [1, 1e-9, 0], [-1, 0, 1e-9], [1, 2, -3]])
def test_first_axis_is_the_normal_and_the_others_lie_across(direction):
    """Also where the reflection that makes them is nearly none."""
    (axes,) = joint_axes(np.array([[0.5, 0, 2], 0.5 * np.eye(3)[0] + 2 * np.eye(3)[2] + direction]), np.array([[0, 1]]))
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-15)
    normal = np.array(direction) / np.linalg.norm(direction)
    assert np.abs(axes[:, 0] @ normal) == pytest.approx(1, abs=1e-15)


def test_sides_part_by_the_motion_of_one_less_that_of_the_other():
    """A side moves by u + θ × (p − x), turns by θ; here joint by joint."""
    axes = joint_axes(NODES, PAIRS)
    moved = RANDOM.normal(size=(6, 6))
    parted = (side_displacements(NODES, PAIRS, POINTS, axes) @ moved.ravel()).reshape(-1, 2, 3)
    for joint, (i, j) in enumerate(PAIRS):
        first, second = (moved[k, :3] + np.cross(moved[k, 3:], POINTS[joint] - NODES[k]) for k in (i, j))
        np.testing.assert_allclose(axes[joint] @ parted[joint, 0], second - first, atol=1e-14)
        np.testing.assert_allclose(axes[joint] @ parted[joint, 1], moved[j, 3:] - moved[i, 3:], atol=1e-14)


def test_loads_of_the_joints_balance_the_loads_on_the_nodes():
    """What acts on a node from its joints, and from outside, has no resultant about the node."""
    axes = joint_axes(NODES, PAIRS)
    carried = RANDOM.normal(size=(5, 2, 3))
    loads = (side_displacements(NODES, PAIRS, POINTS, axes).T @ carried.ravel()).reshape(-1, 2, 3)
    for joint, (i, j) in enumerate(PAIRS):
        force, moment = carried[joint] @ axes[joint].T
        for node, sign in ((i, 1.0), (j, -1.0)):
            loads[node, 0] += sign * force
            loads[node, 1] += sign * (np.cross(POINTS[joint] - NODES[node], force) + moment)
    np.testing.assert_allclose(loads, 0, atol=1e-14)
