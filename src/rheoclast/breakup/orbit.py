"""The contact that fails first as an aggregate turns in the flow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast.breakup.contact_response import ContactResponse, refuse_without_strain
from rheoclast.breakup.initiation import UNTURNED, Initiation
from rheoclast.breakup.load_history import load_history
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.hydrodynamics.trajectory import Trajectory, trajectory
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT
from rheoclast.vectors import strain_components

LONG = 200.0  # inverse magnitudes: a dozen turns of an open aggregate in shear


@dataclass(frozen=True, eq=False)
class OrbitInitiation(Initiation):
    """The first failure of an aggregate that turns freely, in a flow whose rate is raised slowly from zero.

    The orbit does not depend on the rate, which only sets how fast it is run through. `flow` is the flow in body axes
    at the moment of failure.

    Attributes
    ----------
    time
        When it fails, in s of the flow as given, at its own rate, from the start of the orbit.
    trajectory
        The orbit in that flow.
    """

    time: float
    trajectory: Trajectory


@_checks.instances
def orbit_initiation(
    response: RigidResponse,
    table: ContactResponse,
    bonds: Bonds,
    flow: LinearFlow,
    *,
    duration: float | None = None,
    start: Any = None,
    criterion: Criterion = EVERY_LIMIT,
) -> OrbitInitiation:
    """First failure along the aggregate's own rotation in a steady flow.

    Parameters
    ----------
    response, table
        Of the same aggregate: how it turns, and what its contacts then carry.
    bonds
        Strength of the contacts.
    flow
        In lab axes.
    duration
        Length of the orbit in s; by default 200 over the flow's magnitude, a dozen turns of an open aggregate in shear.
    start
        First orientation, a rotation from body to lab axes; by default the axes coincide.
    criterion
        When a contact fails.

    Raises
    ------
    ValueError
        If the flow has no strain, no contact has a strength, or as `trajectory`.
    TypeError
        If an argument is something else.
    """
    refuse_without_strain(flow)
    length = LONG / flow.magnitude if duration is None else duration
    orbit = trajectory(response, flow, duration=length, start=start)
    history = load_history(orbit, table, bonds, criterion=criterion)
    worst = history.maximum
    if history.loads.ratios.is_rounding(worst.ratio, worst.contact, strain_components(flow.strain_rate)):
        return OrbitInitiation(None, None, np.inf, flow, UNTURNED, 0.0, orbit)
    critical, rotation = orbit.flow(worst.time).scaled(1 / worst.ratio), _checks.frozen(orbit.rotation(worst.time).T)
    return OrbitInitiation(worst.contact, worst.criterion, critical.rate, critical, rotation, worst.time, orbit)
