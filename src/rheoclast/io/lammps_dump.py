"""LAMMPS dump files in text form (`dump custom`, `dump atom`, LIGGGHTS); of several frames the last is read.

Read are the columns x y z, xu yu zu, or scaled xs ys zs (xsu ysu zsu) of an upright or tilted box, and radius or
diameter.
"""

from __future__ import annotations

import re
from typing import TextIO

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.io.contents import Contents, scalar_columns
from rheoclast.io.files import TextFile
from rheoclast.io.lammps import rows_below, sorted_by_id
from rheoclast.io.rows import SphereColumns, SphereRows, refuse_other_count, sphere_rows

_ITEM = re.compile("ITEM:")
_POSITIONS = (("x", "y", "z"), ("xu", "yu", "zu"), ("xs", "ys", "zs"), ("xsu", "ysu", "zsu"))


def read(file: TextFile) -> SphereRows:
    """Spheres of the last frame of a LAMMPS dump."""
    item = _items_of_last_frame(file)
    count_line = _line_of(file, item, "NUMBER OF ATOMS") + 1
    stated = file.lines[count_line - 1] if count_line <= len(file.lines) else ""
    count = file.whole_number(stated, count_line, "the number of atoms")
    line = _line_of(file, item, "ATOMS")
    names = file.lines[line - 1].split()[2:]
    rows = rows_below(file, line, _ITEM)
    refuse_other_count(file, count, len(rows), count_line)
    if not rows:
        raise file.error("expected at least one atom, got a frame of 0", count_line)
    position, columns = _columns(file, line, names)
    if "id" in names:
        rows = sorted_by_id(file, rows, names.index("id"))
    found = sphere_rows(file, rows, columns)
    if not position[0].startswith("xs"):
        return found
    origin, cell = _box(file, _line_of(file, item, "BOX BOUNDS"))
    return SphereRows(origin + found.centers @ cell, found.radii, found.lines)


def _items_of_last_frame(file: TextFile) -> dict[str, int]:
    """Line number of every `ITEM:` line of the last frame, by what follows it."""
    items: dict[str, int] = {}
    for line, text in enumerate(file.lines, 1):
        if text.startswith("ITEM:"):
            title = text.removeprefix("ITEM:").strip()
            if title.startswith("TIMESTEP"):
                items = {}
            items[title] = line
    return items


def _line_of(file: TextFile, items: dict[str, int], title: str) -> int:
    for found, line in items.items():
        if found.startswith(title):
            return line
    raise file.error(f"expected a line 'ITEM: {title} …' in the last frame, got none; the file is truncated or no dump")


def _columns(file: TextFile, line: int, names: list[str]) -> tuple[tuple[str, str, str], SphereColumns]:
    """The kind of position that the file has, and the columns of position and size."""
    position = next((kind for kind in _POSITIONS if set(kind) <= set(names)), None)
    if position is None:
        raise file.error(f"expected columns x y z (or xu yu zu, xs ys zs), got {' '.join(names)!r:.80}", line)
    size = next((name for name in ("radius", "diameter") if name in names), None)
    x, y, z = (names.index(name) for name in position)
    columns = SphereColumns(
        tuple(names), (x, y, z), None if size is None else names.index(size), 0.5 if size == "diameter" else 1.0
    )
    return position, columns


def _box(file: TextFile, line: int) -> tuple[FloatArray, FloatArray]:
    """Origin (3,) and edge vectors, rows of (3, 3), of the box, whose stated bounds enclose the tilted box.

    The relation of bounds and box is that of the LAMMPS manual, Howto_triclinic.
    """
    tilted = "xy xz yz" in file.lines[line - 1]
    rows = rows_below(file, line, _ITEM)
    width = 3 if tilted else 2
    if len(rows) != 3 or any(len(words) != width for _, words in rows):
        raise file.error(f"expected three lines of {width} box bounds for scaled positions, got others", line)
    bounds = np.array([[file.number(word, row) for word in words] for row, words in rows])
    xy, xz, yz = bounds[:, 2] if tilted else np.zeros(3)
    low, high = bounds[:, 0].copy(), bounds[:, 1].copy()
    low -= [min(0, xy, xz, xy + xz), min(0, yz), 0]
    high -= [max(0, xy, xz, xy + xz), max(0, yz), 0]
    lx, ly, lz = high - low
    return low, np.array([[lx, 0, 0], [xy, ly, 0], [xz, yz, lz]])


def write(stream: TextIO, contents: Contents) -> None:
    """Spheres as one frame of a LAMMPS dump, with radius and further columns."""
    extra = scalar_columns(contents.sphere_columns)
    stream.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(contents.radii)}\nITEM: BOX BOUNDS ff ff ff\n")
    stream.writelines(f"{low!r} {high!r}\n" for low, high in contents.box.T.tolist())
    stream.write(f"ITEM: ATOMS {' '.join(['id type x y z radius', *extra])}\n")
    table = np.column_stack([contents.centers, contents.radii, *extra.values()]).tolist()
    stream.writelines(f"{identity} 1 {' '.join(map(repr, row))}\n" for identity, row in enumerate(table, 1))
