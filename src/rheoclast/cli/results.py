"""The files that an analysis leaves in a folder."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rheoclast import io, view
from rheoclast.cli.analysis import Analysis
from rheoclast.cli.tables import contact_columns, contact_table, sphere_columns, sphere_table
from rheoclast.cli.units import Units

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILES = ("contacts.csv", "spheres.csv", "aggregate.vtp", "aggregate.xyz", "aggregate.png", "summary.json")
REPLACED = (*FILES, "report.html")
"""What an analysis replaces: a page of earlier results would no longer tell the truth."""

MOST_NAMED = 8


def json_text(summary: dict[str, Any]) -> str:
    """A summary as JSON.

    Raises
    ------
    ArithmeticError
        If a number in it is not finite.
    """
    try:
        return json.dumps(summary, indent=2, allow_nan=False)
    except ValueError:
        raise ArithmeticError("a result is too large for a number; check rate, viscosity and strength") from None


def prepare(folder: Path, overwrite: bool, names: Sequence[str] = REPLACED) -> None:
    """Refuse a folder in which results of some names or patterns cannot be written, before anything is computed.

    Raises
    ------
    FileNotFoundError
        If the folder in which it would be made is missing.
    FileExistsError
        If it is a file, or a result is already there and must not be replaced.
    PermissionError
        If nothing can be written there.
    """
    if folder.exists() and not folder.is_dir():
        raise FileExistsError(f"--output {folder}: expected a folder, got a file; choose another name")
    if not folder.parent.is_dir():
        raise FileNotFoundError(f"--output {folder}: the folder {folder.parent} does not exist; create it first")
    refuse_unwritable(place_for(folder), f"--output {folder}")
    found = _present(folder, names)
    folders = [path.name for path in found if path.is_dir()]
    if folders:
        raise FileExistsError(f"--output {folder}: {', '.join(folders)} there is a folder; choose another folder")
    present = [path.name for path in found]
    if present and not overwrite:
        raise FileExistsError(
            f"--output {folder}: {', '.join(present[:MOST_NAMED])}{', …' * (len(present) > MOST_NAMED)} already there; "
            "add --overwrite to replace, or choose another folder"
        )


def place_for(folder: Path) -> Path:
    """Where unfinished results go, from which they can be moved: the folder itself once it is there."""
    return folder if folder.is_dir() else folder.parent


def refuse_unwritable(folder: Path, named: str) -> None:
    """Refuse a folder in which nothing can be made, which only an attempt tells.

    Raises
    ------
    PermissionError
        With what it was named.
    """
    try:
        with tempfile.TemporaryDirectory(prefix=".rheoclast-", dir=folder):
            pass
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise PermissionError(f"{named}: cannot be written ({reason}); choose another folder") from None


def write_results(folder: Path, analysis: Analysis, summary: str, units: Units) -> None:
    """Write tables, geometry, picture and the summary, as JSON, into a folder, which is made if needed."""
    with finished_together(folder) as unfinished:
        _write_files(unfinished, analysis, summary, units)


@contextmanager
def finished_together(folder: Path, names: Sequence[str] = REPLACED) -> Iterator[Path]:
    """A folder to write results into, which then take their place all at once; what fails leaves nothing behind.

    Earlier results of these names or patterns, of which there may have been more, are gone afterwards.
    """
    with tempfile.TemporaryDirectory(prefix=".rheoclast-", dir=place_for(folder)) as name:
        yield Path(name)
        folder.mkdir(exist_ok=True)
        new = sorted(Path(name).iterdir())
        for path in new:
            os.replace(path, folder / path.name)
        for stale in {path.name for path in _present(folder, names)} - {path.name for path in new}:
            (folder / stale).unlink()


def written(folder: Path, names: Sequence[str]) -> list[str]:
    """Names of the results in a folder, of which only the first and the last of a pattern are told."""
    return [told for name in names for told in _told([path.name for path in _present(folder, [name])])]


def _told(names: list[str]) -> list[str]:
    return names if len(names) < 3 else [names[0], "…", names[-1]]


def _present(folder: Path, names: Sequence[str]) -> list[Path]:
    return [path for name in names for path in sorted(folder.glob(name))]


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
