"""Tables of contacts: comma-separated values with columns i and j."""

from __future__ import annotations

import os

import numpy as np

from rheoclast._checks import IntArray
from rheoclast.io.csv_table import named_rows
from rheoclast.io.files import load
from rheoclast.io.writing import write_table


def read_pairs(path: str | os.PathLike[str]) -> IntArray:
    """Spheres (C, 2) of every contact in a table.

    Raises
    ------
    FileFormatError
        If there are no columns i and j or a cell of them is not a whole number.
    """
    file = load(path)
    rows = list(named_rows(file))
    names = rows[0][1] if rows else []
    if not {"i", "j"} <= set(names):
        raise file.error(f"expected columns i and j, the spheres of every contact, got {', '.join(names)!r:.80}")
    columns = [names.index(name) for name in ("i", "j")]
    pairs = np.empty((len(rows) - 1, 2), dtype=np.intp)
    for k, (line, cells) in enumerate(rows[1:]):
        try:
            pairs[k] = [int(cells[column]) for column in columns]
        except (ValueError, IndexError):
            raise file.error(f"expected the numbers of two spheres, got {', '.join(cells)!r:.80}", line) from None
    return pairs


def write_pairs(path: str | os.PathLike[str], pairs: IntArray, overwrite: bool = False) -> None:
    """Write a table of contacts (C, 2) that `read_pairs` reads. Errors as in `write_table`."""
    i, j = pairs.T
    write_table(path, {"i": i, "j": j}, overwrite=overwrite)
