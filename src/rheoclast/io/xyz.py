"""XYZ and extended XYZ, through the library `extxyz`; of several frames the last is read.

Extended XYZ names its columns in the comment line (`Properties=species:S:1:pos:R:3:radius:R:1`); a column radius, as
OVITO writes it, or diameter gives the size, upper or lower case. Plain XYZ has rows species x y z, without radii; a
fifth column is taken for the radius. The library passes over a truncated frame in silence, takes a comment line that
it cannot parse for plain XYZ, and knows no line numbers; so frames are counted here, and it is handed the last one
with nothing but the properties, quoted.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from rheoclast.errors import FileFormatError
from rheoclast.io.contents import Contents
from rheoclast.io.files import TextFile
from rheoclast.io.rows import SphereRows, refuse_other_count

_PROPERTIES = re.compile(r"(?:^|\s)Properties\s*=\s*(?:\"([^\"]*)\"|(\S+))", re.IGNORECASE)
_PLAIN = {4: "species:S:1:pos:R:3", 5: "species:S:1:pos:R:3:radius:R:1"}
_WRONG_FIELD = re.compile(r"invalid field '(.*)' for property '(.*)' on atom line (\d+)")
_WRONG_WIDTH = re.compile(r"expected (\d+) fields on atom line (\d+)")


def read(file: TextFile) -> SphereRows:
    """Spheres of the last frame of an XYZ file."""
    first, count = _last_frame(file)
    properties = _properties(file, first)
    arrays = _arrays(file, first, count, properties)
    by_name = {name.lower(): values for name, values in arrays.items()}
    centers = by_name.get("pos")
    if centers is None or centers.shape != (count, 3) or centers.dtype.kind not in "if":
        raise file.error(f"expected a column pos:R:3 among the properties, got {properties!r:.80}", first - 1)
    radii = by_name.get("radius")
    if radii is None and "diameter" in by_name:
        radii = 0.5 * by_name["diameter"]
    if radii is not None and (radii.shape != (count,) or radii.dtype.kind not in "if"):
        raise file.error(f"expected one number per sphere as radius, got {properties!r:.80}", first - 1)
    lines = range(first, first + count)
    return SphereRows(centers.astype(float), None if radii is None else radii.astype(float), lines)


def _last_frame(file: TextFile) -> tuple[int, int]:
    """Line number of the first row of the last frame, and its number of rows."""
    last = max(line for line, text in enumerate(file.lines, 1) if text.strip())
    line, count = 1, 0
    while line <= last:
        count = file.whole_number(file.lines[line - 1], line, "the number of spheres of a frame")
        if count == 0:
            raise file.error("expected at least one sphere, got a frame of 0", line)
        refuse_other_count(file, count, min(count, max(last - line - 1, 0)), line)
        line += 2 + count
    return line - count, count


def _properties(file: TextFile, first: int) -> str:
    """The columns of a frame, as its comment line names them or as plain XYZ has them."""
    named = _PROPERTIES.search(file.lines[first - 2])
    if named and (columns := named[1] or named[2]):
        return columns
    words = file.lines[first - 1].split()
    if len(words) not in _PLAIN:
        raise file.error(
            f"expected species x y z [r], got {len(words)} columns; "
            "name other columns by Properties=… in the comment line",
            first,
        )
    return _PLAIN[len(words)]


def _arrays(file: TextFile, first: int, count: int, properties: str) -> dict[str, Any]:
    """Columns by name, as the library reads them from a copy of one frame."""
    import extxyz
    from extxyz.cextxyz import ExtXYZError

    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "frame.xyz")
        rows = file.lines[first - 1 : first - 1 + count]
        copy.write_text("\n".join([str(count), "", *rows, ""]), encoding="utf-8")
        try:
            frames = list(extxyz.iread_dicts(str(copy), comment=f'Properties="{properties}"'))
        except ExtXYZError as error:
            raise _with_line(file, first, properties, str(error)) from None
    if len(frames) != 1 or list(frames[0].arrays) != properties.split(":")[::3]:
        raise file.error(f"expected columns in the form name:type:number, got {properties!r:.80}", first - 1)
    return dict(frames[0].arrays)


def _with_line(file: TextFile, first: int, properties: str, message: str) -> FileFormatError:
    """The library's complaint as a sentence with the line number."""
    if field := _WRONG_FIELD.search(message):
        return file.error(f"expected a finite number for {field[2]!r}, got {field[1]!r:.60}", first + int(field[3]))
    if width := _WRONG_WIDTH.search(message):
        line = first + int(width[2])
        got = len(file.lines[line - 1].split())
        return file.error(f"expected {width[1]} columns ({properties:.80}), got {got}; is the file truncated?", line)
    return file.error(f"expected columns in the form name:type:number, got {properties!r:.80} ({message})", first - 1)


def write(stream: TextIO, contents: Contents) -> None:
    """Spheres as extended XYZ, with radius and further columns, in a box without periodicity."""
    import extxyz

    _refuse_not_finite(contents)
    count = len(contents.radii)
    low, high = contents.box
    frame = extxyz.Frame(
        natoms=count,
        cell=np.diag(high - low),
        pbc="F F F",  # as text: the library would write an array as [F, F, F], which OVITO does not read
        info={"Origin": " ".join(map(repr, low.tolist()))},
        arrays={"species": np.full(count, "X"), "pos": contents.centers, "radius": contents.radii}
        | contents.sphere_columns,
    )
    extxyz.write_dicts(stream, frame, format_dict={"R": "%.17g", "S": "%s"})


def _refuse_not_finite(contents: Contents) -> None:
    for name, values in contents.sphere_columns.items():
        bad = np.argwhere(~np.isfinite(values))
        if len(bad):
            raise ValueError(
                f"sphere_columns[{name!r}]: expected finite numbers, which is all that extended XYZ can hold, "
                f"got {values[tuple(bad[0])]} for sphere {bad[0][0]}; leave the column out or write CSV"
            )
