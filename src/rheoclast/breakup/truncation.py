"""Error bars of contact loads: what the truncation of the multipoles leaves out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.breakup.initiation import Initiation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.truncation import FORCE, LOWEST_ORDER, ErrorRule, expected_error
from rheoclast.mechanics.bonds import Bonds

RULES = {
    "tension": FORCE,
    "shear": ErrorRule(share=0.3, weight=1 / 4),
    "bending": ErrorRule(share=0.35, weight=2 / 3),
    "twisting": ErrorRule(share=0.35, weight=2 / 3),
}
"""How changes between orders tell of the error of each load; calibrated in `validation/truncation_error`."""

BREAKING_LOADS = {"tension": "tension", "rolling": "bending", "twisting": "twisting"}
"""The load that breaks a contact, by the name of the criterion."""


@dataclass(frozen=True, eq=False)
class LoadErrors:
    """Expected errors of the loads in every contact, each (C,) and positive.

    Attributes
    ----------
    tension, shear
        In N.
    bending, twisting
        In N m.
    """

    tension: FloatArray
    shear: FloatArray
    bending: FloatArray
    twisting: FloatArray


@_checks.instances
def truncation_error(table: ContactResponse, flow: LinearFlow) -> LoadErrors:
    """Expected error of every contact load in a flow, from comparing multipole orders that are already solved.

    It is a root mean square over all orientations of a flow of this strength, so that it does not vanish where two
    orders happen to agree in one orientation. In the calibration (trees, chains, compact and polydisperse clusters of 2
    to 32 spheres, orders 2 to 5) the true error is below twice the estimate for 97 % of contacts or more. It tells of
    truncation only, not of errors in the model.

    Parameters
    ----------
    table
        From `contact_response`, with hydrodynamics of order 2 or higher.
    flow
        Only the magnitude of its strain rate matters.

    Raises
    ------
    ValueError
        If the hydrodynamics has no order, or order 1, below which there is nothing to compare with.
    TypeError
        If an argument is something else.
    """
    if table.order is None or table.order < LOWEST_ORDER or table.coarser is None:
        found = "a model without multipole order" if table.order is None else f"order {table.order}"
        raise ValueError(f"table: expected hydrodynamics of order 2 or higher to compare orders, got {found}")
    # The mean square of A : E over all rotations is |A|² |E|² / 5.
    strength = float(np.linalg.norm(flow.strain_rate)) / np.sqrt(5)
    errors = {
        load: strength * expected_error([_part(load, each) for each in table.by_order[-3:]], table.order, (1, 2), rule)
        for load, rule in RULES.items()
    }
    return LoadErrors(**errors)


@_checks.instances
def rate_error(table: ContactResponse, bonds: Bonds, first: Initiation) -> float | None:
    """Expected relative error of the rate of a first failure, from comparing multipole orders: 0.03 is 3 %.

    It is the `truncation_error` of the load that breaks the contact, in the flow of failure, over its strength. None
    where it is not known: if nothing fails, the hydrodynamics has no lower order to compare with, or several loads may
    act together, as they do in all criteria but tension, rolling and twisting.

    Parameters
    ----------
    table
        From `contact_response`.
    bonds
        Strength of the contacts.
    first
        From `initiation`, `worst_initiation` or `orbit_initiation` with the same table and bonds.

    Raises
    ------
    ValueError
        If the bonds have another number of contacts.
    TypeError
        If an argument is something else.
    """
    if first.contact is None or first.criterion not in BREAKING_LOADS or table.coarser is None:
        return None
    load = BREAKING_LOADS[first.criterion]
    strength = bonds.strength(len(table.normals))[first.contact, list(RULES).index(load)]
    return float(getattr(truncation_error(table, first.flow), load)[first.contact] / strength)


def _part(load: str, table: ContactResponse) -> FloatArray:
    """The part of force or moment (C, 3, 5) along the normal or across it."""
    whole = table.force if load in ("tension", "shear") else table.moment
    along = table.normals[:, :, None] * np.einsum("ci,cik->ck", table.normals, whole)[:, None]
    return along if load in ("tension", "twisting") else whole - along
