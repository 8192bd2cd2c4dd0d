"""What LAMMPS dump and data files share. Their readers are our own: the maintained package lammpsio has no sphere
style and no radius.

Spheres come in the order of their ids. Positions are taken as they stand: an aggregate that a periodic boundary cuts
must be made whole before (dump xu yu zu).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from rheoclast.io.files import TextFile
from rheoclast.io.rows import Row


def rows_below(file: TextFile, title: int, next_title: re.Pattern[str]) -> list[Row]:
    """Lines below the title of a section and above the next, as words without comments; blank lines are left out."""
    rows: list[Row] = []
    for line, text in enumerate(file.lines[title:], title + 1):
        if next_title.match(text):
            break
        if words := text.split("#", 1)[0].split():
            rows.append((line, words))
    return rows


def sorted_by_id(file: TextFile, rows: Sequence[Row], column: int) -> list[Row]:
    """Rows in the order of their ids.

    Raises
    ------
    FileFormatError
        If an id is not a whole number or is there twice.
    """
    place: dict[int, Row] = {}
    for row in rows:
        line, words = row
        identity = file.whole_number(words[column] if column < len(words) else "", line, "the id of a sphere")
        if identity in place:
            raise file.error(f"id {identity} is there already in line {place[identity][0]}; give every id once", line)
        place[identity] = row
    return [place[identity] for identity in sorted(place)]
