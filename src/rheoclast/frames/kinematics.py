"""How far the two sides of a joint move apart when the nodes move."""

from __future__ import annotations

import numpy as np
from scipy.sparse import bsr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast.vectors import cross_matrix


def joint_axes(nodes: FloatArray, pairs: IntArray) -> FloatArray:
    """Axes (C, 3, 3) of every joint, orthonormal columns: first along its normal, then two across it.

    They are a Householder reflection, which takes the x axis to the normal or its opposite. Which of the two, and how
    the others lie, makes no difference to springs that resist both ways and alike in all directions across.
    """
    axes = nodes[pairs[:, 1]] - nodes[pairs[:, 0]]
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    mirror = axes + np.where(axes[:, :1] < 0, -1.0, 1.0) * [1.0, 0.0, 0.0]
    return np.eye(3) - mirror[:, :, None] * (2 * mirror / (mirror**2).sum(axis=1, keepdims=True))[:, None]


def side_displacements(nodes: FloatArray, pairs: IntArray, points: FloatArray, axes: FloatArray) -> bsr_array:
    """Sparse matrix A (6C, 6N): how far the sides of the joints part, and turn apart, as the nodes move and turn.

    Second side less first, in the axes of the joint. If the joints exert loads f in these axes, Aᵀ f are the external
    loads on the nodes that balance them: a joint's force and moment act as (f, r × f + m) on its first node and as
    the opposite on its second, with r the arm from the node to the joint's point.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints.
    axes
        (C, 3, 3) axes of the joints as columns.
    """
    count = len(pairs)
    along = np.array([-1.0, 1.0])[:, None, None] * axes.swapaxes(1, 2)[:, None]
    blocks = np.zeros((count, 2, 6, 6))
    blocks[:, :, :3, :3] = blocks[:, :, 3:, 3:] = along
    blocks[:, :, :3, 3:] = along @ cross_matrix(nodes[pairs] - points[:, None])
    # A row of A has the blocks of the joint's two nodes, as they are listed.
    indices = pairs.ravel().astype(np.int32)  # as SuperLU wants them, whose conversion would take its time
    rows = (blocks.reshape(-1, 6, 6), indices, np.arange(0, 2 * count + 1, 2, dtype=np.int32))
    return bsr_array(rows, shape=(6 * count, 6 * len(nodes)))
