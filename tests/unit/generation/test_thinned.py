"""Thinned aggregates: as many contacts as asked for, connected, every spanning tree equally likely."""

from collections import Counter

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation.lattices import lattice_ball, lattice_block
from rheoclast.generation.thinned import thinned, thinned_fcc_ball
from rheoclast.graphs import connected_parts
from rheoclast.particles.morphology import mean_coordination


@pytest.mark.parametrize("coordination", [2 - 2 / 300, 2.5, 4.0, 7.3])
def test_coordination_is_met_to_one_contact(assert_exactly_touching, coordination):
    """And the contacts are some of those of the whole, in their order; the spheres are the same."""
    whole = lattice_ball("fcc", 300, 2e-7)
    part = thinned(whole, coordination, seed=3)
    assert_exactly_touching(part, 300, 2e-7)
    assert abs(mean_coordination(part) - coordination) <= 1 / 300 + 1e-12
    assert {tuple(p) for p in part.pairs.tolist()} <= {tuple(p) for p in whole.pairs.tolist()}
    assert part.pairs.tolist() == sorted(part.pairs.tolist())
    assert part.spheres is whole.spheres
    same = thinned_fcc_ball(300, coordination, 2e-7, seed=3)
    np.testing.assert_array_equal(same.pairs, part.pairs)


def test_limits_are_a_tree_and_the_whole():
    """At 2 − 2/N no loop is left; at the given coordination no contact is lost."""
    whole = lattice_ball("fcc", 100)
    assert thinned(whole, 2 - 2 / 100).is_tree
    np.testing.assert_array_equal(thinned(whole, mean_coordination(whole)).pairs, whole.pairs)
    lone = lattice_ball("fcc", 1)
    assert len(thinned(lone, 0).pairs) == 0


def test_seeds():
    """Equal seeds give equal contacts, others not."""
    whole = lattice_ball("hcp", 80)
    first, again, other = (thinned(whole, 3, seed=s) for s in (5, 5, 6))
    np.testing.assert_array_equal(first.pairs, again.pairs)
    assert first.pairs.tolist() != other.pairs.tolist()


def test_every_spanning_tree_is_equally_likely():
    """Chi-squared over the 15 spanning trees of a ladder of six spheres, 3000 draws: 14 ± 5.3, below 29.1 at 1 %."""
    ladder = lattice_block("sc", (3, 2, 1))
    draws = Counter(tuple(map(tuple, thinned(ladder, 10 / 6, seed=s).pairs.tolist())) for s in range(3000))
    assert len(draws) == 15
    expected = 3000 / 15
    assert sum((n - expected) ** 2 / expected for n in draws.values()) < 29.1


def test_other_contacts_are_equally_likely():
    """Opposite ribs of a hexagon with its centre are alike: each of the 12 is kept as often as its symmetric mates."""
    angle = np.pi / 3 * np.arange(6)
    rim = 2 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    wheel = rc.Aggregate.touching(rc.Spheres(np.vstack([np.zeros(3), rim]), 1.0))
    kept = Counter(tuple(p) for s in range(1500) for p in thinned(wheel, 18 / 7, seed=s).pairs.tolist())
    assert sum(kept.values()) == 9 * 1500
    spokes = np.array([kept[0, k] for k in range(1, 7)]) / 1500
    rims = np.array([n for pair, n in kept.items() if 0 not in pair]) / 1500
    np.testing.assert_allclose(spokes, spokes.mean(), atol=5 * np.sqrt(0.25 / 1500))
    np.testing.assert_allclose(rims, rims.mean(), atol=5 * np.sqrt(0.25 / 1500))


def test_a_bridge_is_never_lost():
    """Two tetrahedra joined by one contact stay joined."""
    tetrahedron = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(2)
    mirrored = -tetrahedron + 2 * tetrahedron[0] + 2 * np.ones(3) / np.sqrt(3)
    pair = rc.Aggregate.touching(rc.Spheres(np.vstack([tetrahedron, mirrored]), 1.0))
    assert len(pair.pairs) == 13
    for seed in range(40):
        part = thinned(pair, 2.0, seed=seed)
        assert len(part.pairs) == 8
        assert [0, 4] in part.pairs.tolist()
        assert connected_parts(8, part.pairs).max() == 0


def test_bad_requests_are_refused():
    """With the range that is possible."""
    whole = lattice_ball("fcc", 13)
    with pytest.raises(ValueError, match=r"expected from 1\.846 \(a tree\) to 5\.538 .*36 contacts.*, got 1\.5"):
        thinned(whole, 1.5)
    with pytest.raises(ValueError, match=r"coordination: expected from .*, got 6"):
        thinned(whole, 6)
    with pytest.raises(ValueError, match="seed: expected an integer"):
        thinned(whole, 3, seed=-1)
    with pytest.raises(TypeError, match="aggregate: expected Aggregate, got Spheres"):
        thinned(whole.spheres, 3)
