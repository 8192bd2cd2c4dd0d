"""Spring frames: energy, springs side by side, and what is refused."""

import numpy as np
import pytest
from scipy.linalg import null_space

from rheoclast.frames import springs
from rheoclast.frames.kinematics import joint_axes, side_displacements
from rheoclast.frames.springs import spring_frame
from rheoclast.vectors import cross_matrix

TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]])
TETRAHEDRON = np.vstack([TRIANGLE, [1, 1 / np.sqrt(3), np.sqrt(8 / 3)]])
EVERY_TWO = np.stack(np.triu_indices(4, 1), axis=1)
MIDDLES = TETRAHEDRON[EVERY_TWO].mean(axis=1)
SOLVERS = pytest.mark.parametrize("most_loops", [np.inf, -1], ids=["SuperLU", "fronts"])


def balanced(nodes, cases=2, seed=0):
    """Random loads (N, 6, K) without resultant."""
    loads = np.random.default_rng(seed).normal(size=(len(nodes), 6, cases))
    arms = cross_matrix(nodes - nodes.mean(axis=0))
    for _ in range(2):
        loads[:, :3] -= loads[:, :3].mean(axis=0)
        loads[:, 3:] -= (loads[:, 3:] + arms @ loads[:, :3]).mean(axis=0)
    return loads


def flexibility(nodes, pairs, stiffness):
    """Compliance (6C, 6C) of the joints in fixed axes."""
    blocks = []
    for (i, j), (normal, tangential, bending, twisting) in zip(pairs, stiffness, strict=True):
        along = nodes[j] - nodes[i]
        along = np.outer(along, along) / (along @ along)
        blocks.append(along / normal + (np.eye(3) - along) / tangential)
        blocks.append(along / twisting + (np.eye(3) - along) / bending)
    matrix = np.zeros((len(blocks), 3, len(blocks), 3))
    matrix[np.arange(len(blocks)), :, np.arange(len(blocks))] = blocks
    return matrix.reshape(3 * len(blocks), -1)


@SOLVERS
def test_joint_loads_have_the_least_energy_of_all_that_balance(monkeypatch, most_loops):
    """Castigliano's theorem: no state of self-stress does work on the elongations."""
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", most_loops)
    stiffness = np.random.default_rng(1).uniform(0.2, 2.0, (6, 4))
    loads = balanced(TETRAHEDRON)
    carried = spring_frame(TETRAHEDRON, EVERY_TWO, MIDDLES, stiffness).joint_loads(loads).reshape(36, 2)
    fixed_axes = np.tile(np.eye(3), (6, 1, 1))
    balance = side_displacements(TETRAHEDRON, EVERY_TWO, MIDDLES, fixed_axes).T.toarray()
    np.testing.assert_allclose(balance @ carried, loads.reshape(24, 2), atol=1e-13)
    selfstress = null_space(balance)
    assert selfstress.shape[1] == 6 * (6 - 4 + 1)
    np.testing.assert_allclose(selfstress.T @ flexibility(TETRAHEDRON, EVERY_TWO, stiffness) @ carried, 0, atol=1e-12)


@SOLVERS
@pytest.mark.parametrize("decades", [0, 4, 8])
def test_springs_side_by_side_share_by_their_stiffness(monkeypatch, most_loops, decades):
    """Two joints at one point: each spring carries its share of one load, though its neighbours are far softer.

    Displacements are rounded as the softest yield, and the stiff ones take their load from the difference.
    """
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", most_loops)
    nodes = np.array([[0.3, -0.2, 0.1], [1.3, 1.0, -0.7]])
    pairs, points = np.array([[0, 1], [0, 1]]), np.tile(nodes.mean(axis=0), (2, 1))
    soft = 10.0**-decades
    stiffness = np.array([[1.0, 2 * soft, 1.0, 5 * soft], [3.0, soft, 4.0, soft]])
    carried = spring_frame(nodes, pairs, points, stiffness).joint_loads(balanced(nodes))
    axes = joint_axes(nodes, pairs)[0]
    one, other = (np.concatenate([axes.T @ each[:3], axes.T @ each[3:]]) for each in carried)
    normal, tangential, bending, twisting = (stiffness[0] / stiffness.sum(axis=0))[:, None]
    share = np.concatenate([normal, tangential, tangential, twisting, bending, bending])
    np.testing.assert_allclose(one, share[:, None] * (one + other), atol=max(1e-14, 1e-15 / soft))


def carried_in_extended_precision(nodes, pairs, points, stiffness, loads):
    """Joint loads (C, 6, K) by dense elimination of the stiffness."""
    nodes, points, stiffness = (each.astype(np.longdouble) for each in (nodes, points, stiffness))
    between = nodes[pairs[:, 1]] - nodes[pairs[:, 0]]
    along = between[:, :, None] * between[:, None, :] / (between**2).sum(axis=1)[:, None, None]
    springs = np.zeros((len(pairs), 6, len(pairs), 6), dtype=np.longdouble)
    every = np.arange(len(pairs))
    for place, (normal, across) in ((slice(0, 3), (0, 1)), (slice(3, 6), (3, 2))):
        parts = stiffness[:, normal, None, None] * along + stiffness[:, across, None, None] * (np.eye(3) - along)
        springs[every, place, every, place] = parts
    balance = np.zeros((len(nodes), 6, len(pairs), 6), dtype=np.longdouble)
    for end, sign in ((0, -1), (1, 1)):
        balance[pairs[:, end], :, every] += sign * np.eye(6)
        arms = points - nodes[pairs[:, end]]
        for row, column, other in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            balance[pairs[:, end], 3 + column, every, row] += sign * arms[:, other]
            balance[pairs[:, end], 3 + other, every, row] -= sign * arms[:, column]
    stress = springs.reshape(6 * len(pairs), -1) @ balance.reshape(6 * len(nodes), -1).T[:, 6:]
    matrix = balance.reshape(6 * len(nodes), -1)[6:] @ stress
    moved = loads.reshape(6 * len(nodes), -1)[6:].astype(np.longdouble)
    for k in range(len(matrix)):
        factor = matrix[k + 1 :, k] / matrix[k, k]
        moved[k + 1 :] -= factor[:, None] * moved[k]
        matrix[k + 1 :] -= factor[:, None] * matrix[k]
    for k in range(len(matrix) - 1, -1, -1):
        moved[k] = (moved[k] - matrix[k, k + 1 :] @ moved[k + 1 :]) / matrix[k, k]
    return (stress @ moved).reshape(len(pairs), 6, -1)


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="no precision beyond double")
@SOLVERS
@pytest.mark.parametrize("seed", range(6))
def test_stiffnesses_over_twelve_decades(monkeypatch, most_loops, seed):
    """Every spring its own, in joints that lie along no axis."""
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", most_loops)
    nodes = TETRAHEDRON @ np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    points, loads = nodes[EVERY_TWO].mean(axis=1), balanced(nodes)
    stiffness = 10 ** np.random.default_rng(seed).uniform(-12, 0, (6, 4))
    expected = carried_in_extended_precision(nodes, EVERY_TWO, points, stiffness, loads)
    carried = spring_frame(nodes, EVERY_TWO, points, stiffness).joint_loads(loads)
    np.testing.assert_allclose(carried, expected.astype(float), atol=1e-11 * np.abs(carried).max())


def test_joints_without_stiffness_are_not_there():
    frame = spring_frame(TETRAHEDRON, EVERY_TWO, MIDDLES, np.full((6, 4), 0.7))
    carried = frame.without(np.array([1, 4])).joint_loads(balanced(TETRAHEDRON))
    there = np.array([0, 2, 3, 5])
    smaller = spring_frame(TETRAHEDRON, EVERY_TWO[there], MIDDLES[there], np.full((4, 4), 0.7))
    np.testing.assert_allclose(carried[there], smaller.joint_loads(balanced(TETRAHEDRON)), atol=1e-12)
    np.testing.assert_array_equal(carried[[1, 4]], 0)


@SOLVERS
def test_loads_that_nothing_resists_are_refused(monkeypatch, most_loops):
    """Whether the elimination notices, or only balance."""
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", most_loops)
    chain = np.vstack([TETRAHEDRON, TETRAHEDRON[1] + [1.2, -1.6, 0]])
    pairs = np.vstack([EVERY_TWO, [1, 4]])
    for stiffness in ([1.0, 0.8, 0.0, 0.0], [0.0] * 4, [1.0, 1e-30, 1e-30, 1e-30]):
        frame = spring_frame(chain, pairs, chain[pairs].mean(axis=1), np.tile(stiffness, (7, 1)))
        with pytest.raises(ArithmeticError, match=r"(is singular to rounding|does not balance).*; bring the"):
            frame.joint_loads(balanced(chain))


def test_refinement_goes_on_while_it_helps():
    """By a correction of nine tenths to the last digit; by none, or one that is no number, not at all."""
    frame = spring_frame(TETRAHEDRON, EVERY_TWO, MIDDLES, np.ones((6, 4)))
    loads = balanced(TETRAHEDRON)
    exact, rounds = frame.joint_loads(loads), []

    def correction(part):
        def corrected(lacking):
            rounds.append(part)
            whole = np.concatenate([-np.add.reduce(lacking.reshape(3, 6, 2))[None], lacking.reshape(3, 6, 2)])
            arms = cross_matrix(TETRAHEDRON - TETRAHEDRON[0])
            whole[0, 3:] -= (arms @ whole[:, :3]).sum(axis=0)
            carried = spring_frame(TETRAHEDRON, EVERY_TWO, MIDDLES, np.ones((6, 4))).joint_loads(whole)
            return part * scaled_of(carried)

        return corrected

    def scaled_of(carried):
        axes = frame.axes.swapaxes(1, 2)[:, None]
        return (axes @ carried.reshape(6, 2, 3, 2)).reshape(36, 2)

    nothing, flat = np.zeros((36, 2)), loads.reshape(24, 2)
    scaled, left = frame.balanced(nothing, flat, correction(0.9))
    np.testing.assert_allclose(frame.from_scaled(scaled), exact, atol=1e-12)
    assert left.max() < 1e-13
    assert 12 <= len(rounds) <= 15
    for part in (0.0, np.nan):
        rounds.clear()
        frame.balanced(nothing, flat, correction(part))
        assert len(rounds) == 1
