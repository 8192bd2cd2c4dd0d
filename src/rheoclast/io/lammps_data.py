"""LAMMPS data files (`write_data`, `read_data`): the section Atoms, whose style a comment names (`Atoms # sphere`).

The styles sphere and bpm/sphere have a diameter; the others need a radius from the caller.
"""

from __future__ import annotations

import re
from typing import TextIO

import numpy as np

from rheoclast.io.contents import Contents
from rheoclast.io.files import TextFile
from rheoclast.io.lammps import rows_below, sorted_by_id
from rheoclast.io.lengths import ascii_name
from rheoclast.io.rows import Row, SphereColumns, SphereRows, refuse_other_count, sphere_rows

STYLES = {
    "sphere": "id type diameter density x y z",
    "bpm/sphere": "id molecule type diameter density x y z",
    "atomic": "id type x y z",
    "charge": "id type charge x y z",
    "bond": "id molecule type x y z",
    "angle": "id molecule type x y z",
    "molecular": "id molecule type x y z",
    "full": "id molecule type charge x y z",
}
_COUNT = re.compile(r"\s*(\d+)\s+atoms\b", re.ASCII)
_ANY_SECTION = re.compile(r"\s*[A-Z][A-Za-z]+(\s|$)")
_SECTION = re.compile(r"\s*Atoms\s*(?:#\s*(\S+).*)?")


def read(file: TextFile) -> SphereRows:
    """Spheres of a LAMMPS data file."""
    count_line, count = _stated_count(file)
    line, names = _atoms_section(file)
    rows = rows_below(file, line, _ANY_SECTION)
    refuse_other_count(file, count, len(rows), count_line)
    if not rows:
        raise file.error("expected at least one atom, got 0", count_line)
    columns = SphereColumns.named(names)
    assert columns is not None, "every style has x, y and z"
    return sphere_rows(file, sorted_by_id(file, _without_images(rows, len(names)), 0), columns)


def _stated_count(file: TextFile) -> tuple[int, int]:
    """Line that states the number of atoms, and the number; the first line of a data file is always a comment."""
    for line, text in enumerate(file.lines[1:], 2):
        if match := _COUNT.match(text):
            return line, int(match[1])
    raise file.error("expected a line such as '300 atoms' in the header, got none; is this a LAMMPS data file?")


def _atoms_section(file: TextFile) -> tuple[int, list[str]]:
    """Line of the title of the section Atoms, and the names of its columns."""
    for line, text in enumerate(file.lines, 1):
        if match := _SECTION.fullmatch(text):
            if match[1] not in STYLES:
                got = "no style" if match[1] is None else repr(match[1])
                raise file.error(
                    f"expected an atom style ({', '.join(STYLES)}) behind 'Atoms #', got {got}; "
                    "write for example 'Atoms # sphere'",
                    line,
                )
            return line, STYLES[match[1]].split()
    raise file.error("expected a section 'Atoms # sphere', got none; the file is truncated or no LAMMPS data file")


def _without_images(rows: list[Row], width: int) -> list[Row]:
    """Rows without the three counts of box crossings that may follow."""
    return [(line, words[:width] if len(words) == width + 3 else words) for line, words in rows]


def write(stream: TextIO, contents: Contents) -> None:
    """Spheres of atom style sphere, type 1 and density 1."""
    count = len(contents.radii)
    stream.write(f"Rheoclast aggregate, lengths in {ascii_name(contents.unit)}\n\n{count} atoms\n1 atom types\n\n")
    for axis, (low, high) in zip("xyz", contents.box.T.tolist(), strict=True):
        stream.write(f"{low!r} {high!r} {axis}lo {axis}hi\n")
    stream.write("\nAtoms # sphere\n\n")
    table = np.column_stack([2 * contents.radii, np.ones(count), contents.centers]).tolist()
    stream.writelines(f"{identity} 1 {' '.join(map(repr, row))}\n" for identity, row in enumerate(table, 1))
