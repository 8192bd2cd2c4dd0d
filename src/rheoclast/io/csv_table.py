"""Tables of comma-separated values, whose first line names the columns.

Spheres need columns x, y, z and r (or radius, d, diameter), in any order and case, a unit behind the name (`x_nm`,
`x (nm)`); other columns are passed over. Semicolons and tabs are understood as separators too. A table whose first
line is a row of numbers is read as plain text.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from rheoclast.io import text
from rheoclast.io.contents import Contents, scalar_columns
from rheoclast.io.files import TextFile
from rheoclast.io.lengths import column_name
from rheoclast.io.rows import Row, SphereColumns, SphereRows, sphere_rows

_NUMBER = re.compile(r"[-+]?\.?\d")


def read(file: TextFile) -> SphereRows:
    """Spheres of a table with named columns."""
    rows = list(named_rows(file))
    if not rows:
        raise file.error("expected a line that names the columns x, y, z and r, got only comments")
    line, names = rows[0]
    if _NUMBER.match(names[0]):
        return text.read(file)
    try:
        columns = SphereColumns.named(names)
    except ValueError as error:
        raise file.error(str(error), line) from None
    if columns is None:
        raise file.error(
            f"expected column names x, y, z and r (or radius, d, diameter), got {', '.join(names)!r:.80}; "
            "rename the columns",
            line,
        )
    if len(rows) == 1:
        raise file.error("expected rows of spheres below the column names, got none; write the file anew")
    return sphere_rows(file, rows[1:], columns)


def named_rows(file: TextFile) -> Iterator[Row]:
    """Line number and cells of every row that is not empty or a comment."""
    lines = ["" if line.lstrip().startswith("#") else line for line in file.lines]
    reader = csv.reader(lines, delimiter=separator(next((line for line in lines if line.strip()), "")))
    try:
        for cells in reader:
            if any(cell.strip() for cell in cells):
                yield reader.line_num, [cell.strip() for cell in cells]
    except csv.Error as error:
        raise file.error(f"expected comma-separated values, got a cell that has no end ({error})") from None


def separator(line: str) -> str:
    """What parts the cells of a line: a comma, or a semicolon or tab where there is no comma."""
    return next((mark for mark in ",;\t" if mark in line), ",")


def write(stream: TextIO, contents: Contents) -> None:
    """A table of spheres."""
    lengths = np.column_stack([contents.centers, contents.radii]).T
    names = [column_name(quantity, contents.unit) for quantity in ("x", "y", "z", "radius")]
    write_columns(stream, dict(zip(names, lengths, strict=True)) | contents.sphere_columns)


def write_columns(stream: TextIO, columns: Mapping[str, NDArray[np.generic]]) -> None:
    """A table of any columns (n,) or (n, 3), with the shortest decimals that restore every number exactly."""
    scalars = scalar_columns(columns)
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(scalars)
    table.writerows(zip(*(values.tolist() for values in scalars.values()), strict=True))
