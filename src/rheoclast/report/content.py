"""What the scripts of the page draw: the aggregate, its loads, its crack and the rows of the tables, ready for JSON.

Lengths of the scene are in mean radii from the centre of mass, everything else in units of decimal prefix.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray
from rheoclast.particles.spheres import Spheres
from rheoclast.report.numbers import shortened
from rheoclast.report.result import Result, Table
from rheoclast.report.wording import PREFIXED
from rheoclast.view.colours import COMPRESSED, PULLED, UNLOADED
from rheoclast.view.fragments import COLOURS, REST
from rheoclast.view.projection import principal_axes, view_axes
from rheoclast.view.quantities import prefixed, symmetric_limit

PLACES = 4  # decimals of lengths in the scene
WHOLE = (
    *("contact", "i", "j", "failure", "fragment", "spheres", "contacts"),
    *("piece", "parent", "generation", "failures"),
)
LARGEST_OVERLAP = 2.0  # mean radii; what was accepted when the results were made is accepted again
Content = dict[str, Any]


@dataclass(frozen=True)
class Quantity:
    """A column as it is shown: its name in the files, a label, and which of the units it has, if any."""

    name: str
    label: str
    unit: str = ""
    signed: bool = False


LOADS = (
    Quantity("tension", "Tension", "force", signed=True),
    Quantity("shear", "Shear", "force"),
    Quantity("bending", "Bending", "moment"),
    Quantity("twisting", "Twisting", "moment", signed=True),
    Quantity("load_ratio", "Load / strength"),
    Quantity("worst_tension", "Worst tension", "force", signed=True),
    Quantity("worst_load_ratio", "Worst tension / strength", signed=True),
)
CONTACTS = (
    Quantity("contact", "Contact"),
    Quantity("i", "Sphere i"),
    Quantity("j", "Sphere j"),
    *LOADS,
    Quantity("radial_position", "Distance from centre / Rg"),
)
FAILURES = (
    Quantity("failure", "Failure"),
    Quantity("contact", "Contact"),
    Quantity("i", "Sphere i"),
    Quantity("j", "Sphere j"),
    Quantity("rate", "Fails at", "rate"),
    Quantity("reached", "Rate reached", "rate"),
    Quantity("criterion", "By"),
    Quantity("overload", "Overload"),
    Quantity("margin", "Margin to the next"),
    Quantity("radial_position", "Distance from centre / Rg"),
    Quantity("depth", "Depth / mean radius"),
)
FRAGMENTS = (
    Quantity("fragment", "Fragment"),
    Quantity("spheres", "Spheres"),
    Quantity("contacts", "Contacts"),
    Quantity("radius_of_gyration", "Radius of gyration", "length"),
    Quantity("shape_anisotropy", "Shape anisotropy"),
    Quantity("coordination", "Contacts per sphere"),
)
PIECES = (
    Quantity("piece", "Piece"),
    Quantity("parent", "Came from"),
    Quantity("generation", "Generation"),
    Quantity("spheres", "Spheres"),
    Quantity("contacts", "Contacts"),
    Quantity("radius_of_gyration", "Radius of gyration", "length"),
    Quantity("failures", "Failures"),
    Quantity("initiation_rate", "First fails at", "rate"),
    Quantity("breakup_rate", "Splits at", "rate"),
    Quantity("holds", "Holds"),
)


def content(result: Result) -> Content:
    """Everything that is drawn."""
    tables = {"contacts": _shown("Contacts", result.contacts, CONTACTS, result)}
    if result.failures:
        tables["failures"] = _shown("Failures", result.failures, FAILURES, result)
    if result.fragments:
        title = "Pieces that hold" if "cascade" in result.summary else "Fragments"
        tables["fragments"] = _shown(title, result.fragments, FRAGMENTS, result)
    if result.pieces:
        pieces = {**result.pieces, "holds": np.where(result.pieces["holds"] == 1, "yes", "no")}
        tables["pieces"] = _shown("All pieces of the cascade", pieces, PIECES, result)
        parents = tables["pieces"]["rows"]["parent"]
        tables["pieces"]["rows"]["parent"] = [None if parent < 0 else parent for parent in parents]
    return {
        "scene": _scene(result),
        "loads": [_load(result, load) for load in LOADS if load.name in result.contacts],
        "tables": tables,
        "colours": {"signed": [*COMPRESSED, UNLOADED, *PULLED], "unsigned": [UNLOADED, *PULLED]},
        "critical": _critical(result),
    }


def _scene(result: Result) -> Content:
    """Spheres, contact points, and the axes from which they are first seen, in mean radii."""
    spheres = Spheres(
        np.stack([result.spheres[axis] for axis in "xyz"], axis=1), result.spheres["radius"], LARGEST_OVERLAP
    )
    radius, center = spheres.mean_radius, spheres.center_of_mass
    points = np.stack([result.contacts[f"point_{axis}"] for axis in "xyz"], axis=1)
    rates, directions = principal_axes(result.flow.strain_rate)
    fragment = result.spheres.get("fragment")
    return {
        "centers": _places((spheres.centers - center) / radius),
        "radii": _places(spheres.radii / radius),
        "points": _places((points - center) / radius),
        "axes": np.round(view_axes(spheres), 6).ravel().tolist(),
        "fragment": None if fragment is None else (fragment - 1).astype(int).tolist(),
        "fragment_colours": [_hexadecimal(colour) for colour in [*COLOURS, REST]],
        "radius": radius,
        "length_unit": result.units["length"],
        "strain": {"rates": (rates / (np.abs(rates).max() or 1.0)).tolist(), "directions": directions.tolist()},
    }


def _places(lengths: FloatArray) -> list[float]:
    return np.round(lengths, PLACES).ravel().tolist()


def _hexadecimal(colour: FloatArray) -> str:
    return "#" + bytes(np.round(255 * colour).astype(int).tolist()).hex()


def _critical(result: Result) -> int | None:
    """The contact that fails first."""
    if result.is_breakup:
        return int(result.failures["contact"][0]) if result.failures else None
    return result.summary["given_orientation"]["contact"]


def _load(result: Result, load: Quantity) -> Content:
    """How a load colours the contacts: the end of its scale and the unit, as in the table of contacts."""
    divisor, unit = _scale(result, result.contacts, load)
    values = np.array(_numbers(result.contacts[load.name], divisor))
    signed = load.signed and bool((values < 0).any())
    return {
        "key": load.name,
        "label": load.label,
        "unit": unit,
        "divisor": divisor,
        "base": result.units[load.unit] if load.unit else "",
        "signed": signed,
        "limit": symmetric_limit(values),
    }


def _shown(title: str, table: Table, quantities: tuple[Quantity, ...], result: Result) -> Content:
    """A table of those columns that there are, and the expected errors of those that have them."""
    columns, rows = [], {}
    for quantity in quantities:
        if quantity.name not in table:
            continue
        divisor, unit = _scale(result, table, quantity)
        values = table[quantity.name]
        rows[quantity.name] = values.astype(int).tolist() if quantity.name in WHOLE else _numbers(values, divisor)
        error = f"{quantity.name}_error"
        if error in table:
            rows[error] = _numbers(table[error], divisor)
        columns.append(
            {
                "key": quantity.name,
                "label": quantity.label,
                "unit": unit,
                "error": error if error in table else None,
                "whole": quantity.name in WHOLE,
            }
        )
    return {"title": title, "columns": columns, "rows": rows}


def _scale(result: Result, table: Table, quantity: Quantity) -> tuple[float, str]:
    """Divisor and unit with a prefix that suits all values of a column."""
    unit = result.units[quantity.unit] if quantity.unit else ""
    if unit not in PREFIXED:
        return 1.0, unit
    largest = (
        float(np.abs(table[name]).max(initial=0.0))
        for name in (quantity.name, f"{quantity.name}_error")
        if name in table
    )
    return prefixed(next(filter(None, largest), 0.0), unit)


def _numbers(values: NDArray[Any], divisor: float) -> list[Any]:
    """Values as short as they are shown."""
    return values.tolist() if values.dtype.kind == "U" else shortened(values, divisor)
