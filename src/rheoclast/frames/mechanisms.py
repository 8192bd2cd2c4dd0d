"""Frames that hold together but move without resistance: which of their parts move against each other."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csc_array
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.frames.cholesky import unknowns
from rheoclast.frames.springs import SpringFrame
from rheoclast.graphs import connected_parts

FREE = 1e-13  # stiffness against a motion, over the largest of a node, that counts as none: its rounding
SHIFT = 1e-9  # of that stiffness: far above rounding, and small enough to tell the softest motions apart
MOVES = 1e-4  # of the largest motion between two sides; the others' rounding is 1e-16 over the gap of eigenvalues
DENSE = 600  # unknowns up to which all motions are found, within some hundredths of a second
MOST_MOTIONS = 24  # computed in a large frame: those of eight nodes that turn about one point each


def moving_parts(frame: SpringFrame) -> IntArray:
    """Part (N,) of a connected frame that each node moves with, when it can move without resistance.

    The motions are eigenvectors of the stiffness with eigenvalues of zero, node 0 being held; parts are the nodes that
    stay connected by joints whose two sides move together in all of them. A joint without any stiffness connects
    nothing.
    """
    there = np.flatnonzero(frame.root.reshape(-1, 6).any(axis=1))
    with one_blas_thread():
        motions = _free_motions(frame.stiffness().tocsc())
    sides = frame.sides.tocsr()[unknowns(there, 6), 6:]
    apart = np.abs((sides @ motions).reshape(len(there), 6, motions.shape[1])).max(axis=1)
    together = (apart <= MOVES * apart.max(axis=0, initial=0.0)).all(axis=1)
    return connected_parts(len(frame.nodes), frame.pairs[there[together]])


def _free_motions(stiffness: csc_array) -> FloatArray:
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
