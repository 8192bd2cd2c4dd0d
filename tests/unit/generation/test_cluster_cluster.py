"""Cluster–cluster aggregates with prescribed dimension and prefactor."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation.cluster_cluster import cluster_cluster
from rheoclast.particles.morphology import radius_of_gyration


@pytest.mark.parametrize(
    ("dimension", "prefactor"), [(1.2, 1.3), (1.8, 1.3), (1.8, 2.0), (2.2, 1.3), (2.5, 1.3), (3.0, 0.5)]
)
@pytest.mark.parametrize("spread", [0.0, 0.3])
@pytest.mark.parametrize("count", [17, 120])
def test_fractal_law_is_met(dimension, prefactor, spread, count):
    """N = k (R_g / a)^D with a the geometric mean of the radii."""
    aggregate = cluster_cluster(
        count, radius=5e-7, fractal_dimension=dimension, prefactor=prefactor, spread=spread, seed=1
    )
    mean = np.exp(np.log(aggregate.spheres.radii).mean())
    law = prefactor * (radius_of_gyration(aggregate.spheres) / mean) ** dimension
    assert law == pytest.approx(count, rel=1e-9)


@pytest.mark.parametrize("prefactor", [1.25, 1.4, 1.5])
def test_three_spheres_open_and_close(prefactor):
    """Three spheres with the angle 2 θ between the contacts: R_g² = (8/3) sin² θ + (8/9) cos² θ + 3/5."""
    spheres = cluster_cluster(3, fractal_dimension=2.0, prefactor=prefactor, seed=4).spheres
    distances = np.sort([np.linalg.norm(spheres.centers[i] - spheres.centers[j]) for i, j in ((0, 1), (0, 2), (1, 2))])
    half_sine2 = (3 / prefactor - 0.6 - 8 / 9) / (8 / 3 - 8 / 9)
    np.testing.assert_allclose(distances, [2, 2, 4 * np.sqrt(half_sine2)], rtol=1e-12)


@pytest.mark.parametrize("dimension", [1.7, 2.3])
def test_pieces_are_fractal_too(dimension):
    """The number of spheres within r of a sphere grows as r^D well inside the aggregate, to 0.25 in D."""
    slopes = []
    for seed in range(6):
        centers = cluster_cluster(600, fractal_dimension=dimension, seed=seed).spheres.centers
        distance = np.linalg.norm(centers[:, None] - centers, axis=2)
        near, far = 3.0, 0.6 * np.sqrt(np.mean(np.sum(centers**2, axis=1)))
        slopes.append(np.log(np.mean(distance < far) / np.mean(distance < near)) / np.log(far / near))
    assert np.mean(slopes) == pytest.approx(dimension, abs=0.25)


@pytest.mark.parametrize("value", [0.9, 3.1])
def test_refused_dimension(value):
    """From a line to a solid."""
    with pytest.raises(ValueError, match=rf"^fractal_dimension: expected a number from 1 to 3, got {value:g}$"):
        cluster_cluster(10, fractal_dimension=value)


def test_refused_prefactor_and_count():
    """A prefactor is positive; a lone sphere has no dimension."""
    with pytest.raises(ValueError, match=r"^prefactor: expected a positive number, got 0$"):
        cluster_cluster(10, prefactor=0)
    with pytest.raises(ValueError, match=r"^count: expected an integer of at least 2, got 1$"):
        cluster_cluster(1)


def test_no_aggregate_is_longer_than_a_straight_chain():
    """R_g² of the chain is (N² − 1) / 3 + 3/5 in radii; the message gives both."""
    with pytest.raises(
        rc.GeometryError,
        match=r"^50 spheres with dimension 1 and prefactor 1\.5 have a radius of gyration of 33\.33 radii, "
        r"more than that of a straight chain, 28\.87; raise the prefactor or the dimension$",
    ):
        cluster_cluster(50, fractal_dimension=1.0, prefactor=1.5)


def test_no_aggregate_is_denser_than_the_densest_packing():
    """A ball of volume fraction π/√18."""
    with pytest.raises(
        rc.GeometryError,
        match=r"^1000 spheres with dimension 3 and prefactor 2 have a radius of gyration of 7\.937 radii, "
        r"less than that of the densest packing, 8\.562; lower the prefactor or the dimension$",
    ):
        cluster_cluster(1000, fractal_dimension=3.0, prefactor=2.0)


def test_a_search_in_vain_is_reported():
    """Two spheres have R_g² = 8/5 and nothing else."""
    with pytest.raises(
        rc.GeometryError,
        match=r"^no arrangement of 2 spheres with dimension 2 and prefactor 1\.3 was found, "
        r"which is a radius of gyration of 1\.24 radii; lower the prefactor",
    ):
        cluster_cluster(2, fractal_dimension=2.0, prefactor=1.3)
    doublet = cluster_cluster(2, fractal_dimension=2.0, prefactor=2 / 1.6)
    assert radius_of_gyration(doublet.spheres) == pytest.approx(np.sqrt(1.6), rel=1e-12)
