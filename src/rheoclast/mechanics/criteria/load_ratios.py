"""How near contacts are to failure, by each of the criteria that count."""

from __future__ import annotations

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.criterion import AnyOf, Criterion
from rheoclast.mechanics.criteria.rolling import Rolling
from rheoclast.mechanics.criteria.sliding import Sliding
from rheoclast.mechanics.criteria.tension import Tension
from rheoclast.mechanics.criteria.twisting import Twisting

EVERY_LIMIT: Criterion = AnyOf(Tension(), Sliding(), Rolling(), Twisting())
"""Each load against its own strength, for the strengths that are finite: with JKR contacts tension alone."""


@_checks.instances
def load_ratios(loads: ContactLoads, bonds: Bonds, *, criterion: Criterion = EVERY_LIMIT) -> FloatArray:
    """Load over strength (..., C, K) of C contacts by the K `Criterion.parts`. A contact fails where it reaches one.

    Compression does not fail a contact: its ratio in tension is negative. Where a strength is infinite the ratio is
    zero, so a criterion without a limit is off.

    Parameters
    ----------
    loads
        Of the contacts, (..., C).
    bonds
        Strength of the contacts.
    criterion
        When a contact fails.

    Raises
    ------
    ValueError
        If the bonds have another number of contacts.
    TypeError
        If an argument is something else.
    """
    bonds.refuse_other_count(len(loads.normals))
    return np.stack([part.load_ratio(loads, bonds) for part in criterion.parts], axis=-1)


def largest_ratios(
    force: FloatArray, moment: FloatArray, bonds: Bonds, criterion: Criterion, contacts: int
) -> FloatArray:
    """Load ratios (C,) to which the largest of forces in N and moments in N m could bring each of `contacts`."""
    sizes = dict.fromkeys(("tensile_strength", "shear_strength"), np.abs(force).max(initial=0.0))
    sizes |= dict.fromkeys(("bending_strength", "twisting_strength"), np.abs(moment).max(initial=0.0))
    ratios = [np.broadcast_to(sizes[name] / getattr(bonds, name), contacts) for name in criterion.strengths]
    return np.max(ratios, axis=0)


def limited_parts(bonds: Bonds, criterion: Criterion) -> IntArray:
    """Positions among `Criterion.parts` of those that use a strength that is finite for some contact."""
    finite = {name for name in criterion.strengths if np.isfinite(getattr(bonds, name)).any()}
    return np.flatnonzero([not finite.isdisjoint(part.strengths) for part in criterion.parts])


def refuse_without_strength(bonds: Bonds, criterion: Criterion) -> None:
    """Refuse bonds that no load can break by a criterion."""
    if not len(limited_parts(bonds, criterion)):
        raise ValueError(
            f"bonds: expected a strength of some contact for failure by {criterion.name}, got none; "
            f"give for instance {criterion.strengths[0]}"
        )
