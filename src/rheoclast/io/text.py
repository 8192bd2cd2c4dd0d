"""Plain text: rows x y z [r], parted by blanks, tabs, commas or semicolons; `#` begins a comment.

This is what aggregate generators write. A comment line that names as many columns as the rows have, x, y and z among
them, says which is which (`# x y z r`, `# id x y z d`); without one the columns are x y z or x y z r. A count of
spheres stated in a comment (`# spheres: 300`; `N_particles_actual: 300` of PyFracVAL) must agree with the rows.
"""

from __future__ import annotations

import re
from typing import TextIO

import numpy as np

from rheoclast.io.contents import Contents, scalar_columns
from rheoclast.io.files import TextFile
from rheoclast.io.lengths import column_name
from rheoclast.io.rows import Row, SphereColumns, SphereRows, refuse_other_count, sphere_rows

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_STATED_COUNT = re.compile(r"\s*#\s*(?:N_particles_actual|spheres)\s*:\s*(\d+)\s*", re.ASCII)
_UNNAMED = {3: SphereColumns(("x", "y", "z"), (0, 1, 2), None), 4: SphereColumns(("x", "y", "z", "r"), (0, 1, 2), 3)}


def read(file: TextFile) -> SphereRows:
    """Spheres of a plain text file."""
    rows = [(line, words) for line, text in enumerate(file.lines, 1) if (words := _words(text.split("#", 1)[0]))]
    columns = None
    if rows:
        columns = _named_columns(file, *rows[0])
        rows = rows[1:] if columns else rows
    if not rows:
        raise file.error("expected rows x y z [r], got a header and no rows; write the file anew")
    found = sphere_rows(file, rows, columns or _commented_columns(file, rows[0]) or _unnamed_columns(file, rows[0]))
    for line, text in enumerate(file.lines, 1):
        if stated := _STATED_COUNT.fullmatch(text):
            refuse_other_count(file, int(stated[1]), len(rows), line)
    return found


def _words(text: str) -> list[str]:
    text = text.strip().rstrip(",;")
    return _SEPARATOR.split(text.strip()) if text else []


def _named_columns(file: TextFile, line: int, words: list[str]) -> SphereColumns | None:
    try:
        return SphereColumns.named(words)
    except ValueError as error:
        raise file.error(str(error), line) from None


def _commented_columns(file: TextFile, first_row: Row) -> SphereColumns | None:
    """Columns named by the last comment line before the rows that has as many words as they."""
    for line in range(first_row[0] - 1, 0, -1):
        words = _words(file.lines[line - 1].strip().lstrip("#"))
        if len(words) == len(first_row[1]) and (columns := _named_columns(file, line, words)):
            return columns
    return None


def _unnamed_columns(file: TextFile, first_row: Row) -> SphereColumns:
    line, words = first_row
    if len(words) not in _UNNAMED:
        raise file.error(
            f"expected 3 or 4 columns (x y z [r]), got {len(words)}: {' '.join(words)!r:.60}; "
            "name other columns in a line above such as '# id x y z r'",
            line,
        )
    return _UNNAMED[len(words)]


def write(stream: TextIO, contents: Contents) -> None:
    """Spheres as plain text, with the shortest decimals that restore every number exactly."""
    names = [column_name(quantity, contents.unit) for quantity in ("x", "y", "z", "r")]
    extra = scalar_columns(contents.sphere_columns)
    stream.write(f"# spheres: {len(contents.radii)}\n# {' '.join([*names, *extra])}\n")
    table = np.column_stack([contents.centers, contents.radii, *extra.values()])
    stream.writelines(" ".join(map(repr, row)) + "\n" for row in table.tolist())
