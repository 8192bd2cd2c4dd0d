"""The files that an analysis leaves in a folder."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rheoclast import io, view
from rheoclast.cli.analysis import Analysis
from rheoclast.cli.tables import contact_columns, contact_table, sphere_columns, sphere_table
from rheoclast.cli.units import Units
from rheoclast.io.files import replacing

FILES = ("contacts.csv", "spheres.csv", "aggregate.vtp", "aggregate.xyz", "aggregate.png", "summary.json")


def prepare(folder: Path, overwrite: bool) -> None:
    """Refuse a folder in which the results cannot be written, before anything is computed.

    Raises
    ------
    FileNotFoundError
        If the folder in which it would be made is missing.
    FileExistsError
        If it is a file, or a result is already there and must not be replaced.
    """
    if folder.exists() and not folder.is_dir():
        raise FileExistsError(f"--output {folder}: expected a folder, got a file; choose another name")
    if not folder.parent.exists():
        raise FileNotFoundError(f"--output {folder}: the folder {folder.parent} does not exist; create it first")
    present = [name for name in FILES if (folder / name).exists()]
    if present and not overwrite:
        raise FileExistsError(
            f"--output {folder}: {', '.join(present)} already there; "
            "add --overwrite to replace, or choose another folder"
        )


def write_results(folder: Path, analysis: Analysis, summary: dict[str, Any], units: Units) -> list[Path]:
    """Write tables, geometry, picture and summary into a folder, which is made if needed; returns what was written."""
    folder.mkdir(exist_ok=True)
    spheres, contacts = sphere_columns(analysis, units), contact_columns(analysis, units)
    aggregate = analysis.aggregate
    writers: dict[str, Callable[[Path], object]] = {
        "contacts.csv": lambda path: io.write_table(path, contact_table(analysis, units), overwrite=True),
        "spheres.csv": lambda path: io.write_table(path, sphere_table(analysis, units), overwrite=True),
        "aggregate.vtp": lambda path: io.write(
            path, aggregate, sphere_columns=spheres, contact_columns=contacts, unit=units.length, overwrite=True
        ),
        "aggregate.xyz": lambda path: io.write(
            path, aggregate, sphere_columns=spheres, unit=units.length, overwrite=True
        ),
        "aggregate.png": lambda path: _picture(path, analysis, units),
        "summary.json": lambda path: _text(path, json.dumps(summary, indent=2) + "\n"),
    }
    paths = []
    for name in FILES:
        writers[name](folder / name)
        paths.append(folder / name)
    return paths


def _text(path: Path, text: str) -> None:
    with replacing(path, overwrite=True) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _picture(path: Path, analysis: Analysis, units: Units) -> None:
    si = units == Units()
    figure = view.draw(
        analysis.aggregate.scaled(1 / units.length),
        analysis.contact_loads.tension / units.force,
        unit="N" if si else None,
        length_unit="m" if si else None,
        flow=analysis.flow,
        critical=analysis.given.contact,
    )
    with replacing(path, overwrite=True) as temporary:
        view.save(figure, temporary)
