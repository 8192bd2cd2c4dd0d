"""Aggregates and tables to files, whole or not at all."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rheoclast.io import csv_table, lengths
from rheoclast.io.contents import Columns, Contents
from rheoclast.io.files import replacing
from rheoclast.io.formats import FORMATS, format_to_write
from rheoclast.particles.aggregate import Aggregate


def write(
    path: str | os.PathLike[str],
    aggregate: Aggregate,
    *,
    sphere_columns: Columns | None = None,
    contact_columns: Columns | None = None,
    unit: str | float = "m",
    format: str | None = None,
    overwrite: bool = False,
) -> None:
    """Write an aggregate, and values on its spheres and contacts, to a file.

    All formats but "vtp" can be read back; contacts are then found anew from the gaps.

    Parameters
    ----------
    path
        File to write; it appears complete or not at all.
    aggregate
        Spheres and contacts.
    sphere_columns
        Values (N,) or (N, 3) of the spheres by name, such as {"force_N": loads.force}; all formats but "lammps-data".
    contact_columns
        Values (C,) or (C, 3) of the contacts by name; format "vtp" only.
    unit
        Unit of length of the file, as in `read`. Values in columns are written as they are.
    format
        "text", "csv", "xyz", "lammps-dump", "lammps-data" or "vtp"; by default told from the suffix.
    overwrite
        Whether an existing file may be replaced.

    Raises
    ------
    FileExistsError
        If the file exists and may not be replaced.
    FileNotFoundError
        If its folder does not exist.
    ValueError
        If the format or the unit is not known, the format cannot hold the columns, or a column does not fit.
    """
    name, kind = format_to_write(path, format)
    _refuse_columns(name, {"sphere_columns": sphere_columns, "contact_columns": contact_columns})
    contents = Contents.of(aggregate, lengths.metres(unit), unit, sphere_columns, contact_columns)
    with replacing(path, overwrite) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        kind.write(stream, contents)


def write_table(path: str | os.PathLike[str], columns: Columns, *, overwrite: bool = False) -> None:
    """Write a table of comma-separated values, numbers with all their digits.

    Parameters
    ----------
    path
        File to write; it appears complete or not at all.
    columns
        Numbers or words (n,), or numbers (n, 3), by name; an array (n, 3) becomes name_x, name_y and name_z.
    overwrite
        Whether an existing file may be replaced.

    Raises
    ------
    FileExistsError
        If the file exists and may not be replaced.
    FileNotFoundError
        If its folder does not exist.
    ValueError
        If there are no columns, or their shapes do not fit together.
    """
    arrays = {name: _table_column(name, value) for name, value in columns.items()}
    if not arrays:
        raise ValueError("columns: expected at least one column, got none")
    first, length = next((name, len(values)) for name, values in arrays.items())
    for name, values in arrays.items():
        if len(values) != length:
            raise ValueError(f"columns[{name!r}]: expected {length} rows as in {first!r}, got {len(values)}")
    with replacing(path, overwrite) as temporary, temporary.open("w", encoding="utf-8", newline="\n") as stream:
        csv_table.write_columns(stream, arrays)


def _table_column(name: str, value: ArrayLike) -> NDArray[np.generic]:
    try:
        values = np.asarray(value)
    except ValueError:
        raise ValueError(f"columns[{name!r}]: expected one value or three per row, got {value!r:.60}") from None
    if values.ndim not in (1, 2) or (values.ndim == 2 and values.shape[1] != 3):
        raise ValueError(f"columns[{name!r}]: expected shape (n,) or (n, 3), got {values.shape}")
    if values.dtype.kind not in "biufU":
        raise ValueError(f"columns[{name!r}]: expected real numbers or words, got an array of {values.dtype}")
    return values


def _refuse_columns(name: str, given: dict[str, Columns | None]) -> None:
    """Refuse values that files of a format have no place for."""
    for argument, columns in given.items():
        if columns and argument not in FORMATS[name].columns:
            able = ", ".join(other for other, kind in FORMATS.items() if argument in kind.columns)
            raise ValueError(
                f"{argument}: files of format {name!r} have no place for {', '.join(map(repr, columns))}; "
                f"use a format that has ({able}), or write_table"
            )
