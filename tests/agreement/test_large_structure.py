"""Large structures: fronts ↔ SuperLU ↔ dense algebra, springs ↔ statics, and balance of thousands of spheres.

Random loads of order one on unit spheres; the bonds have the ratios of stiff micrometre spheres.
"""

import numpy as np
import pytest
from scipy.sparse import bsr_array
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.frames import cholesky, dissection, springs
from rheoclast.graphs import connected_parts

BONDS = rc.Bonds(normal=1.0, tangential=0.8, bending=5.7e-3, twisting=7.7e-3)


def chain(count):
    return rc.Aggregate.touching(rc.Spheres(np.outer(2.0 * np.arange(count), [2, -1, 2]) / 3, 1.0))


def open_tree(count, seed=1):
    """Two halves, turned at random, touch where each reaches farthest towards the other."""
    rng = np.random.default_rng(seed)

    def centers(size):
        if size == 1:
            return np.zeros((1, 3))
        one, other = centers(size - size // 2), Rotation.random(rng=rng).apply(centers(size // 2))
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        return np.vstack(
            [one, other + one[np.argmax(one @ direction)] - other[np.argmin(other @ direction)] + 2 * direction]
        )

    return rc.Aggregate.touching(rc.Spheres(centers(count), 1.0))


def porous_cube(side, seed=1):
    """The largest connected part of random sites of an fcc lattice: coordination near 5, dead ends and loops."""
    rng = np.random.default_rng(seed)
    sites = np.indices((side, side, side)).reshape(3, -1).T
    sites = sites[(sites.sum(axis=1) % 2 == 0) & (rng.random(len(sites)) < 0.42)]
    part = connected_parts(len(sites), cKDTree(sites).query_pairs(1.5, output_type="ndarray"))
    sites = rng.permutation(sites[part == np.bincount(part).argmax()])
    turn = Rotation.from_rotvec([0.3, 1.0, -0.4])
    return rc.Aggregate.touching(rc.Spheres(turn.apply(np.sqrt(2.0) * sites), 1.0))


def balanced_loads(aggregate, cases=5):
    """Random loads without resultant; the second round takes away what rounding left."""
    centers = aggregate.spheres.centers - aggregate.spheres.center_of_mass
    force, torque = np.random.default_rng(2).normal(size=(2, cases, len(aggregate), 3))
    for _ in range(2):
        force -= force.mean(axis=1, keepdims=True)
        torque -= (torque + np.cross(centers, force)).mean(axis=1, keepdims=True)
    return rc.SphereLoads(force, torque)


def unbalanced(aggregate, loads, carried):
    """Largest force or torque left over on any sphere, torque about its own centre, over the largest load."""
    force, torque = loads.force.copy(), loads.torque.copy()
    for end, sign in ((0, 1.0), (1, -1.0)):
        sphere = aggregate.pairs[:, end]
        arm = aggregate.contact_points - aggregate.spheres.centers[sphere]
        for case in range(len(force)):
            np.add.at(force[case], sphere, sign * carried.force[case])
            np.add.at(torque[case], sphere, sign * (np.cross(arm, carried.force[case]) + carried.moment[case]))
    return max(np.abs(force).max(), np.abs(torque).max()) / max(np.abs(loads.force).max(), np.abs(loads.torque).max())


def assert_same(one, other, tolerance):
    size = max(np.abs(other.force).max(), np.abs(other.moment).max())
    np.testing.assert_allclose(one.force, other.force, rtol=0, atol=tolerance * size)
    np.testing.assert_allclose(one.moment, other.moment, rtol=0, atol=tolerance * size)


@pytest.mark.parametrize("aggregate", [open_tree(20_000), chain(5_000)], ids=["tree of 20 000", "chain of 5 000"])
def test_every_sphere_of_a_large_tree_is_in_balance(aggregate):
    """By statics, though the moments inside are more than a thousand times the loads."""
    loads = balanced_loads(aggregate)
    carried = rc.contact_loads(aggregate, loads)
    assert np.abs(carried.moment).max() > 1e3
    assert unbalanced(aggregate, loads, carried) < 1e-10


def test_every_sphere_of_a_large_hyperstatic_structure_is_in_balance():
    """Coordination near 5, by springs."""
    aggregate = porous_cube(36)
    assert len(aggregate.pairs) - len(aggregate) > springs.MOST_LOOPS_BY_SUPERLU
    assert 2 * len(aggregate.pairs) / len(aggregate) == pytest.approx(5, abs=0.3)
    loads = balanced_loads(aggregate)
    assert unbalanced(aggregate, loads, rc.contact_loads(aggregate, loads, BONDS)) < 1e-10


@pytest.mark.parametrize("most_loops", [0, -1])
def test_springs_equal_statics_on_a_large_tree(monkeypatch, most_loops):
    """What SuperLU, or the fronts of a tree, give is known from balance alone."""
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", most_loops)
    tree = open_tree(6_000)
    loads = balanced_loads(tree)
    assert_same(rc.contact_loads(tree, loads, BONDS, method="springs"), rc.contact_loads(tree, loads), 1e-9)


@pytest.mark.parametrize("side", [4, 8, 20])
def test_fronts_equal_superlu(monkeypatch, side):
    """Two factorizations of one frame, a single front or hundreds."""
    aggregate = porous_cube(side)
    loads = balanced_loads(aggregate)
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", np.inf)
    expected = rc.contact_loads(aggregate, loads, BONDS)
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", 0)
    assert_same(rc.contact_loads(aggregate, loads, BONDS), expected, 1e-9)


def random_matrix(blocks, size, seed=3):
    """Symmetric positive definite, dense, with a single part: as a block matrix and as an array."""
    root = np.random.default_rng(seed).normal(size=(blocks * size, blocks * size))
    matrix = root @ root.T + np.eye(len(root))
    return bsr_array(matrix, blocksize=(size, size)), matrix


@pytest.mark.parametrize(("blocks", "panel"), [(7, 1000), (40, 17), (1, 1)])
def test_one_dense_front_equals_dense_algebra(monkeypatch, blocks, panel):
    """Also where the front is cut into panels."""
    monkeypatch.setattr(cholesky, "PANEL", panel)
    sparse, dense = random_matrix(blocks, 6)
    right = np.random.default_rng(4).normal(size=(len(dense), 3))
    solution = cholesky.frontal_cholesky(sparse, np.ones(blocks, dtype=np.intp)).solve(right)
    np.testing.assert_allclose(dense @ solution, right, atol=1e-8)


def test_an_indefinite_matrix_is_refused():
    """A Cholesky factor needs positive pivots."""
    with pytest.raises(ArithmeticError, match=r"^the matrix is not positive definite to rounding$"):
        cholesky.frontal_cholesky(bsr_array(np.diag([1.0, -1.0]), blocksize=(1, 1)), np.ones(2, dtype=np.intp))


def test_a_large_singular_frame_is_refused(monkeypatch):
    """With the advice that smaller ones give."""
    monkeypatch.setattr(springs, "MOST_LOOPS_BY_SUPERLU", 0)
    aggregate = porous_cube(6)
    bonds = rc.Bonds(normal=1.0, tangential=1e-30, bending=1e-30, twisting=1e-30)
    with pytest.raises(ArithmeticError, match="bring the"):
        rc.contact_loads(aggregate, balanced_loads(aggregate), bonds)


@pytest.mark.parametrize("aggregate", [porous_cube(20), open_tree(2_000)], ids=["porous cube", "tree"])
def test_parts_of_the_dissection_meet_only_their_ancestors(aggregate):
    """Neighbours are in one part or in one that descends from the other, and what is not cut is small."""
    part = dissection.dissection(aggregate.spheres.centers, aggregate.pairs)
    low, high = np.sort(part[aggregate.pairs], axis=1).T
    steps = np.floor(np.log2(high)).astype(int) - np.floor(np.log2(low)).astype(int)
    np.testing.assert_array_equal(high >> steps, low)
    leaves = [k for k in np.unique(part) if not np.isin(part, [2 * k, 2 * k + 1]).any()]
    assert max(np.bincount(part)[leaves]) <= dissection.LEAF
    assert np.count_nonzero(part == 1) < 0.1 * len(part)


@pytest.mark.parametrize("seed", range(5))
def test_vertex_cover_is_smallest(seed):
    """It meets every edge, and no smaller set does: all sets of six nodes on either side are tried."""
    rng = np.random.default_rng(seed)
    edges = np.unique(np.stack([rng.integers(0, 6, 9), rng.integers(6, 12, 9)], axis=1), axis=0)
    cover = dissection._vertex_cover(edges)
    assert np.isin(edges, cover).any(axis=1).all()
    sizes = []
    for choice in range(2**12):
        chosen = np.flatnonzero([choice >> k & 1 for k in range(12)])
        if np.isin(edges, chosen).any(axis=1).all():
            sizes.append(len(chosen))
    assert len(cover) == min(sizes)
