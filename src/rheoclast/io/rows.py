"""Rows of words in a file, and which of them are the position and the size of a sphere."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.io.files import TextFile
from rheoclast.io.lengths import DIMENSIONLESS, METRES

Row = tuple[int, list[str]]
"""Line number and words."""

_UNIT = "|".join(re.escape(name) for name in METRES if name != DIMENSIONLESS)
_NAME = re.compile(
    rf"(x|y|z|r|radius|d|diameter) \s* (?: [(\[] \s* (.*?) \s* [)\]] | [_/\s] \s* ({_UNIT}) )?",
    re.IGNORECASE | re.VERBOSE,
)
_FULL_NAMES = {"r": "radius", "d": "diameter"}


@dataclass(frozen=True, eq=False)
class SphereRows:
    """Spheres as a file lists them.

    Attributes
    ----------
    centers
        (N, 3) in the file's unit of length.
    radii
        (N,) in the same unit, or None if the file has none.
    lines
        Line number of every sphere.
    units
        Units of length that the file states for its columns; usually none.
    """

    centers: FloatArray
    radii: FloatArray | None
    lines: Sequence[int]
    units: frozenset[str] = frozenset()


@dataclass(frozen=True)
class SphereColumns:
    """Which words of a row are what.

    Attributes
    ----------
    names
        What every column holds; their number is the number of words in a row.
    position
        Columns of x, y and z.
    size
        Column of the radius or the diameter, or None.
    radius_of_size
        Radius per value in that column: one half for a diameter.
    units
        Units of length stated in the names.
    """

    names: tuple[str, ...]
    position: tuple[int, int, int]
    size: int | None
    radius_of_size: float = 1.0
    units: frozenset[str] = frozenset()

    @classmethod
    def named(cls, names: Sequence[str]) -> SphereColumns | None:
        """Columns from their names, in any order, with or without units; None where x, y and z are not all there.

        Raises
        ------
        ValueError
            If two columns have the same meaning.
        """
        place: dict[str, int] = {}
        units = set()
        for index, name in enumerate(names):
            quantity, unit = quantity_of(name)
            if quantity in place:
                raise ValueError(f"two columns are the {quantity}: {names[place[quantity]]!r} and {name!r}; rename one")
            if quantity:
                place[quantity] = index
                units.add(unit)
        if not {"x", "y", "z"} <= place.keys():
            return None
        size = place.get("radius", place.get("diameter"))
        factor = 1.0 if "radius" in place else 0.5
        return cls(tuple(names), (place["x"], place["y"], place["z"]), size, factor, frozenset(units - {""}))


def quantity_of(name: str) -> tuple[str, str]:
    """What a column of this name holds (x, y, z, radius or diameter), and its unit; empty where there is none."""
    match = _NAME.fullmatch(name.strip().strip("\"'").strip())
    if match is None:
        return "", ""
    quantity = match[1].lower()
    unit = match[2] or match[3] or ""
    return _FULL_NAMES.get(quantity, quantity), unit if unit in METRES else ""


def sphere_rows(file: TextFile, rows: Sequence[Row], columns: SphereColumns) -> SphereRows:
    """The spheres in rows of words, every row complete and every number finite.

    Raises
    ------
    FileFormatError
        With the line number of the first row that is not.
    """
    wanted = [*columns.position, *([] if columns.size is None else [columns.size])]
    values = np.empty((len(rows), len(wanted)))
    for index, (line, words) in enumerate(rows):
        if len(words) != len(columns.names):
            raise _wrong_width(file, line, words, columns.names)
        values[index] = [file.number(words[k], line) for k in wanted]
    radii = None if columns.size is None else columns.radius_of_size * values[:, 3]
    return SphereRows(values[:, :3], radii, [line for line, _ in rows], columns.units)


def _wrong_width(file: TextFile, line: int, words: list[str], names: Sequence[str]) -> ValueError:
    shown = " ".join(names)
    cause = "is the file truncated here?" if len(words) < len(names) else "remove the surplus or name every column"
    return file.error(f"expected {len(names)} columns ({shown:.80}), got {len(words)}; {cause}", line)


def refuse_other_count(file: TextFile, stated: int, found: int, line: int) -> None:
    """Refuse a file whose rows are fewer or more than the count that it states itself in a given line."""
    if stated == found:
        return
    cause = "the file is truncated; write or copy it anew" if found < stated else "correct the count or the rows"
    raise file.error(f"expected {stated} spheres, as line {line} states, got {found} rows; {cause}")
