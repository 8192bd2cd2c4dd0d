"""Breakup that goes on: the fragments are carried by the same flow, until all hold."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import refuse_without_strain
from rheoclast.breakup.crack import Rule, break_up, refuse_unknown_rule
from rheoclast.breakup.event import Breakup
from rheoclast.breakup.orientation import Orientation, flow_met, refuse_unknown_orientation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse, refuse_other_spheres, rigid_response
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import mean_coordination, radius_of_gyration, relative_shape_anisotropy
from rheoclast.progress import Progress


@dataclass(frozen=True, eq=False)
class Piece:
    """One aggregate of a cascade, before what happens to it.

    Attributes
    ----------
    parent
        Position in `Cascade.pieces` of what it came from; None for the aggregate at the beginning.
    generation
        Number of events before it.
    aggregate
        Spheres, where they were at the beginning, and contacts.
    spheres
        Indices (n,) of its spheres in the aggregate at the beginning.
    breakup
        What happens to it up to the rate of the flow; None for a single sphere.
    """

    parent: int | None
    generation: int
    aggregate: Aggregate
    spheres: IntArray
    breakup: Breakup | None

    @property
    def holds(self) -> bool:
        """Whether no contact of it fails at the rate of the flow."""
        return self.breakup is None or not self.breakup.failures


@dataclass(frozen=True, eq=False)
class Cascade:
    """What becomes of an aggregate in a flow of given rate. Made by `cascade`.

    Attributes
    ----------
    pieces
        All that ever was, parents before children; a piece that loses contacts without splitting has one child.
    flow
        The flow.
    """

    pieces: tuple[Piece, ...]
    flow: LinearFlow

    @property
    def remaining(self) -> tuple[Aggregate, ...]:
        """What holds in the end, the largest first."""
        held = (piece.aggregate for piece in self.pieces if piece.holds)
        return tuple(sorted(held, key=len, reverse=True))

    @property
    def sizes(self) -> IntArray:
        """Numbers of spheres of what holds in the end, the largest first."""
        return np.array([len(each) for each in self.remaining])

    def children(self, position: int) -> tuple[int, ...]:
        """Positions of the pieces that come from one."""
        return tuple(k for k, piece in enumerate(self.pieces) if piece.parent == position)

    def table(self) -> dict[str, FloatArray | IntArray]:
        """Columns with one row per piece: who came from whom, size and shape, and what happened.

        Rates are infinite for what holds; `parent` is −1 for the aggregate at the beginning.
        """
        rows = [_row(number, piece) for number, piece in enumerate(self.pieces)]
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _row(number: int, piece: Piece) -> dict[str, Any]:
    spheres, breakup = piece.aggregate.spheres, piece.breakup
    return {
        "piece": number,
        "parent": -1 if piece.parent is None else piece.parent,
        "generation": piece.generation,
        "spheres": len(spheres),
        "contacts": len(piece.aggregate.pairs),
        "radius_of_gyration_m": radius_of_gyration(spheres),
        "shape_anisotropy": relative_shape_anisotropy(spheres),
        "coordination": mean_coordination(piece.aggregate),
        "holds": int(piece.holds),
        "failures": len(breakup.failures) if breakup else 0,
        "initiation_rate_per_s": breakup.initiation_rate if breakup else np.inf,
        "breakup_rate_per_s": breakup.breakup_rate if breakup else np.inf,
    }


@_checks.instances
def cascade(
    aggregate: Aggregate,
    response: RigidResponse,
    bonds: Bonds,
    flow: LinearFlow,
    *,
    orientation: Orientation | Any = "given",
    rule: Rule = "weakest",
    criterion: Criterion = EVERY_LIMIT,
    progress: Progress | None = None,
) -> Cascade:
    """Breakup in a flow of given rate, and that of the fragments, until all hold.

    Each fragment has its own hydrodynamics, by the model of the response, and the bonds that are left to it.

    Parameters
    ----------
    aggregate, response, bonds
        As in `break_up`.
    flow
        At the rate that the aggregate meets; contacts that would fail at higher rates hold.
    orientation
        As in `flow_met`. "given", or a rotation: every fragment keeps the orientation that it had. "worst": every piece
        meets the flow in its worst orientation for tension, as if there were time to find it. "orbit": each turns
        freely, from the orientation of the beginning on, and meets the flow in the worst orientation along its orbit.
    rule, criterion
        As in `break_up`.
    progress
        Called as progress(step, fraction) with the share of spheres that are in pieces that hold.

    Raises
    ------
    ValueError, GeometryError, TypeError, ArithmeticError
        If the orientation is not known, or as `break_up`.
    """
    refuse_without_strain(flow)
    refuse_other_spheres(aggregate.spheres, response)
    refuse_unknown_orientation(orientation)
    refuse_unknown_rule(rule)
    pieces: list[Piece] = []
    waiting = deque([_Waiting(None, 0, aggregate, np.arange(len(aggregate)), bonds, response)])
    settled = 0
    while waiting:
        each = waiting.popleft()
        breakup = each.breakup(flow, orientation, rule, criterion)
        pieces.append(Piece(each.parent, each.generation, each.aggregate, each.spheres, breakup))
        if breakup is None or not breakup.failures:
            settled += len(each.aggregate)
        else:
            waiting.extend(each.fragments(breakup, len(pieces) - 1))
        if progress:
            progress("breaking", settled / len(aggregate))
    return Cascade(tuple(pieces), flow)


@dataclass(frozen=True, eq=False)
class _Waiting:
    """A piece to which nothing has happened yet, with the hydrodynamics of what it comes from."""

    parent: int | None
    generation: int
    aggregate: Aggregate
    spheres: IntArray
    bonds: Bonds
    before: RigidResponse

    @cached_property
    def response(self) -> RigidResponse:
        """The hydrodynamics of the piece by itself; that of before if it lost contacts only."""
        if len(self.aggregate) == len(self.before.spheres):
            return self.before
        return rigid_response(self.aggregate.spheres, self.before.model, self.before.viscosity)

    def breakup(
        self, flow: LinearFlow, orientation: Orientation | Any, rule: Rule, criterion: Criterion
    ) -> Breakup | None:
        """What happens to it up to the rate of the flow; nothing to a single sphere."""
        if len(self.aggregate) == 1:
            return None
        whole = (self.aggregate, self.response, self.bonds)
        met = flow_met(*whole, flow, orientation=orientation, criterion=criterion)
        return break_up(*whole, met, rule=rule, criterion=criterion, up_to=flow.rate)

    def fragments(self, breakup: Breakup, position: int) -> Iterator[_Waiting]:
        """Its parts, whose parent has a position among the pieces."""
        for fragment, spheres, contacts in zip(breakup.fragments, breakup.spheres, breakup.contacts, strict=True):
            bonds, inside = self.bonds.chosen(contacts), self.spheres[spheres]
            yield _Waiting(position, self.generation + 1, fragment, inside, bonds, self.response)
