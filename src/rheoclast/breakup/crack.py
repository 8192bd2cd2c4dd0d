"""Breakup of an aggregate in a flow whose rate is raised from zero, contact by contact, until it splits.

Loads are proportional to the rate, so that failures are events: the contact with the largest load over strength, r at
unit rate, fails at the rate 1/r; the others share the load anew, and so on. The first of these rates begins the breakup
and the largest of them up to the split completes it (M. Vanni, Comput. Phys. Commun. 192 (2015) 70). The fluid's
loads stay as they are: breaking a contact moves no sphere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.flows import LinearFlow
from rheoclast.frames.removal import CollapseError
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria import CRITERIA, load_ratios
from rheoclast.mechanics.loosened import LoosenedAggregate, loosened
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import depth
from rheoclast.particles.spheres import Spheres

Rule = Literal["weakest", "overloaded"]
ROUNDING = 1e-12


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
    criterion
        "tension", "shear", "bending" or "twisting".
    margin
        By how much the load ratio of the next contact is smaller, as a share of this one's. Where it is below the error
        of the loads, the order of failures is not determined.
    depth
        Distance of the contact point from the centre of mass over the radius of gyration.
    """

    contact: int
    pair: tuple[int, int]
    rate: float
    criterion: str
    margin: float
    depth: float


@dataclass(frozen=True, eq=False)
class Breakup:
    """How an aggregate breaks in a flow. Made by `break_up`.

    Attributes
    ----------
    failures
        In their order.
    fragments
        The parts after the last failure, the largest first; the whole aggregate if it does not split.
    spheres
        Indices (n,) of each fragment's spheres in the aggregate.
    """

    failures: tuple[Failure, ...]
    fragments: tuple[Aggregate, ...]
    spheres: tuple[IntArray, ...]

    @property
    def splits(self) -> bool:
        """Whether it breaks at any rate: not if all contacts that are left are compressed."""
        return len(self.fragments) > 1

    @property
    def initiation_rate(self) -> float:
        """Rate, 1/s, at which the first contact fails; infinite if none does."""
        return self.failures[0].rate if self.failures else np.inf

    @property
    def breakup_rate(self) -> float:
        """Rate, 1/s, at which the aggregate splits: the largest of all failures; infinite if it does not."""
        return max(failure.rate for failure in self.failures) if self.splits else np.inf

    @property
    def is_single_bond(self) -> bool:
        """Whether one failure splits it."""
        return self.splits and len(self.failures) == 1

    def near_ties(self, tolerance: float) -> tuple[int, ...]:
        """Positions of failures whose margin is below a tolerance, such as the relative error of the loads."""
        return tuple(k for k, failure in enumerate(self.failures) if failure.margin < tolerance)


def break_up(
    aggregate: Aggregate, response: RigidResponse, bonds: Bonds, flow: LinearFlow, rule: Rule = "weakest"
) -> Breakup:
    """Failures in a flow of given kind and orientation as its rate is raised from zero, up to the split.

    Parameters
    ----------
    aggregate
        Spheres and contacts.
    response
        Hydrodynamic response of the same spheres.
    bonds
        Stiffness and strength of the contacts.
    flow
        Only its kind and orientation matter. For the worst orientation pass `worst_initiation(...).flow`.
    rule
        "weakest": contacts fail one at a time, the most overloaded first. "overloaded": all whose load reaches their
        strength at the rate that is reached fail at once.

    Raises
    ------
    ValueError
        If the flow has no strain, no contact has a strength, the rule is not known, or as `contact_loads`.
    """
    if rule not in ("weakest", "overloaded"):
        raise ValueError(f"rule: expected 'weakest' or 'overloaded', got {rule!r}")
    if not np.linalg.norm(flow.strain_rate) > 0:
        raise ValueError("flow: expected a strain rate that is not zero, got none; a rotation loads no contact")
    if not np.isfinite(bonds.strength(len(aggregate.pairs))).any():
        raise ValueError("bonds: expected a strength of some contact, got none; give for instance tensile_strength")
    state = loosened(aggregate, response.loads(flow), bonds)
    depths = depth(aggregate, aggregate.contact_points)
    failures: list[Failure] = []
    reached = 0.0
    while True:
        ratios = _ratios(state, bonds)
        largest = ratios.max(axis=1)
        if not largest.max(initial=0.0) > 0:
            return _result(aggregate, failures, np.zeros(len(aggregate), np.intp))
        reached = max(reached, 1 / largest.max())
        failing = _failing(largest, reached, rule)
        failures += [_failure(aggregate, contact, ratios, flow.rate, depths) for contact in failing.tolist()]
        try:
            state = state.without(failing)
        except CollapseError as collapse:
            return _result(aggregate, failures, collapse.parts)


def _ratios(state: LoosenedAggregate, bonds: Bonds) -> FloatArray:
    """Load over strength (C, 4), minus infinity where the contact is lost."""
    ratios = load_ratios(state.loads, bonds)
    ratios[state.lost] = -np.inf
    return ratios


def _failing(largest: FloatArray, reached: float, rule: Rule) -> IntArray:
    """Contacts that fail now, the most overloaded first."""
    order = np.argsort(-largest, kind="stable")
    if rule == "weakest":
        return order[:1]
    return order[: int(np.count_nonzero(largest * reached >= 1 - ROUNDING))]


def _failure(aggregate: Aggregate, contact: int, ratios: FloatArray, rate: float, depths: FloatArray) -> Failure:
    own = float(ratios[contact].max())
    others = np.delete(ratios, contact, axis=0).max(initial=0.0)
    first, second = aggregate.pairs[contact].tolist()
    criterion = CRITERIA[int(ratios[contact].argmax())]
    return Failure(contact, (first, second), rate / own, criterion, max(0.0, 1 - others / own), float(depths[contact]))


def _result(aggregate: Aggregate, failures: list[Failure], parts: IntArray) -> Breakup:
    kept = np.delete(aggregate.pairs, [failure.contact for failure in failures], axis=0)
    members = sorted((np.flatnonzero(parts == part) for part in range(parts.max() + 1)), key=lambda part: -len(part))
    return Breakup(tuple(failures), tuple(_fragment(aggregate.spheres, kept, each) for each in members), tuple(members))


def _fragment(spheres: Spheres, pairs: IntArray, members: IntArray) -> Aggregate:
    """The aggregate of some spheres and the contacts among them."""
    number = np.full(len(spheres), -1)
    number[members] = np.arange(len(members))
    inside = pairs[(number[pairs] >= 0).all(axis=1)]
    part = Spheres(spheres.centers[members], spheres.radii[members], spheres.overlap_tolerance)
    return Aggregate(part, number[inside])
