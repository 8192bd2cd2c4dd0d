"""Breakup of an aggregate in a flow whose rate is raised from zero, contact by contact, until it splits.

Loads are proportional to the rate, so that failures are events: the contact with the largest load over strength, r at
unit rate, fails at the rate 1/r; the others share the load anew, and so on. The first of these rates begins the breakup
and the largest of them up to the split completes it (M. Vanni, Comput. Phys. Commun. 192 (2015) 70). The fluid's
loads stay as they are: breaking a contact moves no sphere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import refuse_without_strain
from rheoclast.breakup.event import Breakup, Failure
from rheoclast.flows import LinearFlow
from rheoclast.frames.removal import CollapseError
from rheoclast.hydrodynamics.response import RigidResponse, refuse_other_spheres
from rheoclast.hydrodynamics.truncation import LOWEST_ORDER, expected_error
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import (
    EVERY_LIMIT,
    largest_ratios,
    load_ratios,
    refuse_without_strength,
)
from rheoclast.mechanics.loosened import LoosenableAggregate, LoosenedAggregate, loosenable
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import depth, radial_position

Rule = Literal["weakest", "overloaded"]
ROUNDING = 1e-9  # of load ratios: what balance is held to
NEGLIGIBLE = 1e-8  # of the largest load of any contact in any flow as strong
ORDERS_COMPARED = 3


@_checks.instances
def break_up(
    aggregate: Aggregate,
    response: RigidResponse,
    bonds: Bonds,
    flow: LinearFlow,
    *,
    rule: Rule = "weakest",
    criterion: Criterion = EVERY_LIMIT,
    up_to: float = np.inf,
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
        Only its kind and orientation matter. For the worst orientation, and the worst along the aggregate's own
        rotation, see `flow_met`.
    rule
        "weakest": contacts fail one at a time, the most overloaded first. "overloaded": all whose load reaches their
        strength at the rate that is reached fail at once.
    criterion
        When a contact fails. By default each load has its own limit, and strengths that are infinite do not count: with
        JKR contacts, tension against pull-off.
    up_to
        Rate of the flow, 1/s, above which it is not raised. If it does not split below, the aggregate stays whole
        with the contacts that are left.

    Raises
    ------
    ValueError
        If the flow has no strain, no contact has a strength, the rule is not known, the contacts do not hold the
        aggregate because the stiffnesses differ by too many decades, or as `contact_loads`.
    GeometryError
        If the response belongs to other spheres.
    TypeError
        If an argument is something else.
    ArithmeticError
        If the aggregate becomes so slender (thousands of spheres in line) that balance is not reached.
    """
    return next(break_up_each(aggregate, response, bonds, [flow], rule=rule, criterion=criterion, up_to=up_to))


@_checks.instances
def break_up_each(
    aggregate: Aggregate,
    response: RigidResponse,
    bonds: Bonds,
    flows: Iterable[LinearFlow],
    *,
    rule: Rule = "weakest",
    criterion: Criterion = EVERY_LIMIT,
    up_to: float = np.inf,
) -> Iterator[Breakup]:
    """`break_up` in every one of several flows or orientations, one after the other; the contacts are assembled once.

    Parameters
    ----------
    aggregate, response, bonds, rule, criterion, up_to
        As in `break_up`.
    flows
        Taken one by one, each when its event is asked for. For all orientations alike pass
        ``flow.rotated(each) for each in random_orientations(100, seed=1)``.

    Raises
    ------
    ValueError, GeometryError, TypeError, ArithmeticError
        As `break_up`; what does not depend on the flow is refused at once.
    """
    refuse_unknown_rule(rule)
    refuse_other_spheres(aggregate.spheres, response)
    refuse_without_strength(bonds, criterion)
    bonds.refuse_other_count(len(aggregate.pairs))
    limit = up_to if up_to == np.inf else _checks.positive("up_to", up_to)
    intact = loosenable(aggregate, bonds)
    places = np.stack([place(aggregate, aggregate.contact_points) for place in (radial_position, depth)], axis=1)
    unit = intact.loaded(response.strain_loads).loads
    negligible = NEGLIGIBLE * largest_ratios(unit.force, unit.moment, bonds, criterion, len(aggregate.pairs))
    setting = _Setting(aggregate, bonds, criterion, rule, limit, response.order, intact, negligible, places)
    return (_event(setting, response, flow) for flow in flows)


def refuse_unknown_rule(rule: str) -> None:
    """Refuse a rule that is none."""
    if rule not in get_args(Rule):
        raise ValueError(f"rule: expected {' or '.join(map(repr, get_args(Rule)))}, got {rule!r}")


@dataclass(frozen=True, eq=False)
class _Setting:
    """What all events of an aggregate have in common."""

    aggregate: Aggregate
    bonds: Bonds
    criterion: Criterion
    rule: Rule
    up_to: float
    order: int | None
    intact: LoosenableAggregate
    negligible: FloatArray
    places: FloatArray

    def ratios(self, state: LoosenedAggregate, strain_rate: float) -> FloatArray:
        """Load over strength (orders, C, criteria), zero where the contact is lost or its load is rounding."""
        ratios = load_ratios(state.loads, self.bonds, criterion=self.criterion)
        return np.where(ratios > strain_rate * self.negligible[:, None], ratios, np.minimum(ratios, 0.0))


def _event(setting: _Setting, response: RigidResponse, flow: LinearFlow) -> Breakup:
    _checks.instance("flow", flow, LinearFlow)
    refuse_without_strain(flow)
    orders = [order.loads(flow) for order in response.by_order[-ORDERS_COMPARED:]]
    state = setting.intact.loaded(SphereLoads.stacked(orders))
    failures: list[Failure] = []
    strain_rate, reached = float(np.linalg.norm(flow.strain_rate)), 0.0
    ratios = setting.ratios(state, strain_rate)
    while True:
        largest = ratios[-1].max(axis=1)
        if largest.max() <= 0 or flow.rate / largest.max() > setting.up_to:
            return _breakup(setting.aggregate, failures, np.zeros(len(setting.aggregate), np.intp))
        reached = max(reached, flow.rate / float(largest.max()))
        failing = _failing(largest, reached / flow.rate, setting.rule)
        failures += [_failure(setting, contact, failing, ratios, flow.rate, reached) for contact in failing]
        try:
            state = state.without(failing)
        except CollapseError as collapse:
            return _breakup(setting.aggregate, failures, collapse.parts)
        ratios = setting.ratios(state, strain_rate)


def _failing(largest: FloatArray, reached: float, rule: Rule) -> IntArray:
    """Contacts that fail now, the most overloaded first."""
    if rule == "weakest":
        return np.array([largest.argmax()])
    order = np.argsort(-largest, kind="stable")
    return order[: int(np.count_nonzero(largest * reached >= 1 - ROUNDING))]


def _failure(
    setting: _Setting, contact: int, failing: IntArray, ratios: FloatArray, rate: float, reached: float
) -> Failure:
    """The failure of a contact, one of those that fail at once, at load ratios (orders, C, criteria)."""
    own = float(ratios[-1, contact].max())
    others = np.setdiff1d(np.flatnonzero(ratios[-1].max(axis=1) > 0), failing)
    lead = ratios[:, contact].max(axis=1)[:, None] - ratios[:, others].max(axis=2)
    first, second = setting.aggregate.pairs[contact].tolist()
    radial, below = setting.places[contact].tolist()
    return Failure(
        contact=int(contact),
        pair=(first, second),
        rate=rate / own,
        reached=reached,
        criterion=setting.criterion.part_names[int(ratios[-1, contact].argmax())],
        margin=float(lead[-1].min(initial=own)) / own,
        rivals=_rivals(others, lead / own, setting.order),
        radial_position=radial,
        depth=below,
    )


def _rivals(others: IntArray, lead: FloatArray, order: int | None) -> tuple[int, ...] | None:
    """Contacts whose load ratio is smaller by a lead (orders, contacts), relative, within its expected error."""
    if order is None or len(lead) < max(min(order, ORDERS_COMPARED), LOWEST_ORDER):
        return None
    return tuple(others[lead[-1] <= expected_error(list(lead), order, axis=()) + ROUNDING].tolist())


def _breakup(aggregate: Aggregate, failures: list[Failure], parts: IntArray) -> Breakup:
    members = sorted((np.flatnonzero(parts == part) for part in range(parts.max() + 1)), key=lambda part: -len(part))
    between = np.flatnonzero(np.ptp(parts[aggregate.pairs], axis=1))
    released = np.setdiff1d(between, [failure.contact for failure in failures])
    return Breakup(aggregate, tuple(failures), tuple(members), released)
