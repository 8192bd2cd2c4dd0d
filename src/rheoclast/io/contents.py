"""What is written to a file of spheres, checked before the file is opened."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast.io.rows import quantity_of
from rheoclast.particles.aggregate import Aggregate

Columns = Mapping[str, ArrayLike]
"""Values of every sphere or contact by name: (n,) or (n, 3) each."""

_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_TAKEN = {"id", "type", "species", "pos", *(f"{axis}{kind}" for axis in "xyz" for kind in ("u", "s", "su"))}


@dataclass(frozen=True, eq=False)
class Contents:
    """An aggregate and values on it, lengths in the unit of the file.

    Attributes
    ----------
    centers, radii
        (N, 3) and (N,).
    pairs
        (C, 2) spheres in contact.
    unit
        Name of the unit of length, or its value in metres.
    sphere_columns, contact_columns
        Values (N,) or (N, 3), and (C,) or (C, 3), by name; they may be infinite or not a number.
    """

    centers: FloatArray
    radii: FloatArray
    pairs: IntArray
    unit: str | float = "m"
    sphere_columns: dict[str, FloatArray] = field(default_factory=dict)
    contact_columns: dict[str, FloatArray] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        aggregate: Aggregate,
        metres: float,
        unit: str | float,
        sphere_columns: Columns | None,
        contact_columns: Columns | None,
    ) -> Contents:
        """An aggregate (in m) and values on it, in units of length of so many metres."""
        return cls(
            aggregate.spheres.centers / metres,
            aggregate.spheres.radii / metres,
            aggregate.pairs,
            unit,
            _checked("sphere_columns", sphere_columns or {}, len(aggregate)),
            _checked("contact_columns", contact_columns or {}, len(aggregate.pairs)),
        )

    @property
    def box(self) -> FloatArray:
        """Lowest and highest corner (2, 3) of the smallest upright box around the spheres."""
        reach = self.radii[:, None]
        return np.array([(self.centers - reach).min(axis=0), (self.centers + reach).max(axis=0)])


def _checked(argument: str, columns: Columns, count: int) -> dict[str, FloatArray]:
    """Values as float arrays, under names that stay one word in every format and do not hide the geometry."""
    checked = {}
    for name, value in columns.items():
        if not isinstance(name, str) or not _NAME.fullmatch(name):
            raise ValueError(f"{argument}: expected names of letters, digits and _ such as 'force_N', got {name!r:.60}")
        if quantity_of(name)[0] or name.lower() in _TAKEN:
            raise ValueError(f"{argument}: {name!r} is a column of the geometry itself; choose another name")
        checked[name] = _numbers(f"{argument}[{name!r}]", value)
        if checked[name].shape not in ((count,), (count, 3)):
            raise ValueError(
                f"{argument}[{name!r}]: expected shape ({count},) or ({count}, 3), got {checked[name].shape}"
            )
    scalar_columns(checked)
    return checked


def _numbers(name: str, value: ArrayLike) -> FloatArray:
    try:
        return np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected numbers, got {value!r:.60}") from None


def scalar_columns(columns: Mapping[str, NDArray[np.generic]]) -> dict[str, NDArray[np.generic]]:
    """One column (n,) per component: an array (n, 3) becomes name_x, name_y and name_z.

    Raises
    ------
    ValueError
        If two columns come to have the same name.
    """
    scalars: dict[str, NDArray[np.generic]] = {}
    for name, values in columns.items():
        parts = {name: values} if values.ndim == 1 else {f"{name}_{axis}": values[:, k] for k, axis in enumerate("xyz")}
        twice = parts.keys() & scalars.keys()
        if twice:
            raise ValueError(f"columns: {min(twice)!r} would be there twice; rename {name!r}")
        scalars |= parts
    return scalars
