"""The contact that fails first, and the strength of the flow at which it does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.flows import LinearFlow
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, load_ratios, refuse_without_strength
from rheoclast.mechanics.criteria.tension import Tension


@dataclass(frozen=True, eq=False)
class Initiation:
    """The first failure in a flow whose rate is raised from zero.

    Attributes
    ----------
    contact
        Index of the contact, or None if no rate breaks any (every contact is compressed).
    criterion
        `Criterion.name` of the criterion that is met; None with the contact.
    rate
        Rate of the flow at which it fails, 1/s, quoted as `LinearFlow.rate`; infinite if none fails.
    flow
        The flow in the orientation and at the rate of failure; as given if none fails.
    """

    contact: int | None
    criterion: str | None
    rate: float
    flow: LinearFlow


def initiation(
    table: ContactResponse, bonds: Bonds, flow: LinearFlow, criterion: Criterion = EVERY_LIMIT
) -> Initiation:
    """First failure in the given orientation.

    Raises
    ------
    ValueError
        If no contact has a strength for the criterion, or the bonds have another number of contacts.
    """
    refuse_without_strength(bonds, criterion)
    ratios = load_ratios(table.loads(flow), bonds, criterion)
    contact, part = np.unravel_index(int(ratios.argmax()), ratios.shape)
    return _first(int(contact), criterion.parts[part].name, float(ratios.max()), flow)


def worst_initiation(table: ContactResponse, bonds: Bonds, flow: LinearFlow) -> Initiation:
    """First failure in tension over all orientations of the aggregate in the flow, in closed form.

    Raises
    ------
    ValueError
        If no contact has a tensile strength, or the bonds have another number of contacts.
    """
    refuse_without_strength(bonds, Tension())
    ratios = table.worst_tension(flow) / bonds.strength(len(table.normals))[:, 0]
    contact = int(ratios.argmax())
    turned = flow.rotated(table.worst_orientation(flow)[contact]) if ratios[contact] > 0 else flow
    return _first(contact, "tension", float(ratios[contact]), turned)


def _first(contact: int, criterion: str, ratio: float, flow: LinearFlow) -> Initiation:
    if not ratio > 0:
        return Initiation(None, None, np.inf, flow)
    critical = flow.scaled(1 / ratio)
    return Initiation(contact, criterion, critical.rate, critical)
