"""Mobility blocks of pairs, compiled by Numba: the elements on the pair's axis, turned into the fixed frame.

In the frame of the pair few elements differ from zero. With T the rotation of every family, the block is the sum of
each such element times the outer product of two columns of T. Pairs are computed several at a time, one per lane of a
vector register, so that the innermost loops run over the lanes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray

Floats = NDArray[np.floating[Any]]

LANES = 32


class AxialElements(NamedTuple):
    """The E elements that differ from zero in the frame whose z axis runs from sphere j to sphere i.

    Element e joins a mode of sphere i, whose data stand in row 0, to one of sphere j, in row 1. Its value is
    ρ_i^l ρ_j^l' / r · [direct + extended · (ρ_i² / (2(2l + 3)) + ρ_j² / (2(2l' + 3)))], with ρ = a/r.

    Attributes
    ----------
    starts, places
        (2, E) first mode of the mode's family, and its place there.
    degrees, ranks
        (2, E) of the family.
    direct, extended
        (E,)
    quarter_turns
        (p + 1, 2p + 1, 2p + 1) turns that carry z to y in the harmonics of each degree, in the leading corners.
    """

    starts: IntArray
    places: IntArray
    degrees: IntArray
    ranks: IntArray
    direct: FloatArray
    extended: FloatArray
    quarter_turns: FloatArray


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def pair_blocks(
    separations: FloatArray, radii_i: FloatArray, radii_j: FloatArray, elements: AxialElements, out: FloatArray
) -> None:
    """Write the blocks of pairs to `out` (P, M, M): separations (P, 3) of i from j and radii (P,)."""
    count, modes = radii_i.size, out.shape[1]
    for group in prange((count + LANES - 1) // LANES):
        first = group * LANES
        x, y, z = np.ones(LANES), np.zeros(LANES), np.zeros(LANES)
        a, b = np.ones(LANES), np.ones(LANES)
        for lane in range(min(LANES, count - first)):
            pair = first + lane
            x[lane], y[lane], z[lane] = separations[pair]
            a[lane], b[lane] = radii_i[pair], radii_j[pair]
        blocks = np.zeros((modes, modes, LANES))
        _add_blocks(x, y, z, a, b, elements, blocks)
        for lane in range(min(LANES, count - first)):
            for m in range(modes):
                for n in range(modes):
                    out[first + lane, m, n] = blocks[m, n, lane]


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def matrix_rows(
    centers: FloatArray, radii: FloatArray, elements: AxialElements, first_row: int, end_row: int, out: FloatArray
) -> None:
    """Write the rows of some spheres of the matrix (M, N, M, N), all but the blocks of a sphere with itself."""
    count, modes = radii.size, out.shape[0]
    for i in prange(first_row, end_row):
        x, y, z = np.ones(LANES), np.zeros(LANES), np.zeros(LANES)
        a, b = np.full(LANES, radii[i]), np.ones(LANES)
        blocks = np.empty((modes, modes, LANES))
        for first in range(0, count, LANES):
            width = min(LANES, count - first)
            for lane in range(width):
                j = first + lane
                if j != i:
                    x[lane], y[lane], z[lane] = centers[i] - centers[j]
                    b[lane] = radii[j]
            blocks[:] = 0.0
            _add_blocks(x, y, z, a, b, elements, blocks)
            for m in range(modes):
                for n in range(modes):
                    out[m, i, n, first : first + width] = blocks[m, n, :width]


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def block_rows(
    centers: FloatArray,
    radii: FloatArray,
    elements: AxialElements,
    modes: int,
    starts: IntArray,
    members: IntArray,
    out: Floats,
) -> None:
    """Write the blocks of every sphere with its members, as `BlockRows` has them."""
    for i in prange(starts.size - 1):
        x, y, z = np.ones(LANES), np.zeros(LANES), np.zeros(LANES)
        a, b = np.full(LANES, radii[i]), np.ones(LANES)
        blocks = np.empty((modes, modes, LANES))
        width = (starts[i + 1] - starts[i]) * modes
        for first in range(starts[i], starts[i + 1], LANES):
            lanes = min(LANES, starts[i + 1] - first)
            for lane in range(lanes):
                j = members[first + lane]
                x[lane], y[lane], z[lane] = centers[i] - centers[j]
                b[lane] = radii[j]
            blocks[:] = 0.0
            _add_blocks(x, y, z, a, b, elements, blocks)
            for m in range(modes):
                place = starts[i] * modes**2 + m * width + (first - starts[i]) * modes
                for lane in range(lanes):
                    for n in range(modes):
                        out[place + lane * modes + n] = blocks[m, n, lane]


@njit(fastmath=True, error_model="numpy", cache=True)
def lower_triangle(
    centers: FloatArray, radii: FloatArray, members: IntArray, self_mobility: FloatArray, elements: AxialElements
) -> FloatArray:
    """Blocks on and below the diagonal of the matrix (n M, n M) of n spheres."""
    modes, count = self_mobility.size, members.size
    matrix = np.zeros((count * modes, count * modes))
    x, y, z = np.ones(LANES), np.zeros(LANES), np.zeros(LANES)
    a, b = np.ones(LANES), np.ones(LANES)
    rows, columns = np.empty(LANES, np.intp), np.empty(LANES, np.intp)
    blocks = np.empty((modes, modes, LANES))
    filled = 0
    for row in range(count):
        for m in range(modes):
            matrix[row * modes + m, row * modes + m] = self_mobility[m] / radii[members[row]]
        for column in range(row):
            i, j = members[row], members[column]
            x[filled], y[filled], z[filled] = centers[i] - centers[j]
            a[filled], b[filled] = radii[i], radii[j]
            rows[filled], columns[filled] = row * modes, column * modes
            filled += 1
            if filled == LANES or (row == count - 1 and column == row - 1):
                blocks[:] = 0.0
                _add_blocks(x, y, z, a, b, elements, blocks)
                for lane in range(filled):
                    for m in range(modes):
                        for n in range(modes):
                            matrix[rows[lane] + m, columns[lane] + n] = blocks[m, n, lane]
                filled = 0
    return matrix


@njit(fastmath=True, error_model="numpy", cache=True)
def _add_blocks(
    x: FloatArray,
    y: FloatArray,
    z: FloatArray,
    radii_i: FloatArray,
    radii_j: FloatArray,
    elements: AxialElements,
    out: FloatArray,
) -> None:
    """Add the blocks of one pair per lane to `out` (M, M, LANES)."""
    distance = np.sqrt(x * x + y * y + z * z)
    turns = rotations(x / distance, y / distance, z / distance, elements.quarter_turns)
    ratio_i, ratio_j = radii_i / distance, radii_j / distance
    order = len(elements.quarter_turns) - 1
    powers_i, powers_j = np.empty((order, LANES)), np.empty((order, LANES))
    powers_i[0], powers_j[0] = 1 / distance, 1.0
    for rank in range(1, order):
        powers_i[rank], powers_j[rank] = powers_i[rank - 1] * ratio_i, powers_j[rank - 1] * ratio_j
    squares_i, squares_j = ratio_i * ratio_i, ratio_j * ratio_j
    value, scaled = np.empty(LANES), np.empty(LANES)
    for e in range(elements.direct.size):
        rank_i, rank_j = elements.ranks[0, e], elements.ranks[1, e]
        direct, extended = elements.direct[e], elements.extended[e]
        share_i, share_j = extended / (4 * rank_i + 6), extended / (4 * rank_j + 6)
        for lane in range(LANES):
            size = direct + share_i * squares_i[lane] + share_j * squares_j[lane]
            value[lane] = powers_i[rank_i, lane] * powers_j[rank_j, lane] * size
        degree_i, degree_j = elements.degrees[0, e], elements.degrees[1, e]
        left, right = turns[degree_i, elements.places[0, e]], turns[degree_j, elements.places[1, e]]
        for m in range(2 * degree_i + 1):
            line = out[elements.starts[0, e] + m]
            for lane in range(LANES):
                scaled[lane] = value[lane] * left[m, lane]
            for n in range(2 * degree_j + 1):
                column = elements.starts[1, e] + n
                for lane in range(LANES):
                    line[column, lane] += scaled[lane] * right[n, lane]


@njit(fastmath=True, error_model="numpy", cache=True)
def rotations(x: FloatArray, y: FloatArray, z: FloatArray, quarter_turns: FloatArray) -> FloatArray:
    """Transposed rotations Z(φ) J Z(θ) Jᵀ that carry the z axis to directions, (p + 1, 2p + 1, 2p + 1, LANES)."""
    highest, width = quarter_turns.shape[0] - 1, quarter_turns.shape[1]
    turns = np.zeros((highest + 1, width, width, LANES))
    across = np.hypot(x, y)
    polar = _multiples(z, across, highest)
    azimuth = _multiples(np.where(across > 0, x / across, 1.0), np.where(across > 0, y / across, 0.0), highest)
    column, about_y = np.empty((width, LANES)), np.empty((width, LANES))
    for degree in range(1, highest + 1):
        size = 2 * degree + 1
        quarter, turn = quarter_turns[degree], turns[degree]
        for m in range(size):
            for n in range(size):
                column[n] = quarter[m, n]
            _turn_about_z(polar, degree, column, about_y)
            for n in range(size):
                column[n] = 0.0
                for k in range(size):
                    for lane in range(LANES):
                        column[n, lane] += quarter[n, k] * about_y[k, lane]
            _turn_about_z(azimuth, degree, column, turn[m])
    return turns


@njit(fastmath=True, error_model="numpy", cache=True)
def _multiples(cosine: FloatArray, sine: FloatArray, highest: int) -> FloatArray:
    """Cosines and sines (2, highest + 1, LANES) of the multiples of angles."""
    phases = np.empty((2, highest + 1, LANES))
    phases[0, 0], phases[1, 0] = 1.0, 0.0
    for k in range(highest):
        phases[0, k + 1] = cosine * phases[0, k] - sine * phases[1, k]
        phases[1, k + 1] = sine * phases[0, k] + cosine * phases[1, k]
    return phases


@njit(fastmath=True, error_model="numpy", cache=True)
def _turn_about_z(phases: FloatArray, degree: int, components: FloatArray, out: FloatArray) -> None:
    """Components (2n + 1, LANES) of functions of a degree, turned by the angle whose multiples are in `phases`."""
    out[degree] = components[degree]
    for k in range(1, degree + 1):
        for lane in range(LANES):
            cosine, sine = phases[0, k, lane], phases[1, k, lane]
            plus, minus = components[degree + k, lane], components[degree - k, lane]
            out[degree + k, lane] = cosine * plus - sine * minus
            out[degree - k, lane] = cosine * minus + sine * plus
