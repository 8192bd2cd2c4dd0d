"""VTK PolyData for ParaView: sphere centres as vertices, contacts as lines between them. Written, not read.

Radius and sphere columns are point data, so that a glyph filter draws the spheres; contact columns are cell data,
not a number on the vertices. Numbers are stored as binary doubles in base64, hence exactly.
"""

from __future__ import annotations

import base64
import struct
from collections.abc import Mapping
from typing import Any, TextIO
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray
from rheoclast.io.contents import Contents


def write(stream: TextIO, contents: Contents) -> None:
    """Spheres and contacts as VTK PolyData."""
    spheres, contacts = len(contents.radii), len(contents.pairs)
    root = ElementTree.Element(
        "VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian", header_type="UInt64"
    )
    piece = ElementTree.SubElement(
        ElementTree.SubElement(root, "PolyData"),
        "Piece",
        NumberOfPoints=str(spheres),
        NumberOfVerts=str(spheres),
        NumberOfLines=str(contacts),
        NumberOfStrips="0",
        NumberOfPolys="0",
    )
    _section(piece, "PointData", {"radius": contents.radii} | contents.sphere_columns)
    _section(
        piece, "CellData", {name: _below_nan(values, spheres) for name, values in contents.contact_columns.items()}
    )
    _section(piece, "Points", {"Points": contents.centers})
    _section(piece, "Verts", _cells(np.arange(spheres)[:, None]))
    _section(piece, "Lines", _cells(contents.pairs))
    ElementTree.indent(root)
    stream.write('<?xml version="1.0"?>\n')
    ElementTree.ElementTree(root).write(stream, encoding="unicode")
    stream.write("\n")


def _below_nan(values: FloatArray, vertices: int) -> FloatArray:
    """Values of the lines, below as many rows without a value as there are vertices."""
    return np.concatenate([np.full((vertices, *values.shape[1:]), np.nan), values])


def _cells(points: NDArray[np.integer[Any]]) -> dict[str, NDArray[np.int64]]:
    """Cells with the same number of points each, (cells, points), as VTK lists them."""
    count, width = points.shape
    return {"connectivity": points.astype(np.int64).ravel(), "offsets": width * np.arange(1, count + 1, dtype=np.int64)}


def _section(piece: ElementTree.Element, title: str, arrays: Mapping[str, NDArray[Any]]) -> None:
    section = ElementTree.SubElement(piece, title)
    for name, values in arrays.items():
        kind = "Int64" if np.issubdtype(values.dtype, np.integer) else "Float64"
        components = values.shape[1] if values.ndim == 2 else 1
        element = ElementTree.SubElement(
            section, "DataArray", type=kind, Name=name, NumberOfComponents=str(components), format="binary"
        )
        data = values.astype("<i8" if kind == "Int64" else "<f8").tobytes()
        element.text = base64.b64encode(struct.pack("<Q", len(data)) + data).decode("ascii")
