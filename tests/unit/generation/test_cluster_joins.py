"""Growth laws of the families that arise from a process: sizes, and where a third sphere sticks."""

import numpy as np
import pytest

from rheoclast.generation._bonding import random_contact
from rheoclast.generation._clusters import cluster, union
from rheoclast.generation._deposition import deposited
from rheoclast.generation._joining import ballistic_join, diffusive_join
from rheoclast.generation.ballistic_cluster_cluster import ballistic_cluster_cluster
from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.generation.diffusion_limited_cluster_cluster import diffusion_limited_cluster_cluster
from rheoclast.generation.diffusion_limited_particle_cluster import diffusion_limited_particle_cluster
from rheoclast.generation.reaction_limited_cluster_cluster import reaction_limited_cluster_cluster
from rheoclast.particles.morphology import radius_of_gyration


def mean_logarithm_of_size(family, count, seeds):
    """Mean of ln R_g over the first so many seeds."""
    return np.mean([np.log(radius_of_gyration(family(count, seed=seed).spheres)) for seed in range(seeds)])


@pytest.mark.parametrize(
    ("family", "published", "tolerance"),
    [
        (ballistic_cluster_cluster, 1.91, 0.12),
        (diffusion_limited_cluster_cluster, 1.78, 0.12),
        (reaction_limited_cluster_cluster, 2.11, 0.15),
        (diffusion_limited_particle_cluster, 2.5, 0.2),
    ],
)
def test_fractal_dimension(family, published, tolerance):
    """The published dimension, from the growth of R_g between 30 and 400 spheres."""
    growth = mean_logarithm_of_size(family, 400, 15) - mean_logarithm_of_size(family, 30, 60)
    assert np.log(400 / 30) / growth == pytest.approx(published, abs=tolerance)


def cosines(family, samples):
    """Cosine of the angle between the two contacts of three spheres."""
    for seed in range(samples):
        centers = family(3, seed=seed).spheres.centers
        distances = [np.linalg.norm(centers[i] - centers[j]) for i, j in ((0, 1), (0, 2), (1, 2))]
        yield 1 - max(distances) ** 2 / 8


def test_reaction_limited_contacts_are_uniform_over_the_free_surface():
    """The cosine of the angle between two contacts is uniform from −1 to 1/2, where the outer spheres touch."""
    sample = np.array(list(cosines(reaction_limited_cluster_cluster, 600)))
    assert -1 <= sample.min() < -0.98
    assert 0.48 < sample.max() <= 0.5 + 1e-12
    assert sample.mean() == pytest.approx(-0.25, abs=4 * 1.5 / np.sqrt(12 * 600))
    assert sample.var() == pytest.approx(1.5**2 / 12, rel=0.15)


@pytest.mark.parametrize(
    ("of_clusters", "of_particles"),
    [
        (ballistic_cluster_cluster, ballistic_particle_cluster),
        (diffusion_limited_cluster_cluster, diffusion_limited_particle_cluster),
    ],
)
def test_a_lone_sphere_is_the_smallest_cluster(of_clusters, of_particles):
    """A sphere that meets a doublet does so alike in both routes: equal mean cosines within four standard errors."""
    one, other = np.array(list(cosines(of_clusters, 400))), np.array(list(cosines(of_particles, 400)))
    assert abs(one.mean() - other.mean()) < 4 * np.hypot(one.std(), other.std()) / np.sqrt(400)


def ballistic_arrivals(route, samples):
    """Heights z at which spheres of radius √2 − 1 on straight lines touch a doublet of unit spheres at z = ±1."""
    rng, radii = np.random.default_rng(4), np.array([1.0, 1.0, np.sqrt(2) - 1])
    doublet, lone = cluster(np.array([[0, 0, -1.0], [0, 0, 1.0]]), radii[:2]), cluster(np.zeros((1, 3)), radii[2:])
    for _ in range(samples):
        if route == "cells":
            centers = deposited(radii, 0, rng)
        else:
            joined = ballistic_join(doublet, lone, rng)
            centers = joined.centers[np.argsort(-joined.radii)]
        yield (centers[2] - centers[:2].mean(axis=0)) @ (centers[1] - centers[0]) / 2


@pytest.mark.parametrize("route", ["cells", "tree of balls"])
def test_straight_lines_hit_by_projected_area(route):
    """The convex ends of a doublet are hit uniformly, and in proportion to their surface over four times the shadow.

    The centre arrives at two spheres of radius R = √2 at z = ±1. Their shadow along a line at the cosine u to the axis
    is two discs with the distance 2 √(1 − u²) = 2 R c, of area R² (2 π − 2 arccos c + 2 c √(1 − c²)).
    """
    height = np.array(list(ballistic_arrivals(route, 4000)))
    assert height.mean() == pytest.approx(0, abs=4 * height.std() / np.sqrt(4000))
    height = np.abs(height)
    ends = height[height > 1] - 1
    cosine = np.sqrt((1 - ((np.arange(2000) + 0.5) / 2000) ** 2) / 2)
    shadow = 2 * np.mean(2 * np.pi - 2 * np.arccos(cosine) + 2 * cosine * np.sqrt(1 - cosine**2))
    share = 8 * np.pi / (4 * shadow)
    assert len(ends) / 4000 == pytest.approx(share, abs=4 * np.sqrt(share * (1 - share) / 4000))
    assert ends.mean() == pytest.approx(np.sqrt(0.5), abs=4 * np.sqrt(2 / 12 / len(ends)))
    assert ends.var() == pytest.approx(2 / 12, rel=0.1)


def bonded(first, second, rng):
    """Union of two clusters at a random contact without overlap."""
    while True:
        found, rotation, shift = random_contact(first, second, 1.0, rng)
        if found:
            return union(first, second, rotation, shift)


@pytest.mark.parametrize("join", [ballistic_join, diffusive_join, bonded])
def test_pieces_meet_in_all_orientations(join):
    """The axes of two doublets enclose an angle whose cosine is about uniform; crossed rods only have more contacts."""
    rng, radii, other = np.random.default_rng(5), np.ones(2), np.full(2, 0.999)
    one, two = (cluster(a[:, None] * np.array([[0, 0, -1.0], [0, 0, 1.0]]), a) for a in (radii, other))
    cosines = np.empty(1000)
    for k in range(1000):
        joined = join(one, two, rng)
        first, second = (np.diff(joined.centers[joined.radii == a[0]], axis=0)[0] / (2 * a[0]) for a in (radii, other))
        cosines[k] = abs(first @ second)
    counts = np.histogram(cosines, bins=5, range=(0, 1 + 1e-12))[0]
    np.testing.assert_allclose(counts / 1000, 0.2, atol=0.05)


def test_random_contacts_weigh_the_surface():
    """On a doublet a third unit sphere has 3/4 of the surface; a pair of radius 0.7 has 0.49 of the weight."""
    rng = np.random.default_rng(1)
    lone, doublet = cluster(np.zeros((1, 3)), np.ones(1)), cluster(np.array([[0, 0, -1.0], [0, 0, 1.0]]), np.ones(2))
    accepted = [random_contact(doublet, lone, 1.0, rng)[0] for _ in range(4000)]
    assert np.mean(accepted) == pytest.approx(0.75, abs=4 * np.sqrt(0.1875 / 4000))
    small = cluster(np.zeros((1, 3)), np.full(1, 0.7))
    accepted = [random_contact(small, small, 1.0, rng)[0] for _ in range(4000)]
    assert np.mean(accepted) == pytest.approx(0.49, abs=4 * np.sqrt(0.25 / 4000))
