"""Far field by interpolation on an octree, with near pairs in closed form ↔ direct sums over all pairs.

Errors are of the 2-norm over the velocities that all other spheres raise. Tractions are random from sphere to sphere,
which is the hardest: they cancel in the distance, where smooth tractions add up and err ten times less.
"""

import numpy as np
import pytest

from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.far_field import far_field
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.octree import octree
from rheoclast.stokes.pair_blocks import PairCoefficients

from .clusters import sticking_cluster


def chain(count):
    """A chain wound to a helix, so that it crosses many boxes in every direction."""
    angle = np.arange(count) / 10
    helix = np.stack([20 * np.cos(angle), 20 * np.sin(angle), 0.5 * angle], axis=1)
    return helix, np.full(count, np.linalg.norm(helix[1] - helix[0]) / 2)


def face_centred_ball(count):
    """The lattice points nearest to one of them, touching spheres of radius one."""
    lattice = np.stack(np.meshgrid(*[np.arange(-12, 13)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    lattice = lattice[lattice.sum(axis=1) % 2 == 0]
    return np.sqrt(2) * lattice[np.argsort((lattice**2).sum(axis=1), kind="stable")[:count]], np.ones(count)


CLUSTERS = {
    "tree": sticking_cluster(450, 3),
    "polydisperse tree": sticking_cluster(450, 4, (0.6, 1.2)),
    "chain": chain(450),
    "compact": face_centred_ball(500),
}


def near_pairs(tree):
    """All ordered pairs of different spheres in neighbouring leaves, (P,) and (P,)."""
    starts, leaves = tree.neighbours
    spheres = np.split(tree.order, tree.leaf_starts[1:-1])
    ones, others = [], []
    for leaf, own in enumerate(spheres):
        around = np.concatenate([spheres[neighbour] for neighbour in leaves[starts[leaf] : starts[leaf + 1]]])
        ones.append(np.repeat(own, len(around)))
        others.append(np.tile(around, len(own)))
    one, other = np.concatenate(ones), np.concatenate(others)
    return one[one != other], other[one != other]


def near_velocities(tree, centers, radii, basis, tractions):
    coefficients = PairCoefficients.of(basis)
    velocities = np.zeros_like(tractions)
    one, other = near_pairs(tree)
    for i, j in zip(np.array_split(one, 20), np.array_split(other, 20), strict=True):
        blocks = coefficients.blocks(centers[i] - centers[j], radii[i], radii[j])
        np.add.at(velocities, i, blocks @ tractions[j])
    return velocities


def errors(name, order, accuracies, leaf_side):
    """Error at each accuracy, in units of it."""
    centers, radii = CLUSTERS[name]
    basis = MultipoleBasis(order)
    tractions = np.random.default_rng(order).normal(size=(len(radii), basis.size, 2))
    alone = basis.self_mobility[:, None] / radii[:, None, None] * tractions
    exact = Mobility(centers, radii, basis) @ tractions - alone
    fields = [far_field(centers, radii, basis, accuracy, leaf_side) for accuracy in accuracies]
    near = near_velocities(fields[0].tree, centers, radii, basis, tractions)
    assert all(field.levels > 0 for field in fields)
    return [
        np.linalg.norm(near + field.apply(tractions) - exact) / np.linalg.norm(exact) / accuracy
        for field, accuracy in zip(fields, accuracies, strict=True)
    ]


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("name", CLUSTERS)
def test_near_and_far_make_the_direct_sum(name, order):
    """The error keeps pace with the accuracy: below it, and not for want of a far field."""
    for error in errors(name, order, (1e-3, 1e-4), 6):
        assert 0.02 < error < 1


def test_high_accuracy():
    """Beyond single precision."""
    assert 0.02 < errors("tree", 1, (1e-6,), 12)[0] < 1


def test_smallest_leaves():
    assert 0.02 < errors("polydisperse tree", 2, (1e-3,), 4)[0] < 1


@pytest.mark.parametrize(("accuracy", "rounding"), [(1e-3, 1e-6), (1e-6, 1e-14)])
@pytest.mark.parametrize("name", ["tree", "chain"])
def test_symmetry_to_rounding(name, accuracy, rounding):
    """Single precision at 1e-5 and above, double below."""
    centers, radii = CLUSTERS[name]
    field = far_field(centers, radii, MultipoleBasis(1), accuracy, 12)
    assert field.levels > 0
    one, other = np.random.default_rng(5).normal(size=(2, len(radii), 3, 1))
    velocities = field.apply(other)
    scale = np.linalg.norm(one) * np.linalg.norm(velocities)
    assert np.vdot(one, velocities) == pytest.approx(np.vdot(field.apply(one), other), abs=rounding * scale)


def leaves_below(tree, level):
    """For each box of the level, which leaves it contains, (boxes, leaves)."""
    return (tree.leaf_keys >> 3 * (tree.depth - level)) == tree.keys(level)[:, None]


@pytest.mark.parametrize("name", CLUSTERS)
@pytest.mark.parametrize("side", [3.0, 6.0, 40.0])
def test_every_ordered_pair_is_counted_once(name, side):
    """Near pairs and interactions of all levels cover the square of all pairs of leaves exactly once."""
    tree = octree(CLUSTERS[name][0], side)
    leaf_count = len(tree.leaf_keys)
    counted = np.zeros((leaf_count, leaf_count), int)
    starts, leaves = tree.neighbours
    np.add.at(counted, (np.repeat(np.arange(leaf_count), np.diff(starts)), leaves), 1)
    if tree.levels:
        inside = np.concatenate([leaves_below(tree, level) for level in tree.levels]).astype(int)
        between = np.zeros((len(inside), len(inside)), int)
        for pairs in tree.interactions():
            np.add.at(between, (pairs.targets, pairs.sources), 1)
        counted += inside.T @ (between + between.T) @ inside
    np.testing.assert_array_equal(counted, 1)


@pytest.mark.parametrize("name", CLUSTERS)
def test_leaves_hold_their_spheres(name):
    centers, _ = CLUSTERS[name]
    tree = octree(centers, 5.0)
    owners = np.repeat(tree.leaf_centers(), np.diff(tree.leaf_starts), axis=0)
    np.testing.assert_array_equal(np.sort(tree.order), np.arange(len(centers)))
    assert np.abs(centers[tree.order] - owners).max() <= 2.5 * (1 + 1e-12)


def test_counts_of_pairs():
    """What the choice of the leaves' side rests on."""
    tree = octree(CLUSTERS["tree"][0], 4.0)
    assert tree.near_pairs() == len(near_pairs(tree)[0]) + 450
    assert tree.far_pairs() == 2 * sum(len(pairs.targets) for pairs in tree.interactions())


def test_one_leaf_has_no_far_field():
    centers, radii = sticking_cluster(4, 1)
    field = far_field(centers, radii, MultipoleBasis(2), 1e-3)
    assert field.levels == 0
    assert field.memory == 0
    assert not field.apply(np.ones((4, 11, 2))).any()


@pytest.mark.parametrize("accuracy", [1e-9, 0.1])
def test_accuracy_out_of_range(accuracy):
    with pytest.raises(ValueError, match=rf"accuracy: expected 1e-07 to 0.01, got {accuracy:g}"):
        far_field(*CLUSTERS["chain"], MultipoleBasis(1), accuracy)


def test_parts_too_far_apart():
    with pytest.raises(ValueError, match=r"centers: expected at most 1048576 leaves across, got 2\^30"):
        octree(np.array([[0.0, 0, 0], [1e9, 0, 0]]), 1.0)
