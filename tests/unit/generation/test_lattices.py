"""Lattices: coordination and density in bulk, known blocks and balls."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from rheoclast.generation.lattices import LATTICES, lattice_ball, lattice_block
from rheoclast.particles.morphology import coordination_numbers

DENSITY = {"sc": np.pi / 6, "bcc": np.sqrt(3) * np.pi / 8, "fcc": np.pi / np.sqrt(18), "hcp": np.pi / np.sqrt(18)}


@pytest.mark.parametrize("lattice", LATTICES)
@pytest.mark.parametrize("counts", [(1, 1, 1), (1, 1, 5), (4, 3, 2), (2, 5, 3), (1, 4, 2), (5, 1, 4)])
def test_blocks_are_exact_and_connected(assert_exactly_touching, lattice, counts):
    """Of as many spheres as asked for."""
    assert_exactly_touching(lattice_block(lattice, counts, 3e-8), int(np.prod(counts)), 3e-8)


@pytest.mark.parametrize("lattice", ["sc", "fcc", "hcp"])
@pytest.mark.parametrize("counts", [(4, 1, 1), (1, 6, 1), (5, 4, 1)])
def test_one_layer_is_planar(assert_exactly_touching, lattice, counts):
    """And holds together: square for sc and fcc, triangular for hcp."""
    layer = lattice_block(lattice, counts)
    assert_exactly_touching(layer, int(np.prod(counts)), 1.0)
    np.testing.assert_allclose(layer.spheres.centers[:, 2], 0, atol=1e-14)
    nx, ny, _ = counts
    square = nx * (ny - 1) + ny * (nx - 1)
    assert len(layer.pairs) == square + (lattice == "hcp") * (nx - 1) * (ny - 1)


@pytest.mark.parametrize("lattice", LATTICES)
def test_bulk_coordination_and_density(lattice):
    """Inner sites have the lattice's coordination; layers hold spheres at its volume fraction."""
    block = lattice_block(lattice, (7, 7, 7))
    inner = coordination_numbers(block).reshape(7, 7, 7)[2:-2, 2:-2, 2:-2]
    assert set(inner.ravel()) == {LATTICES[lattice].coordination}
    cell = np.prod(LATTICES[lattice].spacing)
    assert 4 / 3 * np.pi / cell == pytest.approx(DENSITY[lattice], rel=1e-14)


def test_fcc_and_hcp_differ_in_their_next_neighbours():
    """The fcc lattice has 6 second neighbours at 2√2; hcp has 2 at 4 √(2/3) besides, which fcc lacks."""
    for lattice, expected in (("fcc", 0), ("hcp", 2)):
        centers = lattice_ball(lattice, 200).spheres.centers
        between = np.linalg.norm(centers - centers[0], axis=1)
        assert np.sum(np.abs(between - 2 * np.sqrt(2)) < 1e-9) == 6
        assert np.sum(np.abs(between - 4 * np.sqrt(2 / 3)) < 1e-9) == expected


@pytest.mark.parametrize("lattice", LATTICES)
@pytest.mark.parametrize("count", [1, 2, 13, 50, 137, 500])
def test_balls_are_exact_and_connected(assert_exactly_touching, lattice, count):
    """At every count, whole shells or not."""
    assert_exactly_touching(lattice_ball(lattice, count, 1e-6), count, 1e-6)


@pytest.mark.parametrize("lattice", LATTICES)
def test_balls_take_the_nearest_sites(lattice):
    """No site of a block around the central site is nearer to it than an occupied one and yet empty."""
    centers = lattice_ball(lattice, 150).spheres.centers
    centers = centers - centers[0]
    reach = np.linalg.norm(centers, axis=1)
    np.testing.assert_allclose(np.sort(reach), reach, atol=1e-8)
    indices = np.stack(np.meshgrid(*[np.arange(-12, 13)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    sites = LATTICES[lattice].sites(indices)
    np.testing.assert_allclose(cKDTree(sites).query(centers)[0], 0, atol=1e-9)
    assert np.sum(np.linalg.norm(sites, axis=1) < reach[-1] - 1e-6) <= 150


def test_whole_shells():
    """Shells close in fcc at 13, 19, 43; sc at 7, 19, 27; bcc at 9, 15: the mass is on a site."""
    for lattice, counts in (("fcc", (13, 19, 43)), ("sc", (7, 19, 27)), ("bcc", (9, 15))):
        for count in counts:
            np.testing.assert_allclose(lattice_ball(lattice, count).spheres.centers[0], 0, atol=1e-12)
    assert len(lattice_ball("fcc", 13).pairs) == 36


@pytest.mark.parametrize("count", [3, 5, 11, 15, 21, 33])
def test_partial_shells_of_cubic_lattices_are_balanced(count):
    """Odd counts consist of opposite pairs around the centre, whose mass stays where it was."""
    for lattice in ("sc", "bcc", "fcc"):
        np.testing.assert_allclose(lattice_ball(lattice, count).spheres.centers[0], 0, atol=1e-12)


def test_bad_requests_are_refused():
    """In one sentence."""
    with pytest.raises(ValueError, match="lattice: expected one of sc, bcc, fcc, hcp, got 'diamond'"):
        lattice_ball("diamond", 10)
    with pytest.raises(ValueError, match="lattice: expected one of sc, bcc, fcc, hcp, got 'diamond'"):
        lattice_block("diamond", (2, 2, 2))
    with pytest.raises(ValueError, match=r"counts: expected at least 2 layers of bcc, .* got \(3, 3, 1\)"):
        lattice_block("bcc", (3, 3, 1))
    with pytest.raises(ValueError, match=r"counts\[1\]: expected an integer of at least 1, got 0"):
        lattice_block("sc", (3, 0, 1))
    with pytest.raises(ValueError, match=r"counts: expected three integers \(row, rows, layers\), got \(3, 3\)"):
        lattice_block("sc", (3, 3))
    with pytest.raises(ValueError, match="count: expected an integer of at least 1, got 0"):
        lattice_ball("sc", 0)
