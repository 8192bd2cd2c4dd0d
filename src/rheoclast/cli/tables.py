"""The summary and the tables of an analysis, in the units of the report."""

from __future__ import annotations

from typing import Any

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.initiation import Initiation
from rheoclast.breakup.truncation import rate_error
from rheoclast.cli.analysis import Analysis
from rheoclast.cli.units import Units
from rheoclast.mechanics.criteria.load_ratios import load_ratios
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.fractal import pair_correlation_dimension
from rheoclast.particles.morphology import (
    coordination_numbers,
    enclosing_radius,
    porosity,
    radial_position,
    radius_of_gyration,
    relative_shape_anisotropy,
)

Columns = dict[str, FloatArray | IntArray]


def contact_columns(analysis: Analysis, units: Units) -> Columns:
    """One row per contact: what is loaded, how, and how near to its strength."""
    loads, aggregate = analysis.contact_loads, analysis.aggregate
    worst = analysis.table.worst_tension(analysis.flow)
    strength = analysis.bonds.strength(len(aggregate.pairs))[:, 0]
    force, moment = units.tags.force, units.tags.moment
    return {
        f"tension{force}": loads.tension / units.force,
        f"shear{force}": loads.shear / units.force,
        f"bending{moment}": loads.bending / units.moment,
        f"twisting{moment}": loads.twisting / units.moment,
        "load_ratio": load_ratios(loads, analysis.bonds).max(axis=-1),
        f"worst_tension{force}": worst / units.force,
        "worst_load_ratio": worst / strength,
        f"force{force}": loads.force / units.force,
        f"moment{moment}": loads.moment / units.moment,
        "radial_position": radial_position(aggregate, aggregate.contact_points),
        **_error_columns(analysis, units),
    }


def _error_columns(analysis: Analysis, units: Units) -> Columns:
    """Expected truncation errors; no columns where they are not known."""
    error = analysis.truncation
    if error is None:
        return {}
    return {
        f"tension_error{units.tags.force}": error.tension / units.force,
        f"shear_error{units.tags.force}": error.shear / units.force,
        f"bending_error{units.tags.moment}": error.bending / units.moment,
        f"twisting_error{units.tags.moment}": error.twisting / units.moment,
    }


def contact_table(analysis: Analysis, units: Units) -> Columns:
    """`contact_columns` with the pair and the place in front, as written to a file."""
    aggregate = analysis.aggregate
    return {
        "contact": np.arange(len(aggregate.pairs)),
        "i": aggregate.pairs[:, 0],
        "j": aggregate.pairs[:, 1],
        f"point{units.tags.length}": aggregate.contact_points / units.length,
        "normal": aggregate.normals,
        **contact_columns(analysis, units),
    }


def sphere_columns(analysis: Analysis, units: Units) -> Columns:
    """One row per sphere: the loads of the fluid."""
    return {
        f"force{units.tags.force}": analysis.sphere_loads.force / units.force,
        f"torque{units.tags.moment}": analysis.sphere_loads.torque / units.moment,
        "coordination": coordination_numbers(analysis.aggregate),
    }


def sphere_table(analysis: Analysis, units: Units) -> Columns:
    """`sphere_columns` with the place in front, as written to a file."""
    spheres = analysis.aggregate.spheres
    x, y, z = spheres.centers.T / units.length
    tag = units.tags.length
    place = {f"x{tag}": x, f"y{tag}": y, f"z{tag}": z, f"radius{tag}": spheres.radii / units.length}
    return {**place, **sphere_columns(analysis, units)}


def shape_summary(aggregate: Aggregate, length: float = 1.0) -> dict[str, Any]:
    """What the spheres and contacts alone tell, lengths in the unit `length`."""
    coordination = coordination_numbers(aggregate)
    radii = aggregate.spheres.radii
    return {
        "spheres": len(aggregate),
        "contacts": len(aggregate.pairs),
        "hyperstaticity": aggregate.hyperstaticity,
        "structure": "isostatic (tree)" if aggregate.is_tree else "hyperstatic",
        "mean_radius": float(radii.mean()) / length,
        "smallest_radius": float(radii.min()) / length,
        "largest_radius": float(radii.max()) / length,
        "radius_of_gyration": radius_of_gyration(aggregate.spheres) / length,
        "enclosing_radius": enclosing_radius(aggregate.spheres) / length,
        "relative_shape_anisotropy": relative_shape_anisotropy(aggregate.spheres),
        "porosity": porosity(aggregate.spheres),
        "fractal_dimension": _fractal_dimension(aggregate),
        "mean_coordination": float(coordination.mean()),
        "coordination_counts": {str(k): int(n) for k, n in enumerate(np.bincount(coordination)) if n},
    }


def _fractal_dimension(aggregate: Aggregate) -> dict[str, Any] | None:
    """From the pair correlation, with its interval; none for an aggregate too small to have one."""
    try:
        found = pair_correlation_dimension(aggregate)
    except ValueError:
        return None
    return {"value": found.dimension, "interval": list(found.interval)}


def stress_summary(analysis: Analysis, units: Units, flow: str) -> dict[str, Any]:
    """What the command reports of a flow known by a name, ready for JSON."""
    loads = analysis.contact_loads
    most = int(loads.tension.argmax())
    model = analysis.response.model
    return {
        "aggregate": {
            **shape_summary(analysis.aggregate, units.length),
            "hydrodynamic_radius": analysis.response.hydrodynamic_radius / units.length,
        },
        "model": {
            "name": type(model).__name__,
            "order": analysis.response.order,
            "viscosity_Pa_s": analysis.response.viscosity,
        },
        "flow": {"name": flow, "gradient_per_s": analysis.flow.gradient.tolist(), "rate_per_s": analysis.flow.rate},
        "most_tensioned": {
            "contact": most,
            "pair": analysis.aggregate.pairs[most].tolist(),
            "tension": float(loads.tension[most]) / units.force,
        },
        "largest": {
            "tension": float(loads.tension.max()) / units.force,
            "compression": max(0.0, float(-loads.tension.min())) / units.force,
            "shear": float(loads.shear.max()) / units.force,
            "bending": float(loads.bending.max()) / units.moment,
            "twisting": float(np.abs(loads.twisting).max()) / units.moment,
        },
        "given_orientation": _failure(analysis, analysis.given, units),
        "worst_orientation": _failure(analysis, analysis.worst, units),
        "units": units.names._asdict(),
        "scales": units.sizes(analysis.flow.rate),
    }


def _failure(analysis: Analysis, first: Initiation, units: Units) -> dict[str, Any]:
    if first.contact is None:
        return {"contact": None, "initiation_rate": None}
    aggregate = analysis.aggregate
    strength = analysis.bonds.strength(len(aggregate.pairs))[first.contact, 0]
    return {
        "contact": first.contact,
        "pair": aggregate.pairs[first.contact].tolist(),
        "criterion": first.criterion,
        "initiation_rate": first.rate / units.rate,
        "initiation_rate_error": rate_error(analysis.table, analysis.bonds, first),
        "pull_off_force": float(strength) / units.force,
        "radial_position": float(radial_position(aggregate, aggregate.contact_points[first.contact])),
        "flow_gradient_per_s": first.flow.gradient.tolist(),
    }
