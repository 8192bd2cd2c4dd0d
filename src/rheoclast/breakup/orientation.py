"""The flow in the orientation in which an aggregate meets it."""

from __future__ import annotations

from typing import Any, Literal, get_args

from rheoclast import _checks
from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.initiation import worst_initiation
from rheoclast.breakup.orbit import orbit_initiation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT
from rheoclast.particles.aggregate import Aggregate

Orientation = Literal["given", "worst", "orbit"]


@_checks.instances
def flow_met(
    aggregate: Aggregate,
    response: RigidResponse,
    bonds: Bonds,
    flow: LinearFlow,
    *,
    orientation: Orientation | Any = "given",
    criterion: Criterion = EVERY_LIMIT,
    table: ContactResponse | None = None,
) -> LinearFlow:
    """The flow as an aggregate meets it: turned into the axes of the aggregate, at its own rate.

    Parameters
    ----------
    aggregate, response, bonds
        As in `break_up`.
    flow
        In lab axes.
    orientation
        "given": the axes of the aggregate are those of the lab. "worst": the worst orientation for tension, as by
        `worst_initiation`. "orbit": the worst along its own rotation, as by `orbit_initiation`. Or a rotation of the
        flow, a (3, 3) matrix or a SciPy `Rotation`, for instance one of `random_orientations`.
    criterion
        When a contact fails, for "orbit".
    table
        The contact response, if it is there; otherwise it is computed where it is needed.

    Raises
    ------
    ValueError
        If the orientation is not known or no rotation, or as `contact_response`, `worst_initiation` or
        `orbit_initiation`.
    TypeError
        If an argument is something else.
    """
    refuse_unknown_orientation(orientation)
    if not isinstance(orientation, str):
        return flow.rotated(orientation)
    if orientation == "given":
        return flow
    carried = contact_response(aggregate, response, bonds) if table is None else table
    if orientation == "worst":
        return flow.rotated(worst_initiation(carried, bonds, flow).rotation)
    return flow.rotated(orbit_initiation(response, carried, bonds, flow, criterion=criterion).rotation)


def refuse_unknown_orientation(orientation: Orientation | Any) -> None:
    """Refuse what is neither the name of an orientation nor a rotation."""
    if not isinstance(orientation, str):
        _checks.rotation_matrix("orientation", orientation)
    elif orientation not in get_args(Orientation):
        known = ", ".join(map(repr, get_args(Orientation)))
        raise ValueError(f"orientation: expected one of {known} or a rotation, got {orientation!r}")
