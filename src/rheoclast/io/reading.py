"""Aggregates and spheres from files."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from rheoclast import _checks, scales
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError, GeometryWarning
from rheoclast.io import lengths
from rheoclast.io.contact_table import read_pairs
from rheoclast.io.files import TextFile, load
from rheoclast.io.formats import reader_for
from rheoclast.io.rows import SphereRows
from rheoclast.particles.aggregate import WIDE_GAP, Aggregate
from rheoclast.particles.contacts import CONTACT_TOLERANCE
from rheoclast.particles.spheres import Spheres


def read(
    path: str | os.PathLike[str],
    unit: str | float = "m",
    *,
    format: str | None = None,
    radius: float | None = None,
    tolerance: float = CONTACT_TOLERANCE,
    overlap_tolerance: float = CONTACT_TOLERANCE,
    contacts: str | os.PathLike[str] | None = None,
) -> Aggregate:
    """Aggregate of the touching spheres in a file.

    Parameters
    ----------
    path
        File of spheres; of a file with several frames the last is read.
    unit
        Unit of length of the file: "m", "cm", "mm", "um", "nm", "angstrom", "dimensionless", or its value in m.
    format
        "text", "csv", "xyz", "lammps-dump" or "lammps-data"; by default told from the suffix, then from the content.
    radius
        Radius of all spheres, in the unit of the file, for a file without radii.
    tolerance
        Largest gap of two spheres, in mean radii of the pair, that counts as contact.
    overlap_tolerance
        Largest overlap of two spheres, in mean radii of the pair, that counts as contact.
    contacts
        A table of comma-separated values with columns i and j, the spheres of every contact counted from 0, such as
        the `contacts.csv` that `rheoclast stress` writes. Only these are in contact then, and gaps do not matter.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    FileFormatError
        If the file cannot be understood, with the line where there is one; if it has no radii and none is given, or
        radii and one is given; if it states another unit of length.
    GeometryError
        If spheres overlap or the aggregate is in several parts.

    Warns
    -----
    UnitWarning
        If a radius exceeds 1 mm or is below 0.1 nm, unless lengths are dimensionless.
    GeometryWarning
        If a contact reaches across a gap of half a mean radius or more.
    """
    spheres = read_spheres(path, unit, format=format, radius=radius, overlap_tolerance=overlap_tolerance)
    if contacts is None:
        with _named(path):
            aggregate = Aggregate.touching(spheres, tolerance)
        _warn_of_gaps(path, aggregate, f"is the tolerance of {tolerance:g} meant?")
    else:
        pairs = read_pairs(contacts)
        with _named(contacts):
            aggregate = Aggregate(spheres, pairs)
        _warn_of_gaps(contacts, aggregate, "are spheres counted from 0 there?")
    return aggregate


def read_spheres(
    path: str | os.PathLike[str],
    unit: str | float = "m",
    *,
    format: str | None = None,
    radius: float | None = None,
    overlap_tolerance: float = CONTACT_TOLERANCE,
) -> Spheres:
    """Spheres in a file, which need not touch. Parameters, errors and warnings as in `read`."""
    metres = lengths.metres(unit)
    file = load(path)
    found = reader_for(file, format)(file)
    _refuse_other_unit(file, found, unit, metres)
    radii = _radii(file, found, radius) * metres
    with _named(path):
        spheres = Spheres(found.centers * metres, radii, overlap_tolerance)
    if unit != lengths.DIMENSIONLESS:
        scales.warn_of_radii(spheres.radii)
    return spheres


def _warn_of_gaps(path: str | os.PathLike[str], aggregate: Aggregate, question: str) -> None:
    wide = np.flatnonzero(aggregate.gaps >= WIDE_GAP)
    if len(wide):
        i, j = aggregate.pairs[wide[0]]
        others = f" (and {len(wide) - 1} more)" if len(wide) > 1 else ""
        warnings.warn(
            f"{path}: contact {wide[0]} joins spheres {i} and {j} across a gap of {aggregate.gaps[wide[0]]:.3g} mean "
            f"radii{others}; {question}",
            GeometryWarning,
            stacklevel=3,
        )


def _radii(file: TextFile, found: SphereRows, radius: float | None) -> FloatArray:
    """Radii in the unit of the file, from the file or from the caller, never from both."""
    if found.radii is None:
        if radius is None:
            raise file.error("expected a radius of every sphere, got only positions; pass radius= in the file's unit")
        return np.full(len(found.centers), _checks.positive("radius", radius))
    if radius is not None:
        raise file.error(f"expected no radius=, because the file has radii, got {radius!r:.60}; leave it out")
    bad = np.flatnonzero(found.radii <= 0)
    if len(bad):
        first = int(bad[0])
        raise file.error(
            f"expected a positive radius, got {found.radii[first]:g} for sphere {first}; correct or remove it",
            found.lines[first],
        )
    return found.radii


def _refuse_other_unit(file: TextFile, found: SphereRows, unit: str | float, metres: float) -> None:
    """Refuse a unit that contradicts the one in the file's column names: the error would be a power of ten."""
    if unit == lengths.DIMENSIONLESS:
        return
    for stated in sorted(found.units):
        if not math.isclose(lengths.METRES[stated], metres, rel_tol=1e-9):
            raise file.error(
                f"expected lengths in {lengths.ascii_name(unit)}, got columns in {stated} by their names; "
                f"pass unit={stated!r} or rename the columns"
            )


@contextmanager
def _named(path: str | os.PathLike[str]) -> Iterator[None]:
    """Put the name of the file in front of what is wrong with its geometry."""
    try:
        yield
    except GeometryError as error:
        raise GeometryError(f"{path}: {error}") from None
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
