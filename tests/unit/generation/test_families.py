"""The registry: nothing that grows an aggregate is missing from it, and all of it keeps the common promises."""

import inspect

import numpy as np
import pytest

import rheoclast as rc
from rheoclast import generation
from rheoclast.particles.contacts import surface_gaps

REQUESTS = {
    "bent-chain": {"count": 12, "bend": 0.3},
    "cross": {"arm": 3},
    "lattice-block": {"lattice": "fcc", "counts": (2, 3, 2)},
    "lattice-ball": {"lattice": "hcp", "count": 13},
    "thinned-fcc-ball": {"count": 20, "coordination": 3.0},
    "compacted-cluster": {"count": 20, "amount": 0.5},
}


def grown(name, **more):
    return generation.FAMILIES[name](**REQUESTS.get(name, {"count": 12}), **more)


def test_all_that_grow_from_nothing_are_registered():
    """What takes an aggregate, as `thinned` and `compacted` do, is no family by itself."""
    growing = {
        name
        for name in generation.__all__
        if inspect.isfunction(function := getattr(generation, name))
        and "aggregate" not in inspect.signature(function).parameters
    }
    assert {family.__name__ for family in generation.FAMILIES.values()} == growing


@pytest.mark.parametrize("name", generation.FAMILIES)
class TestEveryFamily:
    def test_spheres_touch_exactly_and_do_not_overlap(self, name):
        aggregate = grown(name, radius=2e-7)
        assert isinstance(aggregate, rc.Aggregate)
        spheres = aggregate.spheres
        everyone = np.array(np.triu_indices(len(aggregate), 1)).T
        assert np.abs(surface_gaps(spheres.centers, spheres.radii, aggregate.pairs)).max() < 1e-9
        assert surface_gaps(spheres.centers, spheres.radii, everyone).min() > -1e-9

    def test_centre_of_mass_is_the_origin(self, name):
        aggregate = grown(name, radius=2e-7)
        assert np.abs(aggregate.spheres.center_of_mass).max() < 1e-12 * 2e-7 * len(aggregate)

    def test_radius_is_the_unit(self, name):
        small, unit = grown(name, radius=2e-7), grown(name)
        np.testing.assert_allclose(small.spheres.centers, 2e-7 * unit.spheres.centers, rtol=0, atol=1e-18)
        np.testing.assert_array_equal(small.pairs, unit.pairs)

    def test_seed_decides(self, name):
        if "seed" not in inspect.signature(generation.FAMILIES[name]).parameters:
            return
        once, again, other = (grown(name, seed=seed) for seed in (3, 3, 4))
        np.testing.assert_array_equal(once.spheres.centers, again.spheres.centers)
        np.testing.assert_array_equal(once.pairs, again.pairs)
        assert once.pairs.shape != other.pairs.shape or (
            np.abs(once.spheres.centers - other.spheres.centers).max() > 1e-6 or (once.pairs != other.pairs).any()
        )

    def test_bad_radius_is_refused(self, name):
        with pytest.raises(ValueError, match=r"radius: expected a positive number, got -1"):
            grown(name, radius=-1.0)
