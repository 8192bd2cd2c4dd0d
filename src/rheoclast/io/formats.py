"""The file formats, in one place: a new one is a module with `read` or `write`, and a line here."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePath
from typing import TextIO

from rheoclast.io import csv_table, lammps_data, lammps_dump, text, vtp, xyz
from rheoclast.io.contents import Contents
from rheoclast.io.files import TextFile
from rheoclast.io.rows import SphereColumns, SphereRows

Reader = Callable[[TextFile], SphereRows]
Writer = Callable[[TextIO, Contents], None]


@dataclass(frozen=True)
class FileFormat:
    """One format of geometry files.

    Attributes
    ----------
    read
        None where the format is only written.
    write
        Writes the contents to an open text file.
    suffixes
        Suffixes of files that are written in this format.
    certain_suffixes
        Those that settle the format of a file to be read; others leave it to the content.
    columns
        Which values a file of this format can hold beside the geometry.
    """

    read: Reader | None
    write: Writer
    suffixes: tuple[str, ...]
    certain_suffixes: tuple[str, ...] = ()
    columns: frozenset[str] = frozenset({"sphere_columns"})


FORMATS = {
    "text": FileFormat(text.read, text.write, (".txt", ".dat")),
    "csv": FileFormat(csv_table.read, csv_table.write, (".csv",), (".csv", ".tsv")),
    "xyz": FileFormat(xyz.read, xyz.write, (".xyz", ".extxyz"), (".xyz", ".extxyz")),
    "lammps-dump": FileFormat(lammps_dump.read, lammps_dump.write, (".dump", ".lammpstrj"), (".dump", ".lammpstrj")),
    "lammps-data": FileFormat(lammps_data.read, lammps_data.write, (".data", ".lmp"), columns=frozenset()),
    "vtp": FileFormat(None, vtp.write, (".vtp",), (".vtp",), frozenset({"sphere_columns", "contact_columns"})),
}


def reader_for(file: TextFile, name: str | None) -> Reader:
    """Reader of a format by its name, else by the suffix of the file, else by its content."""
    chosen = name or _by_suffix(file.path, reading=True) or by_content(file)
    reader = _named(chosen).read
    if reader is None:
        raise file.error(f"files of format {chosen!r} are written but not read; keep the spheres in a CSV file")
    return reader


def format_to_write(path: str | os.PathLike[str], name: str | None) -> tuple[str, FileFormat]:
    """Name and properties of the format to write, by its name, else by the suffix of the file."""
    chosen = name or _by_suffix(path, reading=False)
    if chosen is None:
        suffixes = ", ".join(suffix for each in FORMATS.values() for suffix in each.suffixes)
        raise ValueError(f"{path}: expected a suffix that tells the format ({suffixes}); add one or pass format=")
    return chosen, _named(chosen)


def _named(name: str) -> FileFormat:
    if name not in FORMATS:
        raise ValueError(f"format: expected one of {', '.join(FORMATS)}, got {name!r:.60}")
    return FORMATS[name]


def _by_suffix(path: str | os.PathLike[str], *, reading: bool) -> str | None:
    suffix = PurePath(path).suffix.lower()
    for name, each in FORMATS.items():
        if suffix in (each.certain_suffixes if reading else each.suffixes):
            return name
    return None


def by_content(file: TextFile) -> str:
    """Name of the format that the first lines of a file look like; plain text if like no other."""
    first = next(line for line in file.lines if line.strip())
    if first.startswith("ITEM:"):
        return "lammps-dump"
    if first.lstrip().startswith(("<?xml", "<VTKFile")):
        return "vtp"
    if re.fullmatch(r"\s*\d+\s*", first):
        return "xyz"
    if any(re.match(r"\s*\d+\s+atoms\b", line) for line in file.lines[:100]):
        return "lammps-data"
    return "csv" if _names_columns(file) else "text"


def _names_columns(file: TextFile) -> bool:
    """Whether the first line that is no comment has separated cells that name x, y and z."""
    line = next((line for line in file.lines if line.strip() and not line.lstrip().startswith("#")), "")
    cells = line.split(csv_table.separator(line))
    try:
        return SphereColumns.named(cells) is not None
    except ValueError:
        return True
