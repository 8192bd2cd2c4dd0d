"""Frames that hold together but move without resistance: which of their parts move against each other."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import bsr_array
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.graphs import connected_parts

FREE = 1e-13  # stiffness against a motion, over the largest of a node, that counts as none
SHIFT = 1e-9
MOVES = 1e-4  # of the largest relative motion in a joint
DENSE = 600  # unknowns
MOST_MOTIONS = 24


def moving_parts(pairs: IntArray, sides: bsr_array, elongation: bsr_array, removed: IntArray) -> IntArray:
    """Part (N,) of a connected frame that each node moves with, when it can move without resistance.

    The motions are eigenvectors of the stiffness with eigenvalues of zero, node 0 being held; parts are the nodes that
    stay connected by joints whose two sides move together in all of them.

    Parameters
    ----------
    pairs
        (C, 2) nodes of every joint.
    sides, elongation
        (6C, 6N) relative displacement of the joints' sides from displacements of the nodes, without and with the root
        of the stiffness as a factor.
    removed
        (R,) joints that are not there.
    """
    there = np.delete(np.arange(len(pairs)), removed)
    rows = (6 * there[:, None] + np.arange(6)).ravel()
    stretch = elongation.tocsr()[rows, 6:]
    with one_blas_thread():
        motions = _free_motions((stretch.T @ stretch).tocsc())
    apart = np.abs((sides.tocsr()[rows, 6:] @ motions).reshape(len(there), 6, -1)).max(axis=1)
    largest = apart.max(axis=0)
    together = (apart <= MOVES * largest).all(axis=1)
    return connected_parts(sides.shape[1] // 6, pairs[there[together]])


def _free_motions(stiffness: bsr_array) -> FloatArray:
    """Displacements (n, K) with the least stiffness, at least one: those that have none to rounding."""
    size, scale = stiffness.shape[0], stiffness.diagonal().max()
    if size <= DENSE:
        values, vectors = eigh(stiffness.toarray())
    else:
        # A shift below zero makes the matrix definite, and its inverse bring out what is softest.
        shift = SHIFT * scale
        diagonal = stiffness.copy()
        diagonal.setdiag(stiffness.diagonal() + shift)
        inverse = LinearOperator(stiffness.shape, splu(diagonal).solve, dtype=np.float64)
        start = np.random.default_rng(0).standard_normal(size)
        values, vectors = eigsh(stiffness, MOST_MOTIONS, sigma=-shift, OPinv=inverse, v0=start)
    free = values <= FREE * scale
    free[values.argmin()] = True
    return vectors[:, free]
