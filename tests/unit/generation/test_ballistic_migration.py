"""Ballistic aggregates with migration: contacts gained, and the shortest rolls."""

import numpy as np
import pytest

from rheoclast.generation._cells import add, cells
from rheoclast.generation._deposition import second_contact, third_contact
from rheoclast.generation.ballistic_migration import ballistic_migration
from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.particles.morphology import radius_of_gyration


@pytest.mark.parametrize("spread", [0.0, 0.3])
def test_every_migration_gains_a_contact(spread):
    """2 N − 3 contacts, and about 3 N − 6: some find no third sphere, some touch a fourth by symmetry."""
    for seed in range(3):
        assert len(ballistic_migration(300, spread=spread, seed=seed, migrations=1).pairs) == 2 * 300 - 3
        twice = ballistic_migration(300, spread=spread, seed=seed, migrations=2)
        assert len(twice.pairs) == pytest.approx(3 * 300 - 6, abs=15)


def test_migration_compacts():
    """From one to two to three contacts per sphere the aggregate shrinks."""
    sizes = [
        radius_of_gyration(aggregate.spheres)
        for aggregate in (
            ballistic_particle_cluster(1500, seed=2),
            ballistic_migration(1500, seed=2),
            ballistic_migration(1500, seed=2, migrations=2),
        )
    ]
    assert sizes[0] > 1.1 * sizes[1] > 1.2 * sizes[2]


def table(centers, radii):
    """Cells with spheres at the given places; one more may come."""
    grid = cells(np.append(radii, 1.0))
    for center in centers:
        add(grid, np.array(center, float))
    return grid


def free(place, centers, radii, radius):
    """Gaps of a sphere to all others, (N,)."""
    return np.linalg.norm(np.array(centers) - place, axis=1) - radii - radius


@pytest.mark.parametrize("seed", range(20))
def test_rolls_are_the_shortest(seed):
    """No place within the rolled arc, on the sphere or the circle of contact, touches anything else."""
    rng = np.random.default_rng(seed)
    radii, radius = rng.uniform(0.6, 1.5, 7), 0.8
    directions = rng.normal(size=(6, 3))
    arms = (radii[0] + radii[1:] + rng.uniform(0.0, 1.5, 6))[:, None]
    centers = np.vstack([np.zeros((1, 3)), arms * directions / np.linalg.norm(directions, axis=1, keepdims=True)])
    arm = radii[0] + radius
    sample = rng.normal(size=(4000, 3))
    sample *= arm / np.linalg.norm(sample, axis=1, keepdims=True)
    gaps = np.array([free(place, centers[1:], radii[1:], radius).min() for place in sample])
    start = sample[gaps.argmax()]
    grid = table(centers, radii)
    place, touched = second_contact(grid, start, radius, 0, np.arange(7))
    at_rest = free(place, centers, radii, radius)
    assert np.abs(at_rest[[0, touched]]).max() < 1e-12
    assert at_rest.min() > -1e-12
    nearer = sample @ start > place @ start + 1e-9
    assert gaps[nearer].min() > 0

    end = third_contact(grid, place, radius, 0, touched, np.arange(7))
    at_end = free(end, centers, radii, radius)
    assert np.abs(at_end[[0, touched]]).max() < 1e-12
    assert at_end.min() > -1e-12
    assert np.sum(np.abs(at_end) < 1e-12) == 3 or np.array_equal(place, end)
    axis = centers[touched] / np.linalg.norm(centers[touched])
    middle = (place @ axis) * axis
    rolled = np.arccos(np.clip((end - middle) @ (place - middle) / np.sum((place - middle) ** 2), -1, 1))
    others = [k for k in range(1, 7) if k != touched]
    for angle in np.linspace(-rolled, rolled, 101)[1:-1]:
        out, side = place - middle, np.cross(axis, place - middle)
        on_the_way = middle + np.cos(angle) * out + np.sin(angle) * side
        assert free(on_the_way, centers[others], radii[others], radius).min() > -1e-12


def test_known_rolls():
    """Over a doublet a sphere rolls to the notch; over three in a triangle to the tetrahedron."""
    side = np.sqrt(3)
    grid = table([[0, 0, 0], [2, 0, 0]], [1.0, 1.0])
    place, touched = second_contact(grid, np.array([0, 2.0, 0]), 1.0, 0, np.arange(2))
    np.testing.assert_allclose(place, [1, side, 0], atol=1e-14)
    assert touched == 1
    np.testing.assert_array_equal(third_contact(grid, place, 1.0, 0, 1, np.arange(2)), place)
    grid = table([[0, 0, 0], [2, 0, 0], [1, side, 0]], [1.0, 1.0, 1.0])
    start = np.array([1.0, -side * np.cos(0.1), side * np.sin(0.1)])
    top = third_contact(grid, start, 1.0, 0, 1, np.arange(3))
    np.testing.assert_allclose(top, [1, side / 3, np.sqrt(8 / 3)], atol=1e-14)


def test_no_other_sphere_within_the_roll():
    """The place of first touch is kept."""
    grid = table([[0, 0, 0], [5, 0, 0]], [1.0, 1.0])
    start = np.array([0, 2.0, 0])
    place, touched = second_contact(grid, start, 1.0, 0, np.arange(2))
    np.testing.assert_array_equal(place, start)
    assert touched == -1


@pytest.mark.parametrize(
    ("migrations", "message"),
    [
        (0, r"^migrations: expected an integer of at least 1, got 0$"),
        (3, r"^migrations: expected 1 or 2, got 3; a sphere on three others rests$"),
    ],
)
def test_refused_migrations(migrations, message):
    """One or two."""
    with pytest.raises(ValueError, match=message):
        ballistic_migration(10, migrations=migrations)
