"""What all families of open aggregates have in common: exact contacts, no overlap, seeds, units, refusals."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation.ballistic_cluster_cluster import ballistic_cluster_cluster
from rheoclast.generation.ballistic_migration import ballistic_migration
from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.generation.cluster_cluster import cluster_cluster
from rheoclast.generation.diffusion_limited_cluster_cluster import diffusion_limited_cluster_cluster
from rheoclast.generation.diffusion_limited_particle_cluster import diffusion_limited_particle_cluster
from rheoclast.generation.reaction_limited_cluster_cluster import reaction_limited_cluster_cluster

TREES = [
    ballistic_cluster_cluster,
    ballistic_particle_cluster,
    diffusion_limited_cluster_cluster,
    diffusion_limited_particle_cluster,
    reaction_limited_cluster_cluster,
    cluster_cluster,
]
FAMILIES = [*TREES, ballistic_migration]


def gaps(aggregate):
    """Gap over mean radius of all pairs (N (N − 1) / 2,)."""
    centers, radii = aggregate.spheres.centers, aggregate.spheres.radii
    i, j = np.triu_indices(len(radii), 1)
    distance = np.linalg.norm(centers[i] - centers[j], axis=1)
    return 2 * (distance - radii[i] - radii[j]) / (radii[i] + radii[j])


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize(("count", "spread"), [(3, 0.0), (10, 0.0), (10, 0.25), (150, 0.0), (150, 0.25)])
def test_spheres_touch_exactly_and_nowhere_overlap(family, count, spread):
    """Every gap is either rounding, and a contact, or so large that it is none."""
    aggregate = family(count, radius=2e-7, spread=spread, seed=3)
    all_gaps = gaps(aggregate)
    assert len(aggregate) == count
    assert all_gaps.min() > -1e-9
    assert np.sum(np.abs(all_gaps) < 1e-9) == len(aggregate.pairs) >= count - 1
    assert np.linalg.norm(aggregate.spheres.center_of_mass) < 1e-12 * 2e-7 * count


@pytest.mark.parametrize("family", TREES)
def test_one_contact_joins_each_piece(family):
    """Rigid pieces that stick at first touch close no loop."""
    assert all(family(60, spread=spread, seed=seed).is_tree for seed in range(4) for spread in (0.0, 0.3))


@pytest.mark.parametrize("family", FAMILIES)
def test_equal_seeds_give_equal_aggregates(family):
    """Bit for bit; another seed gives another aggregate."""
    one, same, other = (family(40, spread=0.2, seed=seed).spheres for seed in (5, 5, 6))
    np.testing.assert_array_equal(one.centers, same.centers)
    np.testing.assert_array_equal(one.radii, same.radii)
    assert not np.allclose(np.sort(one.radii), np.sort(other.radii))


@pytest.mark.parametrize("family", FAMILIES)
def test_radius_is_the_unit_of_length(family):
    """The same aggregate, larger; equal spheres have exactly the radius asked for."""
    small, unit = family(40, radius=3e-9, seed=1).spheres, family(40, seed=1).spheres
    np.testing.assert_allclose(small.centers, 3e-9 * unit.centers, rtol=1e-13, atol=1e-21)
    assert (small.radii == 3e-9).all()


@pytest.mark.parametrize("family", FAMILIES)
def test_radii_are_log_normal(family):
    """Mean and standard deviation of ln radius, each within four standard errors of 400 draws."""
    logarithms = np.log(family(400, radius=2e-6, spread=0.2, seed=2).spheres.radii / 2e-6)
    assert abs(logarithms.mean()) < 4 * 0.2 / np.sqrt(400)
    assert abs(logarithms.std() - 0.2) < 4 * 0.2 / np.sqrt(800)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize(
    ("request_", "message"),
    [
        ({"count": 0}, r"^count: expected an integer of at least [12], got 0$"),
        ({"count": 10.0}, r"^count: expected an integer of at least [12], got 10\.0$"),
        ({"count": True}, r"^count: expected an integer of at least [12], got True$"),
        ({"radius": -1e-6}, r"^radius: expected a positive number, got -1e-06$"),
        ({"spread": -0.1}, r"^spread: expected zero or a positive number, got -0\.1$"),
        ({"spread": 1.5}, r"^spread: expected a standard deviation of ln radius from 0 to 1, got 1\.5$"),
        ({"seed": -1}, r"^seed: expected an integer of at least 0, got -1$"),
        ({"seed": None}, r"^seed: expected an integer of at least 0, got None$"),
    ],
)
def test_refused_requests(family, request_, message):
    """Each parameter is checked and named."""
    with pytest.raises(ValueError, match=message):
        family(**({"count": 10} | request_))


@pytest.mark.parametrize("family", [family for family in FAMILIES if family is not cluster_cluster])
def test_one_and_two_spheres(family):
    """A lone sphere at the origin; a doublet around it."""
    lone, doublet = family(1, radius=2.0), family(2, radius=2.0)
    np.testing.assert_array_equal(lone.spheres.centers, [[0, 0, 0]])
    assert doublet.pairs.tolist() == [[0, 1]]
    np.testing.assert_allclose(np.linalg.norm(doublet.spheres.centers, axis=1), 2.0, rtol=1e-12)
    assert isinstance(lone, rc.Aggregate)
