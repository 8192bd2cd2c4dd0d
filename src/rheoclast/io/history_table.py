"""Tables of velocity-gradient histories: rows of a time and nine entries.

The first line of a table may name its columns, in any order: `t`, a unit behind it (`t_ms`, `t (ms)`); the entries by
their places (`A11`, `g_xy`) or by their meaning (`dudx`, `du_x/dy`), which then decides and not `order`, a unit behind
them (`dudx (1/ms)`, `A11_1/ms`); and `trajectory` (or `id`, `track`, `particle`), a number that tells the paths apart.
Other columns are passed over. Without such names the columns are t and nine entries.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray
from rheoclast.histories import GradientHistory
from rheoclast.io import csv_table
from rheoclast.io.files import TextFile, load
from rheoclast.io.history_samples import PER_SECOND, SECONDS, Samples, inverse_time_unit

DERIVATIVES = tuple(f"d{velocity}d{axis}" for velocity in "uvw" for axis in "xyz")

_AXES = {"u": 0, "v": 1, "w": 2, "x": 0, "y": 1, "z": 2, "1": 0, "2": 1, "3": 2}
_NUMBER = re.compile(r"\s*[-+]?\.?\d")
_TIME = re.compile(r"t(?:ime)?(?:[ _]*[\[(/]?\s*(\w+)\s*[\])]?)?")
_DERIVATIVE = re.compile(r"d(?:u_?([xyz123])|([uvw]))[_/]?d(?:x_?([123])|([xyz]))")
_ENTRY = re.compile(r"(?:a|g|l|grad|gradient|gamma)?_?([xyz123])[_,]?([xyz123])")
_UNIT_BEHIND = re.compile(r"\s*[\[(]\s*(.*?)\s*[\])]?$|_(1/\w+)$")
_TRAJECTORY = {"trajectory", "id", "track", "particle"}


def read_table(path: Path, arrays: tuple[str, str]) -> Iterator[Samples]:
    """Paths in a table, which has no use for the names of arrays."""
    file = load(path)
    first = next((k for k, line in enumerate(file.lines) if _NUMBER.match(line)), None)
    if first is None:
        raise file.error("expected rows of a time and nine entries of the gradient, got no numbers")
    mark = next((mark for mark in ",;\t" if mark in file.lines[first]), None)
    width = len(file.lines[first].split(mark))
    columns = _columns(file, _names(file, first, mark, width), first)
    values = _numbers(file, first, mark)
    for label, rows in _paths(values, columns.trajectory):
        entries = rows[:, columns.entries].reshape(-1, 3, 3)
        yield Samples(label, rows[:, columns.time], entries, *columns.units, columns.transposable)


class _Columns(NamedTuple):
    """Which column is which; the entries row by row."""

    time: int
    entries: list[int]
    units: tuple[str | None, str | None] = (None, None)
    trajectory: int | None = None
    transposable: bool = True


def _names(file: TextFile, first: int, mark: str | None, width: int) -> list[str]:
    """Names in the last line above the first row of numbers; empty where that is a comment on something else."""
    _refuse_lost_rows(file, first, mark, width)
    header = next((line.strip() for line in reversed(file.lines[:first]) if line.strip()), "#")
    names = [cell.strip() for cell in header.lstrip("# ").split(mark)]
    if len(names) == width:
        return names
    if header.startswith("#"):
        return [""] * width
    raise file.error(f"expected names for {width} columns, got {len(names)}: {header!r:.60}; correct this line", first)


def _refuse_lost_rows(file: TextFile, first: int, mark: str | None, width: int) -> None:
    """Refuse a row of numbers above the first: what stands in place of its time must not make names of it."""
    for line, text in enumerate(file.lines[:first], 1):
        cells = text.split(mark)
        if not text.lstrip().startswith("#") and len(cells) == width and any(map(_is_number, cells[1:])):
            raise file.error(
                f"expected names of columns or a row of numbers, got {text.strip()!r:.60}; correct or remove this line",
                line,
            )


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _columns(file: TextFile, names: list[str], first: int) -> _Columns:
    """Meaning of the columns by their names, or by their places where none is named as an entry."""
    lower = [name.lower() for name in names]
    times = {k: found[1] for k, name in enumerate(lower) if (found := _TIME.fullmatch(name)) and _known(found[1])}
    trajectory = next((k for k, name in enumerate(lower) if name in _TRAJECTORY), None)
    bare = [_UNIT_BEHIND.sub("", name, count=1) for name in lower]
    for pattern in (_DERIVATIVE, _ENTRY):
        places = {k: _place(found) for k, name in enumerate(bare) if (found := pattern.fullmatch(name))}
        if places:
            return _named_columns(file, first, names, times, places, trajectory, pattern is _ENTRY)
    rest = [k for k in range(len(names)) if k != trajectory]
    time = next(iter(times), rest[0])
    rest = [k for k in rest if k != time]
    if len(rest) != 9:
        raise file.error(
            f"expected a time and nine entries of the gradient, got {len(rest) + 1} columns; name the columns in a "
            f"first line (t, {', '.join(DERIVATIVES)})",
            first + 1,
        )
    return _Columns(time, rest, (times.get(time), None), trajectory)


def _known(unit: str | None) -> bool:
    return unit is None or unit in SECONDS


def _place(found: re.Match[str]) -> int:
    """Which of the nine entries a name means."""
    row, column = (_AXES[group] for group in found.groups() if group)
    return 3 * row + column


def _named_columns(
    file: TextFile,
    first: int,
    names: list[str],
    times: Mapping[int, str | None],
    places: Mapping[int, int],
    trajectory: int | None,
    transposable: bool,
) -> _Columns:
    if len(times) != 1:
        raise file.error(f"expected one column t, got {len(times)} among {', '.join(names)!r:.80}", first)
    column = {place: k for k, place in places.items()}
    if len(column) < 9 or len(places) > 9:
        raise file.error(
            f"expected all nine entries of the gradient once, got {', '.join(names[k] for k in places)!r:.80}", first
        )
    ((time, unit),) = times.items()
    units = (unit, _gradient_unit(file, first, [names[k] for k in places]))
    return _Columns(time, [column[place] for place in range(9)], units, trajectory, transposable)


def _gradient_unit(file: TextFile, first: int, names: list[str]) -> str | None:
    """The unit behind the names of the entries, if there is one."""
    behind = [found[1] or found[2] for name in names if (found := _UNIT_BEHIND.search(name.lower()))]
    units = sorted({inverse_time_unit(unit) for unit in behind if unit})
    for unit in units:
        if unit not in PER_SECOND:
            raise file.error(f"expected one of {', '.join(PER_SECOND)} behind the entries, got {unit!r:.60}", first)
    if len(units) > 1 or (units and len(behind) < len(names)):
        raise file.error(f"expected the same unit behind all entries, got {', '.join(names)!r:.80}", first)
    return units[0] if units else None


def _numbers(file: TextFile, first: int, mark: str | None) -> FloatArray:
    """All rows of numbers, (rows, columns); a fault is looked for line by line only when there is one."""
    try:
        values: FloatArray = np.loadtxt(file.lines[first:], delimiter=mark, ndmin=2)
    except ValueError:
        values = np.full((1, 1), np.nan)
    if np.isfinite(values).all():
        return values
    width = len(file.lines[first].split(mark))
    for line, text in enumerate(file.lines[first:], first + 1):
        cells = text.split("#", 1)[0].strip()
        if cells and len(cells.split(mark)) != width:
            raise file.error(f"expected {width} columns, got {len(cells.split(mark))}; is the file truncated?", line)
        for cell in cells.split(mark) if cells else ():
            file.number(cell, line)
    raise file.error("expected rows of numbers that NumPy's loadtxt understands; write the file anew")


def _paths(values: FloatArray, trajectory: int | None) -> Iterator[tuple[str, FloatArray]]:
    """Rows of every path under its name, the paths in order of appearance."""
    if trajectory is None:
        yield "", values
        return
    names, first, path = np.unique(values[:, trajectory], return_index=True, return_inverse=True)
    groups = np.split(np.argsort(path, kind="stable"), np.cumsum(np.bincount(path))[:-1])
    for k in np.argsort(first):
        yield f"trajectory {names[k]:g}", values[groups[k]]


def write_table(path: Path, histories: tuple[GradientHistory, ...]) -> None:
    """A table with named columns; the paths are counted from 0 where there are several."""
    columns: dict[str, NDArray[Any]] = {}
    if len(histories) > 1:
        columns["trajectory"] = np.repeat(np.arange(len(histories)), [len(history) for history in histories])
    columns["t_s"] = np.concatenate([history.times for history in histories])
    entries = np.concatenate([history.gradients.reshape(-1, 9) for history in histories])
    columns |= dict(zip(DERIVATIVES, entries.T, strict=True))
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        csv_table.write_columns(stream, columns)
