"""Spring frames: rigid nodes whose joints yield by a normal, a tangential, a bending and a twisting spring."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.sparse import bsr_array, csr_array
from scipy.sparse.linalg import splu

from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.cholesky import frontal_cholesky
from rheoclast.frames.dissection import dissection
from rheoclast.frames.equilibrium import equilibrium_matrix

LARGEST_BY_SUPERLU = 5000  # nodes; the fronts' BLAS pays beyond
ROUNDING = 1e-13
MOST_REFINEMENTS = 12


class Factor(Protocol):
    """Factors of a matrix, ready to solve with."""

    def solve(self, rhs: FloatArray, /) -> FloatArray:
        """Solution (n, K) for right-hand sides (n, K)."""


@dataclass(frozen=True, eq=False)
class SpringFrame:
    """A factorized frame, ready for any number of load cases. Made by `spring_frame`.

    Attributes
    ----------
    equilibrium
        (6N, 6C) loads of the joints to loads on the nodes.
    stress
        (6C, 6N) displacements of the nodes to loads of the joints: −D Tᵀ with the springs' stiffness D.
    factor
        Factors of the stiffness with node 0 held.
    """

    equilibrium: bsr_array
    stress: bsr_array
    factor: Factor

    def joint_loads(self, loads: FloatArray) -> FloatArray:
        """Joint loads (C, 6, K) under balanced loads (N, 6, K).

        The displacements of a slender frame are large and its joint loads small differences of them, so what the first
        solution leaves unbalanced is solved for again, and only joint loads are added up, until they balance to
        rounding.

        Raises
        ------
        ArithmeticError
            If balance is not reached because the stiffnesses differ by too many decades.
        """
        cases = loads.reshape(-1, loads.shape[-1])
        size = np.abs(cases).max(axis=0)
        carried = np.zeros((self.stress.shape[0], cases.shape[1]))
        moved = np.zeros_like(cases)
        unbalanced, left = cases, size
        for _ in range(MOST_REFINEMENTS):
            moved[6:] = self.factor.solve(unbalanced[6:])
            carried += self.stress @ moved
            unbalanced = cases + self.equilibrium @ carried
            before, left = left, np.abs(unbalanced[6:]).max(axis=0)
            if (left <= ROUNDING * size).all() or (left > 0.5 * before).all():
                break
        if (left <= ROUNDING * np.maximum(np.abs(carried).max(axis=0), size)).all():
            return carried.reshape(-1, 6, cases.shape[1])
        raise ArithmeticError(
            f"the frame of {len(cases) // 6} spheres does not balance: {left.max():.2g} of a largest load "
            f"{size.max():.2g} is left after refinement; "
            "bring the stiffnesses closer together, or use statics if the contacts form a tree"
        )


def spring_frame(nodes: FloatArray, pairs: IntArray, points: FloatArray, stiffness: FloatArray) -> SpringFrame:
    """Assemble and factorize a connected frame.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints.
    stiffness
        (C, 4) normal, tangential, bending and twisting stiffness, all positive. The normal of a joint points from its
        first node to its second.
    """
    equilibrium = equilibrium_matrix(nodes, pairs, points)
    difference = nodes[pairs[:, 1]] - nodes[pairs[:, 0]]
    normals = difference / np.linalg.norm(difference, axis=1, keepdims=True)
    stress = -joint_stiffness(normals, stiffness) @ equilibrium.T
    held = (-equilibrium @ stress).tocsr()[6:, 6:]
    try:
        factor = _factorized(held, nodes[1:], pairs[(pairs > 0).all(axis=1)] - 1)
    except (RuntimeError, ArithmeticError):  # SuperLU met a pivot of zero, or Cholesky none above it
        raise ArithmeticError(
            "the frame is singular to rounding: the stiffnesses differ by too many decades; bring them closer together"
        ) from None
    return SpringFrame(equilibrium, stress, factor)


def _factorized(stiffness: csr_array, nodes: FloatArray, pairs: IntArray) -> Factor:
    if len(nodes) > LARGEST_BY_SUPERLU:
        return frontal_cholesky(stiffness.tobsr((6, 6)), dissection(nodes, pairs))
    # Positive definite: pivots stay on the diagonal, and a symmetric ordering halves the fill.
    options = {"SymmetricMode": True}
    return splu(stiffness.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)


def joint_stiffness(normals: FloatArray, stiffness: FloatArray) -> bsr_array:
    """Block-diagonal stiffness (6C, 6C) in fixed axes: along n and across it, for force and for moment."""
    along = normals[:, :, None] * normals[:, None, :]
    across = np.eye(3) - along
    normal, tangential, bending, twisting = stiffness.T[:, :, None, None]
    blocks = np.zeros((len(normals), 6, 6))
    blocks[:, :3, :3] = normal * along + tangential * across
    blocks[:, 3:, 3:] = twisting * along + bending * across
    count = len(normals)
    return bsr_array((blocks, np.arange(count), np.arange(count + 1)), shape=(6 * count, 6 * count))
