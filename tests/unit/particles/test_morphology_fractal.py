"""Fractal dimensions of shapes whose dimension is known, and of a law with known scatter."""

import numpy as np
import pytest
from scipy.stats import t

import rheoclast as rc
from rheoclast.generation import ring
from rheoclast.particles.fractal import _jackknife_error, fractal_law, pair_correlation_dimension
from rheoclast.particles.morphology import radius_of_gyration


def chain(count, radius=1.0):
    centers = np.stack([2.0 * np.arange(count), np.zeros(count), np.zeros(count)], axis=1)
    return rc.Aggregate.touching(rc.Spheres(radius * centers, radius))


def layer(reach):
    """Disc of a triangular lattice."""
    i, j = np.mgrid[-2 * reach : 2 * reach + 1, -2 * reach : 2 * reach + 1].reshape(2, -1)
    centers = np.stack([2.0 * i + j, np.sqrt(3) * j, 0 * i], axis=1)
    return rc.Aggregate.touching(rc.Spheres(centers[np.linalg.norm(centers, axis=1) <= 2 * reach], 1.0))


def fcc_ball(reach):
    grid = np.mgrid[-reach : reach + 1, -reach : reach + 1, -reach : reach + 1].reshape(3, -1).T
    inside = (grid.sum(axis=1) % 2 == 0) & (np.linalg.norm(grid, axis=1) <= reach)
    return rc.Aggregate.touching(rc.Spheres(np.sqrt(2) * grid[inside], 1.0))


def directed_walk(count):
    """Centres of touching spheres in a walk along +x, +y or +z at random."""
    steps = np.eye(3)[np.random.default_rng(1).integers(3, size=count)]
    return 2 * np.cumsum(steps, axis=0)


def stretched(count, gyration):
    """Unit spheres in line, declared to be in contact, so far apart that they have the radius of gyration."""
    distance = np.sqrt(12 * (gyration**2 - 0.6) / (count**2 - 1))
    spheres = rc.Spheres(np.outer(distance * np.arange(count), [1, 0, 0]), 1.0)
    return rc.Aggregate(spheres, np.stack([np.arange(count - 1), np.arange(1, count)], axis=1))


def test_law_of_chains_layers_and_balls():
    """One, two and three, inside the interval widened by what the smallest sizes miss."""
    for shapes, dimension, error in (
        ([chain(n) for n in (20, 50, 100, 400)], 1, 0.01),
        ([layer(n) for n in (4, 6, 9, 14)], 2, 0.05),
        ([fcc_ball(n) for n in (4, 6, 8, 11)], 3, 0.05),
    ):
        law = fractal_law(shapes)
        assert law.dimension == pytest.approx(dimension, abs=error)
        assert law.dimension_interval[0] < law.dimension < law.dimension_interval[1]
        assert law.prefactor_interval[0] < law.prefactor < law.prefactor_interval[1]


def test_law_passes_through_three_chains():
    """Prefactor of a long chain: N = √3 Rg/a; `count` gives the number back; the unit does not matter."""
    law = fractal_law([chain(n, radius=2e-7) for n in (1000, 2000, 4000)])
    assert law.prefactor == pytest.approx(np.sqrt(3), rel=1e-4)
    gyration = radius_of_gyration(chain(1500).spheres)
    assert law.count(gyration) == pytest.approx(1500, rel=1e-4)


def test_interval_of_the_law_is_the_textbook_one():
    """Fit of ln Rg on ln N and its covariance by NumPy, carried over to D = 1/s and ln k = −c/s to first order."""
    aggregates = [shape(n) for n in (5, 9, 17, 33) for shape in (chain, ring)]
    sizes = np.log([len(a) for a in aggregates])
    gyrations = np.log([radius_of_gyration(a.spheres) for a in aggregates])
    (slope, intercept), covariance = np.polyfit(sizes, gyrations, 1, cov=True)
    law = fractal_law(aggregates, confidence=0.9)
    quantile = t.ppf(0.95, len(aggregates) - 2)
    assert law.dimension == pytest.approx(1 / slope, rel=1e-10)
    assert np.log(law.prefactor) == pytest.approx(-intercept / slope, rel=1e-10)
    reach = quantile * np.sqrt(covariance[0, 0])
    np.testing.assert_allclose(law.dimension_interval, (1 / (slope + reach), 1 / (slope - reach)), rtol=1e-9)
    gradient = np.array([intercept / slope**2, -1 / slope])
    upper = np.log(law.prefactor_interval[1] / law.prefactor)
    assert upper == pytest.approx(quantile * np.sqrt(gradient @ covariance @ gradient), rel=1e-9)


def test_scatter_at_equal_number_does_not_lower_the_dimension():
    """Radii of gyration off the law by 30 % either way: N on Rg would give 2.25, below the 2.5 of the law."""
    rng = np.random.default_rng(0)
    aggregates = []
    for count in np.geomspace(10, 100, 12).round().astype(int):
        for _ in range(40):
            aggregates.append(stretched(count, 50 * count**0.4 * np.exp(0.3 * rng.standard_normal())))
    law = fractal_law(aggregates)
    assert law.dimension == pytest.approx(2.5, abs=0.12)
    assert law.dimension_interval[0] < 2.5 < law.dimension_interval[1]


def test_unequal_spheres_count_by_their_geometric_mean():
    """Rg is divided by the geometric mean of the radii: scaling all of it changes nothing, unequal radii do."""
    unequal = [rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [5, 0, 0]], [1.0, 4.0])) for _ in range(2)]
    law = fractal_law([*unequal, chain(3)])
    gyration = radius_of_gyration(unequal[0].spheres) / 2.0
    assert law.count(gyration) == pytest.approx(2, rel=1e-9)


@pytest.mark.parametrize(
    ("aggregate", "dimension", "error"),
    [(chain(100), 1, 0.03), (chain(1000), 1, 0.01), (layer(30), 2, 0.05), (fcc_ball(12), 3, 0.05)],
)
def test_pair_correlation_of_known_shapes(aggregate, dimension, error):
    """One for chains, two for layers, three for balls."""
    found = pair_correlation_dimension(aggregate)
    assert found.dimension == pytest.approx(dimension, abs=error)
    assert found.interval[0] <= found.dimension <= found.interval[1]


def test_pair_correlation_counts_by_definition():
    """The slope is that of the mean number of centres within r of the inner spheres, counted one by one."""
    centers = directed_walk(600)
    aggregate = rc.Aggregate.touching(rc.Spheres(1e-6 * centers, 1e-6))
    offset = centers - centers.mean(axis=0)
    gyration = radius_of_gyration(aggregate.spheres) / 1e-6
    inner = offset[np.linalg.norm(offset, axis=1) <= gyration / 2]
    r = np.geomspace(5, gyration, 30)
    between = np.linalg.norm(inner[:, None] - offset, axis=-1)
    counts = (between[..., None] <= r).sum(axis=1).mean(axis=0)
    found = pair_correlation_dimension(aggregate)
    assert found.dimension == pytest.approx(np.polyfit(np.log(r), np.log(counts), 1)[0], rel=1e-9)
    np.testing.assert_allclose(found.distances, [5e-6, 1e-6 * gyration], rtol=1e-12)


def test_interval_widens_with_confidence():
    """By the ratio of Student's quantiles at seven freedoms, about the same dimension."""
    aggregate = rc.Aggregate.touching(rc.Spheres(directed_walk(300), 1.0))
    narrow, wide = (pair_correlation_dimension(aggregate, confidence=c).interval for c in (0.5, 0.99))
    assert sum(narrow) == pytest.approx(sum(wide), rel=1e-12)
    assert (wide[1] - wide[0]) / (narrow[1] - narrow[0]) == pytest.approx(t.ppf(0.995, 7) / t.ppf(0.75, 7), rel=1e-9)


def test_jackknife_gives_the_standard_error_of_a_mean_of_blocks():
    """Counts r^(1 + δ) with small δ have the slope 1 + mean δ, whose error is that of the mean of the eight blocks."""
    rng = np.random.default_rng(5)
    exponents = 1 + 1e-6 * rng.normal(size=(8, 50))
    distances = np.geomspace(5, 20, 30)
    counts = distances ** exponents.reshape(-1, 1)
    expected = exponents.mean(axis=1).std(ddof=1) / np.sqrt(8)
    assert _jackknife_error(distances, counts, np.repeat(np.arange(8), 50)) == pytest.approx(expected, rel=1e-4)


def test_too_little_is_refused():
    """With what was expected, what came, and what to do."""
    with pytest.raises(ValueError, match=r"aggregates: expected at least 3, got 2; add aggregates of other sizes"):
        fractal_law([chain(3), chain(4)])
    with pytest.raises(ValueError, match=r"expected several sizes, got 3 of 3 spheres"):
        fractal_law([chain(3)] * 3)
    with pytest.raises(ValueError, match=r"expected radii of gyration that grow with the number of spheres"):
        fractal_law([chain(20), layer(2), layer(3)])
    with pytest.raises(TypeError, match=r"aggregates\[1\]: expected Aggregate, got Spheres"):
        fractal_law([chain(3), chain(4).spheres, chain(5)])
    with pytest.raises(ValueError, match=r"radius of gyration of at least 8 mean sphere radii, got 5\.8;"):
        pair_correlation_dimension(chain(10))
    with pytest.raises(ValueError, match=r"at least 16 spheres within 0\.5 radii of gyration .* got 8"):
        pair_correlation_dimension(chain(30))
    with pytest.raises(ValueError, match=r"confidence: expected a share between 0 and 1, got 1;"):
        pair_correlation_dimension(chain(100), confidence=1.0)
