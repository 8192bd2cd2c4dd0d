"""Balance of force and moment on every node."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast.vectors import cross_matrix


def equilibrium_matrix(nodes: FloatArray, pairs: IntArray, points: FloatArray) -> csr_array:
    """Sparse matrix T (6N, 6C): force and torque on the nodes from the loads of the joints.

    A joint's force f and moment m act as (f, r × f + m) on its first node and as the opposite on its second, with r
    the arm from the node to the joint's point. Balance with external loads F is F + T f = 0; the relative displacement
    of a joint's two sides is −Tᵀ times the displacements of the nodes.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints.
    """
    count = len(pairs)
    blocks = np.zeros((count, 2, 6, 6))
    blocks[:] = np.eye(6)
    blocks[:, :, 3:, :3] = cross_matrix(points[:, None] - nodes[pairs])
    blocks[:, 1] *= -1
    six = np.arange(6)
    rows = np.broadcast_to(6 * pairs[:, :, None, None] + six[:, None], blocks.shape)
    columns = np.broadcast_to(6 * np.arange(count)[:, None, None, None] + six, blocks.shape)
    keep = blocks != 0
    return csr_array((blocks[keep], (rows[keep], columns[keep])), shape=(6 * len(nodes), 6 * count))
