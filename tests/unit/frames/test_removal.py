"""Removal of joints: definitions, limits and refusals."""

import numpy as np
import pytest

from rheoclast.frames import removal, updates
from rheoclast.frames.removal import CollapseError, removable_frame
from rheoclast.frames.springs import spring_frame
from rheoclast.vectors import cross_matrix

STIFFNESS = np.array([1.0, 0.8, 5.7e-3, 7.7e-3])
WITHOUT_MOMENTS = np.array([1.0, 0.8, 0.0, 0.0])
TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]])
TETRAHEDRON = np.vstack([TRIANGLE, [1, 1 / np.sqrt(3), np.sqrt(8 / 3)]])


def touching(nodes):
    """Joints of unit spheres that touch, and their points."""
    first, second = np.triu_indices(len(nodes), 1)
    near = np.linalg.norm(nodes[second] - nodes[first], axis=1) < 2.01
    pairs = np.stack([first[near], second[near]], axis=1)
    return pairs, nodes[pairs].mean(axis=1)


def geometry(nodes, stiffness=STIFFNESS):
    pairs, points = touching(nodes)
    return nodes, pairs, points, np.tile(stiffness, (len(pairs), 1))


def block(side):
    """Part of an fcc lattice of unit spheres."""
    sites = np.indices((side, side, side)).reshape(3, -1).T
    return np.sqrt(2.0) * sites[sites.sum(axis=1) % 2 == 0]


def ring(count):
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) / np.sin(np.pi / count)


def balanced(nodes, cases=2, seed=0):
    """Random loads (N, 6, K) without resultant."""
    loads = np.random.default_rng(seed).normal(size=(len(nodes), 6, cases))
    arms = nodes - nodes.mean(axis=0)
    for _ in range(2):
        loads[:, :3] -= loads[:, :3].mean(axis=0)
        loads[:, 3:] -= (loads[:, 3:] + cross_matrix(arms) @ loads[:, :3]).mean(axis=0)
    return loads


def loaded(nodes, stiffness=STIFFNESS):
    return removable_frame(*geometry(nodes, stiffness)).loaded(balanced(nodes))


def anew(nodes, removed, stiffness=STIFFNESS):
    """Joint loads of the frame without some joints, solved by itself; zero in the removed ones."""
    nodes, pairs, points, constants = geometry(nodes, stiffness)
    there = np.delete(np.arange(len(pairs)), removed)
    carried = np.zeros((len(pairs), 6, 2))
    carried[there] = spring_frame(nodes, pairs[there], points[there], constants[there]).joint_loads(balanced(nodes))
    return carried


def assert_same(one, other, tolerance=1e-10):
    np.testing.assert_allclose(one, other, rtol=0, atol=tolerance * np.abs(other).max())


def test_intact_frame_carries_what_a_spring_frame_carries():
    """Nothing removed is no special case."""
    state = loaded(block(4))
    assert_same(state.joint_loads, anew(block(4), []))
    assert state.removed.shape == (0,)
    assert state.residual < 1e-12


def test_removed_joints_carry_nothing_and_the_others_what_is_solved_anew():
    """One, then three at once, then one as a plain index of NumPy."""
    state = loaded(block(4)).without(5).without([0, 17, 40]).without(np.int64(2))
    np.testing.assert_array_equal(state.removed, [5, 0, 17, 40, 2])
    np.testing.assert_array_equal(state.joint_loads[state.removed], 0)
    assert_same(state.joint_loads, anew(block(4), state.removed))
    assert state.residual < 1e-9


def by_updates(state):
    """Joint loads without refinement."""
    solution = state._solution
    return solution.factorized.springs.from_scaled(solution.factorized.shared(solution.scaled, state._removal))


def test_updates_alone_give_the_loads():
    """Without a new factorization or refinement, which would make up for an error in them."""
    state = loaded(block(4))
    for number, joint in enumerate(range(0, 60, 4), start=1):
        state = state.without(joint)
        assert len(state._removal.joints) == number
        assert_same(by_updates(state), anew(block(4), state.removed))


def test_a_state_is_not_changed_by_what_is_removed_from_it():
    """Two branches from one state, that share its history, and a third from the beginning of one."""
    start = loaded(block(4)).without([3, 8])
    before = start.joint_loads.copy()
    one = start.without(20).without(21)
    other = start.without(30)
    third = other.without(31)
    np.testing.assert_array_equal(start.joint_loads, before)
    for state in (one, other, third):
        assert_same(state.joint_loads, anew(block(4), state.removed))
        assert len(state._removal.joints) == len(state.removed)
        assert_same(by_updates(state), state.joint_loads)
    assert_same(one.without(44).joint_loads, anew(block(4), [3, 8, 20, 21, 44]))
    for array in (one.joint_loads, one.removed, one.loads):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@pytest.mark.parametrize("most", [1, 2, 5])
def test_factors_are_renewed_when_their_updates_are_used_up(monkeypatch, most):
    """With any number of updates the joint loads are the same, also where more joints go at once than that."""
    monkeypatch.setattr(updates, "MOST_UPDATED", most)
    state = loaded(block(4))
    for joints in (3, [9, 1, 16], 22, 31, 40, [50, 60]):
        state = state.without(joints)
        assert len(state._removal.joints) <= most
        assert_same(state.joint_loads, anew(block(4), state.removed))


def test_unit_of_stiffness_does_not_matter():
    """Only the ratios do, also in a frame so slender that balance is hardly reached."""
    expected = loaded(ring(1000)).without(3).joint_loads
    for unit in (1e-30, 1e30):
        assert_same(loaded(ring(1000), unit * STIFFNESS).without(3).joint_loads, expected, 1e-8)


def test_order_of_the_nodes_of_a_joint_only_turns_its_load():
    """What the second exerts on the first; the normal springs are the same."""
    nodes, pairs, points, stiffness = geometry(block(3))
    turned = pairs.copy()
    turned[::2] = turned[::2, ::-1]
    sign = np.where(np.arange(len(pairs)) % 2, 1.0, -1.0)[:, None, None]
    expected = removable_frame(nodes, pairs, points, stiffness).loaded(balanced(nodes)).without([4, 7])
    state = removable_frame(nodes, turned, points, stiffness).loaded(balanced(nodes)).without([4, 7])
    assert_same(state.joint_loads, sign * expected.joint_loads)


def test_without_loads_nothing_is_carried():
    """And a split is recognized all the same."""
    state = removable_frame(*geometry(ring(6))).loaded(np.zeros((6, 6, 1))).without(0)
    np.testing.assert_array_equal(state.joint_loads, 0)
    assert state.residual == 0
    with pytest.raises(CollapseError, match="falls into parts"):
        state.without(1)


def test_a_cut_ring_is_a_chain_of_known_loads():
    """The remaining joints carry the sum of the loads beyond the gap; so soft a ring needs new factors."""
    nodes = ring(200)
    _, pairs, points, _ = geometry(nodes)
    state = loaded(nodes)
    gap = int(np.flatnonzero((pairs == [0, 199]).all(axis=1))[0])
    cut = state.without(gap)
    along = np.array([int(np.flatnonzero((pairs == [k, k + 1]).all(axis=1))[0]) for k in range(199)])
    force = -np.cumsum(state.loads[:, :3], axis=0)[:-1]
    assert_same(cut.joint_loads[along, :3], force, 1e-9)
    torque = cross_matrix(nodes) @ state.loads[:, :3] + state.loads[:, 3:]
    moment = -np.cumsum(torque, axis=0)[:-1] - cross_matrix(points[along]) @ force
    assert_same(cut.joint_loads[along, 3:], moment, 1e-9)


def test_a_bridge_is_recognized_with_the_parts_it_held_together():
    """Two blocks joined by a single joint."""
    one = block(3)
    other = one + one.max(axis=0) + [2, 0, 0] - one.min(axis=0)
    other -= other[0] - one[-1] - [2, 0, 0]
    nodes = np.vstack([one, other])
    pairs, _ = touching(nodes)
    bridge = int(np.flatnonzero((pairs[:, 0] < len(one)) & (pairs[:, 1] >= len(one)))[0])
    state = loaded(nodes)
    message = rf"^without joint {bridge} the frame falls into parts of {len(one)}, {len(one)} nodes$"
    with pytest.raises(CollapseError, match=message) as raised:
        state.without(bridge)
    np.testing.assert_array_equal(raised.value.parts, np.repeat([0, 1], len(one)))
    assert_same(state.without(0).joint_loads, anew(nodes, [0]))


def test_parts_that_only_several_joints_make():
    """A ring holds without any one, not without two; seven are not all listed."""
    state = loaded(ring(8))
    for joint in range(8):
        assert state.without(joint).residual < 1e-9
    with pytest.raises(CollapseError, match=r"^without joints 0, 3 the frame falls into parts of") as raised:
        state.without([0, 3])
    assert raised.value.parts.max() == 1
    with pytest.raises(CollapseError, match=r"joints 0, 1, 2, 3, 4, … the frame"):
        state.without(range(7))


def test_the_joint_of_a_pair():
    """It is the whole frame."""
    state = loaded(np.array([[0, 0, 0], [2.0, 0, 0]]))
    np.testing.assert_allclose(state.joint_loads[0, :3], -state.loads[0, :3], atol=1e-12)
    with pytest.raises(CollapseError, match="parts of 1, 1 nodes"):
        state.without(0)


def test_joints_that_no_longer_hold_a_sphere():
    """Joints that take no moment hold it at three points; at two it turns about their line, at one about any axis."""
    nodes = np.vstack([block(4), [[0, -np.sqrt(2), np.sqrt(2)]]])
    nodes = nodes[np.lexsort(nodes.T)]
    loose = int(np.flatnonzero(nodes[:, 1] < -1)[0])
    state = loaded(nodes, WITHOUT_MOMENTS)
    holding = np.flatnonzero((state.frame.springs.pairs == loose).any(axis=1))
    alone = np.arange(len(nodes)) == loose
    assert len(holding) == 3
    for joint in holding:
        with pytest.raises(
            CollapseError, match=rf"^without joint {joint} the frame holds together but moves"
        ) as raised:
            state.without(joint)
        np.testing.assert_array_equal(raised.value.parts, alone)
        with pytest.raises(CollapseError, match="moves without resistance"):
            state.frame.loaded(np.zeros((len(nodes), 6, 1))).without(joint)
    with pytest.raises(CollapseError, match="moves without resistance") as raised:
        state.without(holding[:2])
    np.testing.assert_array_equal(raised.value.parts, alone)
    with pytest.raises(CollapseError, match=f"parts of {loose}, 1|parts of {len(nodes) - 1}, 1|parts of 1, "):
        state.without(holding)


def test_a_part_that_hangs_on_by_a_hinge():
    """Two tetrahedra, base on base: of three joints that take no moment two are left, a hinge between rigid bodies."""
    nodes = np.vstack([TETRAHEDRON, TETRAHEDRON * [1, 1, -1] - [0, 0, 2]])
    state = loaded(nodes, WITHOUT_MOMENTS)
    between = np.flatnonzero((state.frame.springs.pairs[:, 0] < 4) & (state.frame.springs.pairs[:, 1] >= 4))
    assert len(between) == 3
    with pytest.raises(CollapseError, match="moves without resistance") as raised:
        state.without(between[0])
    np.testing.assert_array_equal(raised.value.parts, [0, 0, 0, 0, 1, 1, 1, 1])
    assert_same(loaded(nodes).without(between[0]).joint_loads, anew(nodes, between[:1]))


@pytest.mark.parametrize("bending", [1e-3, 1e-6, 1e-9])
def test_soft_is_not_loose(bending):
    """However little a joint resists bending, balance decides what the last joint of a sphere carries."""
    nodes = np.vstack([TETRAHEDRON, TETRAHEDRON[1] + [2, 0, 0]])
    stiffness = np.array([1.0, 0.8, bending, bending])
    state = loaded(nodes, stiffness).without([0, 1])
    last = int(np.flatnonzero((state.frame.springs.pairs == [1, 4]).all(axis=1))[0])
    np.testing.assert_allclose(state.joint_loads[last, :3], state.loads[4, :3], atol=1e-9)
    assert_same(state.joint_loads, anew(nodes, [0, 1], stiffness), 1e-6)


def test_redundancies_add_up_to_the_hyperstaticity():
    """The redundancy matrix projects on the states of self-stress, 6 (C − N + 1) of them."""
    nodes, pairs, points, _ = geometry(block(4))
    frame = removable_frame(nodes, pairs, points, np.random.default_rng(1).uniform(0.1, 2.0, (len(pairs), 4)))
    factorized, none = frame.factorized, frame.factorized.intact()
    blocks = [factorized.extended(none, np.array([joint])).triangle for joint in range(len(pairs))]
    redundancy = [np.linalg.svd(each, compute_uv=False) ** 2 for each in blocks]
    assert np.min(redundancy) > 0
    assert np.max(redundancy) < 1
    assert np.sum(redundancy) == pytest.approx(6 * (len(pairs) - len(nodes) + 1), rel=1e-10)


def test_unbalanced_loads_are_shared_by_the_joints_that_remain():
    """An error that displacements leave, E u, is removed to the last digit, and nothing is put into lost joints."""
    state = loaded(block(4)).without([3, 20])
    solution, lost = state._solution, state._removal
    factorized = solution.factorized
    exact = factorized.shared(solution.scaled, lost)
    displacements = np.random.default_rng(9).normal(size=(6 * len(block(4)) - 6, 2))
    wrong = lost.cleared(exact + factorized.springs.stretched(displacements))
    lacking = factorized.springs.lacking(wrong, solution.loads)[6:]
    assert np.abs(lacking).max() > 1.0
    assert_same(wrong + factorized.correction(lacking, lost), exact)


def test_a_softened_frame_is_refined_rather_than_factorized_anew(monkeypatch):
    """A cut ring of fourteen has lost four digits, and gets back more than two of them."""
    monkeypatch.setattr(removal, "NEAR_BALANCE", 1e-13)
    state = loaded(ring(14)).without(5)
    assert len(state._removal.joints) == 1
    assert state.residual < 1e-13


def test_factors_that_do_not_bring_balance_are_renewed(monkeypatch):
    """As no update can, of a balance without any rounding."""
    monkeypatch.setattr(removal, "NEAR_BALANCE", 0.0)
    state = loaded(block(4)).without(3).without(20)
    assert len(state._removal.joints) == 0
    assert_same(state.joint_loads, anew(block(4), [3, 20]))


def update_of_a_ring(count):
    """Removal of a joint of a ring by an update, if it can be made so."""
    factorized = removable_frame(*geometry(ring(count))).factorized
    return factorized.extended(factorized.intact(), np.array([0]))


def test_redundancy_of_a_ring_falls_with_the_cube_of_its_length(monkeypatch):
    """As the stiffness against closing the gap of a bent beam; 2 % from the law at 32 spheres."""
    monkeypatch.setattr(updates, "LEAST_REDUNDANCY", 0.0)
    least = [np.linalg.svd(update_of_a_ring(count).triangle, compute_uv=False)[-1] ** 2 for count in (32, 64, 128)]
    np.testing.assert_allclose(np.log2(np.divide(least[:-1], least[1:])), 3, atol=0.05)


def test_a_removal_that_costs_too_many_digits_is_left_to_new_factors():
    """Redundancies of 2e-9 and 6e-10."""
    assert update_of_a_ring(256) is not None
    assert update_of_a_ring(400) is None


def test_residual_is_what_is_left_on_the_worst_node():
    """Relative to the largest load of each case, for joint loads as wrong as one likes."""
    state = loaded(block(3))
    springs, loads = state.frame.springs, 5 * state._solution.loads
    scaled = 5 * state._scaled
    scaled[30] += 0.5
    _, left = springs.balanced(scaled, loads, lambda lacking: np.zeros((len(scaled), 2)), tolerance=np.inf)
    nodes, pairs, points, _ = geometry(block(3))
    difference = springs.from_scaled(scaled) - 5 * state.joint_loads
    total = np.zeros_like(state.loads)
    for end, sign in ((0, 1.0), (1, -1.0)):
        arm = cross_matrix(points - nodes[pairs[:, end]])
        force, moment = sign * difference[:, :3], sign * (difference[:, 3:] + arm @ difference[:, :3])
        np.add.at(total, pairs[:, end], np.concatenate([force, moment], axis=1))
    worst = np.abs(total[1:]).max(axis=(0, 1)) / np.abs(5 * state.loads).max(axis=(0, 1))
    np.testing.assert_allclose(left, worst, rtol=1e-9)


def test_factors_without_some_joints_are_those_of_a_frame_that_never_had_them():
    """The stiffness is rebuilt from the remaining joints, with nothing left of the others."""
    nodes, pairs, points, stiffness = geometry(block(3))
    frame = removable_frame(nodes, pairs, points, stiffness)
    there = np.delete(np.arange(len(pairs)), [2, 9])
    smaller = removable_frame(nodes, pairs[there], points[there], stiffness[there])
    rebuilt = updates.factorized_frame(frame.springs.without(np.array([2, 9])), frame.part)
    load = balanced(nodes).reshape(-1, 2)[6:]
    assert_same(rebuilt.factor.solve(load), smaller.factorized.factor.solve(load), 1e-9)


BAD_JOINTS = {
    "too large": (36, r"^joints: expected indices from 0 to 35, got 36$"),
    "negative": ([2, -1], r"^joints: expected indices from 0 to 35, got -1$"),
    "removed": ([3, 7], r"^joints: joint 7 was removed before; choose among those that remain$"),
    "twice": ([3, 5, 3], r"^joints: joint 3 is given 2 times; give each once$"),
    "none": ([], r"^joints: expected an index or a sequence of indices of joints, got \[\]$"),
    "not whole": (1.5, r"^joints: expected an index or a sequence of indices of joints, got 1.5$"),
    "mask": (np.ones(2, dtype=bool), r"^joints: expected an index or a sequence of indices of joints, got array"),
    "table": ([[1, 2]], r"^joints: expected an index or a sequence of indices of joints, got \[\[1, 2\]\]$"),
}


@pytest.mark.parametrize("name", BAD_JOINTS)
def test_refused_joints(name):
    """With the first that cannot be removed."""
    joints, message = BAD_JOINTS[name]
    state = loaded(block(3)).without(7)
    with pytest.raises(ValueError, match=message):
        state.without(joints)


BAD_FRAMES = {
    "nodes": (0, [[0, 0], [2, 0]], r"^nodes: expected shape \(N, 3\), got \(2, 2\)$"),
    "no joint": (1, np.empty((0, 2), dtype=int), r"^pairs: expected at least one joint as indices of shape \(C, 2\)"),
    "real pairs": (1, [[0.0, 1.0]], r"^pairs: expected at least one joint as indices of shape \(C, 2\), got \[\[0.0"),
    "outside": (1, [[0, 1], [0, 2], [1, 3]], r"^pairs\[2\]: expected indices from 0 to 2, got \[1, 3\]$"),
    "loop": (1, [[0, 1], [2, 2], [1, 2]], r"^pairs\[1\]: expected nodes at two places, got \[2, 2\] at one$"),
    "points": (2, np.zeros((2, 3)), r"^points: expected shape \(3, 3\), got \(2, 3\)$"),
    "few": (3, np.ones((2, 4)), r"^stiffness: expected shape \(3, 4\), got \(2, 4\)$"),
    "negative": (3, -np.eye(3, 4), r"^stiffness\[0, 0\]: expected zero or a positive number, got -1$"),
}


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_refused_frames(name):
    """Each argument, with what was wrong."""
    place, value, message = BAD_FRAMES[name]
    arguments = list(geometry(TRIANGLE))
    arguments[place] = value
    with pytest.raises(ValueError, match=message):
        removable_frame(*arguments)


def test_frames_that_never_held():
    """In parts, or loose with all joints, or without any stiffness."""
    apart = np.vstack([TRIANGLE, TRIANGLE + np.array([10, 0, 0])])
    with pytest.raises(
        CollapseError, match=r"^expected a connected frame, got 2 parts; load each by itself$"
    ) as raised:
        removable_frame(*geometry(apart))
    np.testing.assert_array_equal(raised.value.parts, [0, 0, 0, 1, 1, 1])
    for stiffness in (WITHOUT_MOMENTS, 0 * STIFFNESS):
        message = "with all its joints the frame moves without resistance; give every"
        with pytest.raises(CollapseError, match=message) as raised:
            removable_frame(*geometry(ring(5), stiffness))
        np.testing.assert_array_equal(raised.value.parts, np.arange(5))


def test_refused_loads():
    """Of another frame, and without balance."""
    frame = removable_frame(*geometry(block(3)))
    with pytest.raises(ValueError, match=r"^loads: expected shape \(14, 6, K\), got \(3, 6, 1\)$"):
        frame.loaded(np.zeros((3, 6, 1)))
    loads = balanced(block(3), 4)
    loads[5, 4, 2] += 1e-3
    message = r"^loads of case 2: expected totals of zero, got a force or torque of 0.001 where joints carry up to \d"
    with pytest.raises(ValueError, match=message):
        frame.loaded(loads)


def test_node_held_takes_what_rounded_loads_lack():
    """It is not taken for an error of the solution, which a new factorization would not mend."""
    frame, loads = removable_frame(*geometry(block(3))), balanced(block(3))
    loads[5, 1] += 1e-7
    state = frame.loaded(loads).without(3)
    assert state.residual < 1e-10
    assert len(state._removal.joints) == 1
