"""Distributions of fragments: definitions, conservation of mass, known laws, and intervals."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cluster_cluster, straight_chain
from rheoclast.populations.fragment_distribution import fragment_distribution


def halves(count, seed=0):
    """Breakage in two at a uniform place: b(x) = 2."""
    fractions = np.random.default_rng(seed).uniform(size=count)
    return [(x, 1 - x) for x in fractions]


def splits(count):
    """What becomes of trees of unequal spheres in extension, and one chain that is only compressed."""
    for seed in range(count):
        tree = cluster_cluster(15, seed=seed)
        response = rc.rigid_response(tree.spheres, rc.FreeDraining(), 1.0)
        yield rc.break_up(tree, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, 1.0), rc.uniaxial_extension(1.0))


def test_by_hand():
    """Three events: (¼, ¾), (½, ½), (0.2, 0.3, 0.5) into bins with bounds 0, 0.3, 0.5, 1; bounds belong above."""
    found = fragment_distribution([[1, 3], [2e-18, 2e-18], [0.2, 0.3, 0.5]], bins=[0, 0.3, 0.5, 1])
    np.testing.assert_allclose(found.number, np.array([2, 1, 4]) / 7)
    np.testing.assert_allclose(found.mass, np.array([0.45, 0.3, 2.25]) / 3)
    np.testing.assert_array_equal(found.event, [0, 0, 1, 1, 2, 2, 2])
    assert (found.events, found.mean_fragments) == (3, pytest.approx(7 / 3))
    np.testing.assert_allclose(found.daughter_density, np.array([2, 1, 4]) / 3 / [0.3, 0.2, 0.5])
    assert found.erosive_share(0.25) == pytest.approx(1 / 7)
    assert found.erosive_share() == 0
    np.testing.assert_allclose(found.cumulative([0.1, 0.25, 1.0]), [0, 2 / 7, 1])


@pytest.mark.parametrize("bins", [1, 7, [0, 0.01, 1]])
def test_mass_and_number_are_conserved(bins):
    rng = np.random.default_rng(3)
    found = fragment_distribution([rng.exponential(size=rng.integers(2, 9)) for _ in range(50)], bins=bins)
    assert found.number.sum() == pytest.approx(1, rel=1e-12)
    assert found.mass.sum() == pytest.approx(1, rel=1e-12)
    assert found.daughter_density @ np.diff(found.edges) == pytest.approx(found.mean_fragments, rel=1e-12)
    assert found.moment(0) == pytest.approx(found.mean_fragments, rel=1e-12)
    assert found.moment(1) == pytest.approx(1, rel=1e-12)


def test_uniform_binary_breakage():
    """b(x) = 2: number uniform, mass linear, Σ x² → 2/3, a share 0.05 of the fragments erosive."""
    found = fragment_distribution(halves(20_000), bins=4)
    np.testing.assert_allclose(found.daughter_density, 2, rtol=0.05)
    np.testing.assert_allclose(found.mass, np.array([1, 3, 5, 7]) / 16, rtol=0.05)
    assert found.moment(2) == pytest.approx(2 / 3, rel=0.01)
    assert found.erosive_share() == pytest.approx(0.05, rel=0.05)


def test_intervals_cover_as_often_as_they_say():
    """Resampling 60 events 1000 times covers somewhat less than it says, as percentiles do."""
    covered = np.zeros((2, 4))
    for seed in range(150):
        found = fragment_distribution(halves(60, seed), bins=4, confidence=0.9, seed=seed)
        for kind, (bounds, true) in enumerate(
            ((found.number_interval, np.full(4, 0.25)), (found.mass_interval, np.array([1, 3, 5, 7]) / 16))
        ):
            covered[kind] += (bounds[:, 0] <= true) & (true <= bounds[:, 1])
    assert (covered / 150 > 0.8).all()
    assert covered.mean() / 150 == pytest.approx(0.9, abs=0.04)


def test_events_are_resampled_as_a_whole():
    """All events alike: whatever is drawn, the shares are the same."""
    found = fragment_distribution([[1, 9]] * 30, bins=2)
    np.testing.assert_allclose(found.number_interval, 0.5)
    np.testing.assert_allclose(found.mass_interval, [[0.1, 0.1], [0.9, 0.9]])


def test_same_seed_same_interval():
    events = halves(40)
    first, again, other = (fragment_distribution(events, seed=seed).number_interval for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_breakups_count_by_volume():
    """The same as the masses of the fragments themselves; a chain that holds under compression is left out."""
    breakups = list(splits(6))
    chain = straight_chain(2)
    response = rc.rigid_response(chain.spheres, rc.FreeDraining(), 1.0)
    flow = rc.uniaxial_extension(1.0)
    whole = rc.break_up(chain, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, 1.0), flow)
    assert not whole.splits
    found = fragment_distribution([whole, *breakups])
    volumes = [[np.sum(part.spheres.radii**3) for part in each.fragments] for each in breakups]
    expected = np.concatenate([np.array(each) / sum(each) for each in volumes])
    np.testing.assert_allclose(found.fractions, expected, rtol=1e-12)
    with pytest.raises(ValueError, match="breakups: expected at least one that splits, got none of 1"):
        fragment_distribution([whole])


def test_unequal_spheres():
    """A large and a small sphere: 8 to 1 by volume."""
    pair = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [0, 0, 3]], [2.0, 1.0]))
    response = rc.rigid_response(pair.spheres, rc.FreeDraining(), 1.0)
    breakup = rc.break_up(pair, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, 1.0), rc.uniaxial_extension(1.0))
    np.testing.assert_allclose(np.sort(fragment_distribution([breakup]).fractions), [1 / 9, 8 / 9])


def test_refused():
    with pytest.raises(ValueError, match="breakups: expected at least one that splits, got none of 0"):
        fragment_distribution([])
    with pytest.raises(ValueError, match=r"breakups\[1\]: expected the masses of two fragments or more, got 1"):
        fragment_distribution([[1, 2], [3]])
    with pytest.raises(ValueError, match=r"breakups\[0\]\[1\]: expected a positive number, got 0"):
        fragment_distribution([[1, 0]])
    with pytest.raises(ValueError, match="bins: expected an integer of at least 1, got 0"):
        fragment_distribution([[1, 2]], bins=0)
    for bins in ([0, 0.5], [0, 0.5, 0.5, 1], [0.1, 1], [1]):
        with pytest.raises(ValueError, match=r"bins: expected bounds that increase from 0 to 1, got \["):
            fragment_distribution([[1, 2]], bins=bins)
    with pytest.raises(ValueError, match="seed: expected an integer of at least 0, got -1"):
        fragment_distribution([[1, 2]], seed=-1)
    with pytest.raises(ValueError, match="fraction: expected a positive number, got 0"):
        fragment_distribution([[1, 2]]).erosive_share(0)
