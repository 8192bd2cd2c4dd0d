"""Result of a breakup: what follows from the failures and the fragments."""

from dataclasses import replace

import numpy as np
import pytest

import rheoclast as rc

CHAIN = rc.generation.straight_chain(5)  # contact k joins spheres k and k + 1


def failure(aggregate, contact, rate=1.0, reached=None, **others):
    given = {"criterion": "tension", "margin": 0.5, "rivals": (), "radial_position": 1.0, "depth": 1.0} | others
    pair = tuple(aggregate.pairs[contact].tolist())
    return rc.Failure(contact=contact, pair=pair, rate=rate, reached=rate if reached is None else reached, **given)


def event(aggregate, failures, spheres, released=()):
    return rc.Breakup(aggregate, tuple(failures), tuple(map(np.array, spheres)), np.array(released, dtype=np.intp))


def layers():
    """Two square layers of nine spheres, one above the other: the nine contacts between them, and the halves."""
    sites = np.indices((3, 3, 2)).reshape(3, -1).T
    aggregate = rc.Aggregate.touching(rc.Spheres(2.0 * sites, 1.0))
    above = sites[:, 2]
    return (
        aggregate,
        np.flatnonzero(np.ptp(above[aggregate.pairs], axis=1)),
        [np.flatnonzero(above == k) for k in (0, 1)],
    )


class TestWhole:
    def test_nothing_failed(self):
        whole = event(CHAIN, [], [range(5)])
        assert not whole.splits
        assert whole.outcome == "whole"
        assert not whole.is_single_bond
        assert whole.initiation_rate == whole.breakup_rate == np.inf
        assert whole.surface == ()
        assert np.isnan(whole.inwardness)
        assert whole.near_ties() == whole.near_ties(1.0) == ()
        np.testing.assert_array_equal(whole.contacts[0], np.arange(4))
        np.testing.assert_array_equal(whole.fragments[0].pairs, CHAIN.pairs)

    def test_failures_that_do_not_split_it(self):
        """The contacts that are left hold all spheres; it began to break, but nothing completes it."""
        ring = rc.generation.ring(5)
        whole = event(ring, [failure(ring, 3, 7.0)], [range(5)])
        assert whole.outcome == "whole"
        assert whole.initiation_rate == 7.0
        assert whole.breakup_rate == np.inf
        assert whole.surface == ()
        (left,) = whole.fragments
        assert len(left) == 5
        np.testing.assert_array_equal(left.pairs, np.delete(ring.pairs, 3, axis=0))
        np.testing.assert_array_equal(whole.contacts[0], [0, 1, 2, 4])


class TestSplit:
    def test_by_one_bond(self):
        split = event(CHAIN, [failure(CHAIN, 1, 3.0)], [[2, 3, 4], [0, 1]])
        assert split.splits
        assert split.outcome == "bond"
        assert split.is_single_bond
        assert split.initiation_rate == split.breakup_rate == 3.0
        assert [contacts.tolist() for contacts in split.contacts] == [[2, 3], [0]]
        assert [fragment.pairs.tolist() for fragment in split.fragments] == [[[0, 1], [1, 2]], [[0, 1]]]
        assert split.surface == split.failures

    def test_by_several(self):
        """The rate is the largest that was reached, not that of the last failure."""
        failures = [failure(CHAIN, 0, 3.0), failure(CHAIN, 3, 5.0), failure(CHAIN, 2, 4.0, reached=5.0)]
        split = event(CHAIN, failures, [[1, 2], [0], [3], [4]])
        assert split.outcome == "crack"
        assert not split.is_single_bond
        assert split.initiation_rate == 3.0
        assert split.breakup_rate == 5.0
        assert [contacts.tolist() for contacts in split.contacts] == [[1], [], [], []]
        assert [len(fragment) for fragment in split.fragments] == [2, 1, 1, 1]
        assert [fragment.pairs.shape for fragment in split.fragments] == [(1, 2), (0, 2), (0, 2), (0, 2)]

    def test_contacts_released_are_of_no_fragment(self):
        split = event(CHAIN, [failure(CHAIN, 0)], [[2, 3, 4], [0], [1]], released=[1])
        assert [contacts.tolist() for contacts in split.contacts] == [[2, 3], [], []]
        assert split.outcome == "bond"

    def test_fragments_are_spheres_of_the_aggregate(self):
        """With their radii, in its order and with what overlap it was allowed."""
        spheres = rc.Spheres([[0, 0, 0], [2.9, 0, 0], [5.9, 0, 0]], [1.0, 2.0, 1.0], 0.1)
        aggregate = rc.Aggregate(spheres, [[0, 1], [1, 2]])
        split = event(aggregate, [failure(aggregate, 1)], [[0, 1], [2]])
        np.testing.assert_array_equal(split.fragments[0].spheres.centers, spheres.centers[:2])
        np.testing.assert_array_equal(split.fragments[0].spheres.radii, [1, 2])
        assert split.fragments[0].spheres.overlap_tolerance == 0.1
        np.testing.assert_array_equal(split.fragments[1].spheres.centers, spheres.centers[2:])

    def test_surface_is_of_failures_between_fragments(self):
        """Those inside one, that it survives, are no part of it."""
        aggregate, between, halves = layers()
        inside = np.setdiff1d(np.arange(len(aggregate.pairs)), between)[:2]
        order = [*between[:4], inside[0], *between[4:8], inside[1], between[8]]
        split = event(aggregate, [failure(aggregate, contact) for contact in order], halves)
        assert [each.contact for each in split.surface] == between.tolist()
        assert len(split.failures) == 11
        kept = np.sort(np.concatenate(split.contacts))
        np.testing.assert_array_equal(kept, np.setdiff1d(np.arange(len(aggregate.pairs)), order))


def test_overload_is_the_rate_reached_over_the_rate():
    assert failure(CHAIN, 0, 4.0).overload == 1
    assert failure(CHAIN, 0, 4.0, reached=10.0).overload == 2.5


class TestNearTies:
    EVENT = event(
        CHAIN,
        [
            failure(CHAIN, 0, margin=0.02, rivals=()),
            failure(CHAIN, 1, margin=0.3, rivals=(0, 3)),
            failure(CHAIN, 2, margin=0.0, rivals=(3,)),
        ],
        [[0], [1], [2], [3, 4]],
    )

    def test_by_rivals(self):
        assert self.EVENT.near_ties() == (1, 2)

    @pytest.mark.parametrize(("tolerance", "positions"), [(0.0, ()), (0.01, (2,)), (0.1, (0, 2)), (1.0, (0, 1, 2))])
    def test_by_margin(self, tolerance, positions):
        assert self.EVENT.near_ties(tolerance) == positions

    def test_refused_without_error_bar(self):
        unknown = replace(self.EVENT, failures=(failure(CHAIN, 0, margin=0.0, rivals=None),))
        assert unknown.near_ties(0.02) == (0,)
        with pytest.raises(ValueError, match=r"^tolerance: expected a number, as the hydrodynamics has no lower order"):
            unknown.near_ties()


class TestInwardness:
    """Rank correlation of order and depth over the first half of the surface."""

    @staticmethod
    def crack(depths, elsewhere=()):
        """Failures of these depths between two layers; `elsewhere` has depths of failures inside one, at the start."""
        aggregate, between, halves = layers()
        inside = np.setdiff1d(np.arange(len(aggregate.pairs)), between)
        placed = [*zip(inside, elsewhere, strict=False), *zip(between, depths, strict=False)]
        return event(aggregate, [failure(aggregate, contact, depth=depth) for contact, depth in placed], halves)

    @pytest.mark.parametrize(
        ("depths", "expected"),
        [
            ([1, 2, 3, 4, 3, 2, 1, 1], 1),
            ([4, 3, 2, 1, 1, 1, 1, 1], -1),
            ([1, 3, 2, 4, 1, 1, 1, 1, 1], 0.8),  # 1 − 6 Σd² / n (n² − 1) with Σd² = 2, n = 4
            ([1, 2, 1, 5, 5, 5], 0),  # ranks 1.5, 3, 1.5
            ([1, 2, 10, 0, 0, 0, 0], 1),
        ],
    )
    def test_by_hand(self, depths, expected):
        assert self.crack(depths).inwardness == pytest.approx(expected, abs=1e-12)

    def test_only_the_first_half_of_the_surface_counts(self):
        one, other = (self.crack([1, 2, 3, 4, *rest]) for rest in ([9, 8, 7, 6], [0.1, 5, 0.1, 5]))
        assert one.inwardness == other.inwardness == pytest.approx(1)

    def test_failures_inside_a_fragment_do_not_count(self):
        assert self.crack([3, 2, 1, 1, 1, 1], elsewhere=[0.1, 0.2, 0.3, 0.4]).inwardness == pytest.approx(-1)

    def test_differences_by_rounding_are_none(self):
        depths = np.array([1, 1, 2, 2, 1, 1, 1, 1]) + 1e-13 * np.array([1, 0, 1, 0, 0, 0, 0, 0])
        exact = self.crack(np.round(depths, 6)).inwardness
        assert self.crack(depths).inwardness == pytest.approx(exact, abs=1e-12)

    @pytest.mark.parametrize("depths", [[1, 2, 3, 4, 5], [1] * 9, 1 + 1e-13 * np.arange(9)])
    def test_not_a_number_for_few_failures_or_equal_depth(self, depths):
        assert np.isnan(self.crack(depths).inwardness)
