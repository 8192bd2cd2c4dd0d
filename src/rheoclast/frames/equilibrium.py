"""Balance of force and moment on every node."""

from __future__ import annotations

import numpy as np
from scipy.sparse import bsr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast.vectors import cross_matrix


def equilibrium_matrix(nodes: FloatArray, pairs: IntArray, points: FloatArray) -> bsr_array:
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
    blocks[:, :, :3, 3:] = cross_matrix(points[:, None] - nodes[pairs]).swapaxes(-2, -1)
    blocks[:, 1] *= -1
    # A row of Tᵀ has the blocks of the joint's two nodes, as they are listed.
    transposed = (blocks.reshape(-1, 6, 6), pairs.ravel(), np.arange(0, 2 * count + 1, 2))
    return bsr_array(transposed, shape=(6 * count, 6 * len(nodes))).T
