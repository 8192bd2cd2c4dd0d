"""The halves of a solution by fronts, against dense algebra."""

import numpy as np
import pytest
from scipy.sparse import bsr_array

from rheoclast.frames.cholesky import frontal_cholesky, unknowns
from rheoclast.frames.dissection import dissection

SIDE, SIZE = 5, 2


@pytest.fixture(scope="module")
def grid():
    """A positive definite matrix of neighbours in a cubic grid: its factors, and dense."""
    places = np.indices((SIDE, SIDE, SIDE)).reshape(3, -1).T.astype(float)
    first, second = np.triu_indices(len(places), 1)
    near = np.linalg.norm(places[second] - places[first], axis=1) < 1.1
    pairs = np.stack([first[near], second[near]], axis=1)
    rng = np.random.default_rng(2)
    root = np.zeros((len(pairs), SIZE, len(places), SIZE))
    for end in (0, 1):
        root[np.arange(len(pairs)), :, pairs[:, end]] = rng.normal(size=(len(pairs), SIZE, SIZE))
    root = root.reshape(SIZE * len(pairs), -1)
    matrix = root.T @ root + 0.1 * np.eye(root.shape[1])
    return frontal_cholesky(bsr_array(matrix, blocksize=(SIZE, SIZE)), dissection(places, pairs)), matrix


def test_both_halves_make_the_solution(grid):
    factor, matrix = grid
    assert len(factor.fronts) > 3
    right = np.random.default_rng(3).normal(size=(len(matrix), 3))
    expected = np.linalg.solve(matrix, right)
    np.testing.assert_allclose(factor.solve(right), expected, atol=1e-11)
    half, filled = factor.forward(right)
    np.testing.assert_allclose(half.T @ half, right.T @ expected, atol=1e-11)
    assert filled == [front.own for front in factor.fronts]
    np.testing.assert_allclose(factor.backward(half), expected, atol=1e-11)


def test_half_of_a_solution_is_zero_where_no_row_is_filled(grid):
    """A right-hand side at one place fills the fronts from there to the last, and no others."""
    factor, matrix = grid
    right = np.zeros((len(matrix), 1))
    right[factor.order[0]] = 1.0
    half, filled = factor.forward(right)
    assert filled[0] == factor.fronts[0].own
    assert filled[-1] == factor.fronts[-1].own
    assert len(filled) < len(factor.fronts)
    empty = np.ones(len(half), dtype=bool)
    for rows in filled:
        assert half[rows].any()
        empty[rows] = False
    np.testing.assert_array_equal(half[empty], 0)
    np.testing.assert_allclose(half.T @ half, np.linalg.inv(matrix)[factor.order[0], factor.order[0]], rtol=1e-11)


def test_pivots_are_what_elimination_leaves_of_the_diagonal(grid):
    """Their product is the determinant; the first is the diagonal, the last what all others leave."""
    factor, matrix = grid
    assert np.log(factor.pivots).sum() == pytest.approx(np.linalg.slogdet(matrix)[1], rel=1e-12)
    first, last = factor.order[[0, -1]]
    assert factor.pivots[first] == pytest.approx(matrix[first, first], rel=1e-12)
    assert factor.pivots[last] == pytest.approx(1 / np.linalg.inv(matrix)[last, last], rel=1e-10)


def test_unknowns_of_blocks():
    np.testing.assert_array_equal(unknowns(np.array([2, 0]), 3), [6, 7, 8, 0, 1, 2])
