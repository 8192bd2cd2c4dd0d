"""What happened to one aggregate: the contacts that failed, in their order, and the fragments."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from rheoclast._checks import IntArray
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.spheres import Spheres

Outcome = Literal["whole", "bond", "crack"]
FEWEST_IN_ORDER = 3


@dataclass(frozen=True)
class Failure:
    """One contact that failed.

    Attributes
    ----------
    contact
        Its index in the aggregate.
    pair
        The spheres that it joined.
    rate
        Rate of the flow, 1/s, at which it fails as the load is then shared; it may be below that of failures before.
    reached
        Rate of the flow, 1/s, when it failed: the largest `rate` so far.
    criterion
        One of `Criterion.part_names`, that which was met.
    margin
        By how much the load ratio of the next contact is smaller, as a share of this one's; of the next that holds,
        where several fail at once.
    rivals
        Contacts that hold in this step but may have failed instead, as their load ratio is smaller by less than the
        expected error of the difference from the multipole order. None where the hydrodynamics has no lower order to
        compare with.
    radial_position
        Distance of the contact point from the centre of mass over the radius of gyration.
    depth
        Distance of the contact point below the convex hull of the aggregate, in mean radii.
    """

    contact: int
    pair: tuple[int, int]
    rate: float
    reached: float
    criterion: str
    margin: float
    rivals: tuple[int, ...] | None
    radial_position: float
    depth: float

    @property
    def overload(self) -> float:
        """Load over strength when it failed: 1 if the flow had to be raised for it, more in an avalanche."""
        return self.reached / self.rate


@dataclass(frozen=True, eq=False)
class Breakup:
    """How an aggregate breaks in a flow. Made by `break_up`.

    Attributes
    ----------
    aggregate
        What was there before.
    failures
        In their order.
    spheres
        Indices (n,) of each fragment's spheres in the aggregate, the largest fragment first; all of them if it does not
        split.
    released
        Contacts (R,) that did not fail, but no longer hold fragments together that can turn about them freely.
    """

    aggregate: Aggregate
    failures: tuple[Failure, ...]
    spheres: tuple[IntArray, ...]
    released: IntArray

    @cached_property
    def contacts(self) -> tuple[IntArray, ...]:
        """Indices of each fragment's contacts in the aggregate."""
        pairs = self.aggregate.pairs
        lost = np.zeros(len(pairs), bool)
        lost[[failure.contact for failure in self.failures]] = True
        fragment = self._fragment_of_spheres[pairs]
        inside = np.where(lost | (fragment[:, 0] != fragment[:, 1]), -1, fragment[:, 0])
        return tuple(np.flatnonzero(inside == k) for k in range(len(self.spheres)))

    @cached_property
    def fragments(self) -> tuple[Aggregate, ...]:
        """The parts after the last failure, the largest first; if it does not split, one with the contacts left."""
        return tuple(
            _fragment(self.aggregate, spheres, contacts)
            for spheres, contacts in zip(self.spheres, self.contacts, strict=True)
        )

    @property
    def splits(self) -> bool:
        """Whether it splits, at any rate or up to the largest allowed: not if all contacts left are compressed."""
        return len(self.spheres) > 1

    @property
    def outcome(self) -> Outcome:
        """Whether it stays "whole", is split by one "bond", or by a "crack" of several failures."""
        if not self.splits:
            return "whole"
        return "bond" if len(self.failures) == 1 else "crack"

    @property
    def is_single_bond(self) -> bool:
        """Whether one failure splits it."""
        return self.outcome == "bond"

    @property
    def initiation_rate(self) -> float:
        """Rate, 1/s, at which the first contact fails; infinite if none does, or none up to the largest allowed."""
        return self.failures[0].rate if self.failures else np.inf

    @property
    def breakup_rate(self) -> float:
        """Rate, 1/s, at which the aggregate splits: the largest of all failures; infinite if it does not."""
        return self.failures[-1].reached if self.splits else np.inf

    @cached_property
    def surface(self) -> tuple[Failure, ...]:
        """The failures between spheres of different fragments: the surface of the crack, in order."""
        fragment = self._fragment_of_spheres
        return tuple(failure for failure in self.failures if np.ptp(fragment[list(failure.pair)]))

    @property
    def inwardness(self) -> float:
        """Whether the crack ran from the outside in: rank correlation of order and depth, first half of its `surface`.

        Only the first half, because a crack that has reached the middle comes out on the other side. 1 if every failure
        is deeper than those before, −1 if it ran outwards, about 0 if it jumped; not a number for a surface of fewer
        than six failures, or where all are equally deep.
        """
        from scipy.stats import spearmanr

        half = self.surface[: len(self.surface) // 2]
        depth = np.round([failure.depth for failure in half], 9)
        if len(depth) < FEWEST_IN_ORDER or not np.ptp(depth):
            return np.nan
        return float(spearmanr(np.arange(len(depth)), depth).statistic)

    def near_ties(self, tolerance: float | None = None) -> tuple[int, ...]:
        """Positions in `failures` where another contact may as well have failed: the model does not tell the sequence.

        Parameters
        ----------
        tolerance
            Largest `Failure.margin` that counts as a tie. By default those with `Failure.rivals`, within the error bar
            of the hydrodynamics.

        Raises
        ------
        ValueError
            Without a tolerance, if the hydrodynamics has no error bar.
        """
        if tolerance is not None:
            return tuple(k for k, failure in enumerate(self.failures) if failure.margin < tolerance)
        if any(failure.rivals is None for failure in self.failures):
            raise ValueError(
                "tolerance: expected a number, as the hydrodynamics has no lower order to compare with, got none; "
                "give for instance 0.02, or use StokesianDynamics of order 2 or higher"
            )
        return tuple(k for k, failure in enumerate(self.failures) if failure.rivals)

    @cached_property
    def _fragment_of_spheres(self) -> IntArray:
        """Position (N,) of the fragment that each sphere belongs to."""
        fragment = np.empty(len(self.aggregate), np.intp)
        for k, members in enumerate(self.spheres):
            fragment[members] = k
        return fragment


def _fragment(aggregate: Aggregate, members: IntArray, contacts: IntArray) -> Aggregate:
    spheres = aggregate.spheres
    part = Spheres(spheres.centers[members], spheres.radii[members], spheres.overlap_tolerance)
    return Aggregate(part, np.searchsorted(members, aggregate.pairs[contacts]))
