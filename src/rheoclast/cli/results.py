"""The files that an analysis leaves in a folder."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from rheoclast import io, view
from rheoclast.cli.analysis import Analysis
from rheoclast.cli.tables import contact_columns, contact_table, sphere_columns, sphere_table
from rheoclast.cli.units import Units

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    if not folder.parent.is_dir():
        raise FileNotFoundError(f"--output {folder}: the folder {folder.parent} does not exist; create it first")
    if not os.access(folder if folder.exists() else folder.parent, os.W_OK | os.X_OK):
        raise PermissionError(f"--output {folder}: no permission to write there; choose another folder")
    folders = [name for name in FILES if (folder / name).is_dir()]
    if folders:
        raise FileExistsError(f"--output {folder}: {', '.join(folders)} there is a folder; choose another folder")
    present = [name for name in FILES if (folder / name).exists()]
    if present and not overwrite:
        raise FileExistsError(
            f"--output {folder}: {', '.join(present)} already there; "
            "add --overwrite to replace, or choose another folder"
        )


def write_results(folder: Path, analysis: Analysis, summary: str, units: Units) -> None:
    """Write tables, geometry, picture and the summary, as JSON, into a folder, which is made if needed.

    All files are finished before the first takes its place: what fails leaves nothing behind.
    """
    with tempfile.TemporaryDirectory(prefix=".rheoclast-", dir=folder.parent) as name:
        finished = Path(name)
        _write_files(finished, analysis, summary, units)
        folder.mkdir(exist_ok=True)
        for file in FILES:
            os.replace(finished / file, folder / file)


def _write_files(folder: Path, analysis: Analysis, summary: str, units: Units) -> None:
    aggregate, length = analysis.aggregate, units.length
    spheres, contacts = sphere_columns(analysis, units), contact_columns(analysis, units)
    io.write_table(folder / "contacts.csv", contact_table(analysis, units))
    io.write_table(folder / "spheres.csv", sphere_table(analysis, units))
    io.write(folder / "aggregate.vtp", aggregate, sphere_columns=spheres, contact_columns=contacts, unit=length)
    io.write(folder / "aggregate.xyz", aggregate, sphere_columns=spheres, unit=length)
    (folder / "summary.json").write_text(summary + "\n", encoding="utf-8")
    view.save(_picture(analysis, units), folder / "aggregate.png")


def _picture(analysis: Analysis, units: Units) -> Figure:
    si = units == Units()
    return view.draw(
        analysis.aggregate.scaled(1 / units.length),
        analysis.contact_loads.tension / units.force,
        unit="N" if si else None,
        length_unit="m" if si else None,
        flow=analysis.flow,
        critical=analysis.given.contact,
    )
