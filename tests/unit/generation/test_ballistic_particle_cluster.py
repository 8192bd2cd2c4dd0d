"""Ballistic particle–cluster aggregates: compact in the large, and no direction is preferred."""

import numpy as np
import pytest

from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.particles.morphology import radius_of_gyration


def test_volume_fraction_approaches_that_of_ballistic_deposits():
    """Near 0.147, that of thick deposits (R. Jullien and P. Meakin, Europhys. Lett. 4 (1987) 1385), within 0.9 R_g."""
    spheres = ballistic_particle_cluster(8000, seed=1).spheres
    within = 0.9 * radius_of_gyration(spheres)
    inside = np.sum(np.linalg.norm(spheres.centers, axis=1) < within)
    assert 0.12 < inside / within**3 < 0.17


def test_size_grows_as_that_of_a_solid():
    """R_g ∝ N^(1/3), to 0.25 in the dimension."""
    few = np.mean([radius_of_gyration(ballistic_particle_cluster(300, seed=seed).spheres) for seed in range(8)])
    many = np.mean([radius_of_gyration(ballistic_particle_cluster(4800, seed=seed).spheres) for seed in range(3)])
    assert np.log(16) / np.log(many / few) == pytest.approx(3.0, abs=0.25)


def test_no_direction_is_preferred():
    """The second sphere of a doublet is uniform over the sphere: mean zero, second moment one third."""
    normals = np.array([ballistic_particle_cluster(2, seed=seed).normals[0] for seed in range(800)])
    np.testing.assert_allclose(normals.mean(axis=0), 0, atol=4 / np.sqrt(3 * 800))
    np.testing.assert_allclose((normals**2).mean(axis=0), 1 / 3, atol=4 * np.sqrt(4 / 45 / 800))
