"""The contact that fails first, and the strength of the flow at which it does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.breakup.ratio_response import RatioResponse
from rheoclast.flows import LinearFlow
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, refuse_without_strength
from rheoclast.mechanics.criteria.tension import Tension
from rheoclast.vectors import strain_components

UNTURNED = _checks.frozen(np.eye(3))


@dataclass(frozen=True, eq=False)
class Initiation:
    """The first failure in a flow whose rate is raised from zero.

    Attributes
    ----------
    contact
        Index of the contact, or None if no rate breaks any (every contact is compressed).
    criterion
        One of `Criterion.part_names`, that which is met; None with the contact.
    rate
        Rate of the flow at which it fails, 1/s, quoted as `LinearFlow.rate`; infinite if none fails.
    flow
        The flow in the orientation and at the rate of failure; as given if none fails.
    rotation
        (3, 3) by which the flow as given is turned in it.
    """

    contact: int | None
    criterion: str | None
    rate: float
    flow: LinearFlow
    rotation: FloatArray


@dataclass(frozen=True, eq=False)
class Initiations:
    """The first failure in each of n orientations of one flow. Made by `initiations`.

    Attributes
    ----------
    contact
        (n,) indices; −1 where no rate breaks any.
    criterion
        (n,) positions in `criteria` of the criterion that is met; −1 with the contact.
    rate
        (n,) rates of the flow at which it fails, 1/s, infinite where none does.
    margin
        (n,) by how much the load ratio of the next contact is smaller, as a share of the largest, at most 1.
    criteria
        Names of the criteria that `criterion` counts.
    """

    contact: IntArray
    criterion: IntArray
    rate: FloatArray
    margin: FloatArray
    criteria: tuple[str, ...]


@_checks.instances
def initiations(
    table: ContactResponse, bonds: Bonds, flow: LinearFlow, rotations: Any, *, criterion: Criterion = EVERY_LIMIT
) -> Initiations:
    """First failure in each of many orientations, all at once.

    Parameters
    ----------
    table
        Contact loads in every flow.
    bonds
        Strength of the contacts.
    flow
        Only its kind matters, and by which rate it is quoted.
    rotations
        By which the flow is turned, matrices (n, 3, 3) or a SciPy `Rotation` of n: for all orientations alike
        ``random_orientations(n, seed=1)``.
    criterion
        When a contact fails. By default each load has its own limit, and strengths that are infinite do not count.

    Raises
    ------
    ValueError
        If no contact has a strength for the criterion, the bonds have another number of contacts, or something is no
        rotation.
    TypeError
        If an argument is something else.
    """
    ratios = RatioResponse(table, bonds, criterion)
    turns = _checks.rotation_matrix("rotations", rotations, ("n", 3, 3))
    turned = turns @ flow.strain_rate @ np.swapaxes(turns, -1, -2)
    components = strain_components(turned)
    ratio, contact, part, next_ratio = ratios.largest_two(components)
    fails = ~ratios.is_rounding(ratio, contact, components)
    rate = np.divide(flow.rate, ratio, out=np.full(len(ratio), np.inf), where=fails)
    margin = np.divide(ratio - np.maximum(next_ratio, 0.0), ratio, out=np.zeros(len(ratio)), where=fails)
    contact, part = np.where(fails, contact, -1), np.where(fails, part, -1)
    contact, part, rate, margin = map(_checks.frozen, (contact, part, rate, margin))
    return Initiations(contact, part, rate, margin, ratios.criteria)


@_checks.instances
def initiation(
    table: ContactResponse, bonds: Bonds, flow: LinearFlow, *, criterion: Criterion = EVERY_LIMIT
) -> Initiation:
    """First failure in the given orientation.

    Parameters
    ----------
    table, bonds, flow, criterion
        As in `initiations`.

    Raises
    ------
    ValueError
        If no contact has a strength for the criterion, or the bonds have another number of contacts.
    TypeError
        If an argument is something else.
    """
    found = initiations(table, bonds, flow, UNTURNED[None], criterion=criterion)
    if found.contact[0] < 0:
        return Initiation(None, None, np.inf, flow, UNTURNED)
    critical = flow.scaled(float(found.rate[0]) / flow.rate)
    return Initiation(int(found.contact[0]), found.criteria[found.criterion[0]], critical.rate, critical, UNTURNED)


@_checks.instances
def worst_initiation(table: ContactResponse, bonds: Bonds, flow: LinearFlow) -> Initiation:
    """First failure in tension over all orientations of the aggregate in the flow, in closed form.

    Parameters
    ----------
    table, bonds, flow
        As in `initiations`; of the strengths only the tensile one counts.

    Raises
    ------
    ValueError
        If no contact has a tensile strength, or the bonds have another number of contacts.
    TypeError
        If an argument is something else.
    """
    refuse_without_strength(bonds, Tension())
    ratios = table.worst_tension(flow) / bonds.strength(len(table.normals))[:, 0]
    contact = int(ratios.argmax())
    if not ratios[contact] > 0:
        return Initiation(None, None, np.inf, flow, UNTURNED)
    rotation = _checks.frozen(table.worst_orientation(flow)[contact])
    critical = flow.rotated(rotation).scaled(1 / float(ratios[contact]))
    return Initiation(contact, Tension().name, critical.rate, critical, rotation)
