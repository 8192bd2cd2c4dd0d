"""What `rheoclast stress` or `rheoclast break` left in a folder, read back."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rheoclast.errors import FileFormatError
from rheoclast.flows import LinearFlow
from rheoclast.io.csv_table import named_rows
from rheoclast.io.files import TextFile, load

Table = Mapping[str, NDArray[Any]]
NEEDED = ("summary.json", "contacts.csv", "spheres.csv")
CONTACT_COLUMNS = ("i", "j", "point_x", "point_y", "point_z", "tension", "shear", "bending", "twisting", "load_ratio")
FORCES, MOMENTS = ("tension", "shear", "worst_tension"), ("bending", "twisting")
RATIOS = ("load_ratio", "worst_load_ratio")
ROUNDING = 1e-12
SPHERE_COLUMNS = ("x", "y", "z", "radius")
FAILURE_COLUMNS = ("failure", "contact", "i", "j", "rate", "reached", "criterion", "overload", "radial_position")
FRAGMENT_COLUMNS = ("fragment", "spheres", "contacts", "radius_of_gyration")
PIECE_COLUMNS = (
    *("piece", "parent", "generation", "spheres", "contacts", "radius_of_gyration", "holds", "failures"),
    *("initiation_rate", "breakup_rate"),
)
STRESS_KEYS = (
    *("aggregate", "model", "flow", "contact_law", "largest", "most_tensioned"),
    *("given_orientation", "worst_orientation", "units"),
)
BREAK_KEYS = (
    *("spheres", "contacts", "mean_coordination", "radius_of_gyration_m", "model", "order", "viscosity_Pa_s"),
    *("orientation", "flow_gradient_per_s", "flow_rate_per_s", "contact_loads_at_rate_per_s", "rule", "criterion"),
    *("outcome", "initiation_rate_per_s", "initiation_rate_error", "breakup_rate_per_s", "failures", "surface"),
    *("inwardness", "near_ties", "fragments", "contact_law", "seed", "up_to_per_s", "units"),
)
_UNIT_TAG = re.compile(r"_(?:m|N|Nm|per_s)(?=_[xyz]$|$)")


@dataclass(frozen=True, eq=False)
class Result:
    """One aggregate in one flow, as its files tell. Made by `read_result`.

    Attributes
    ----------
    folder
        Where the files are.
    summary
        The content of summary.json.
    contacts, spheres, failures, fragments, pieces
        Columns by name, without the unit at its end: "tension", not "tension_N"; failures and fragments are empty
        unless the aggregate was broken, pieces unless its fragments were followed in a cascade.
    """

    folder: Path
    summary: Mapping[str, Any]
    contacts: Table
    spheres: Table
    failures: Table
    fragments: Table
    pieces: Table

    @property
    def is_breakup(self) -> bool:
        """Whether the aggregate was broken, or only its loads computed."""
        return "outcome" in self.summary

    @property
    def name(self) -> str:
        """Name of the file that the aggregate came from."""
        return str(self.summary.get("file", self.folder.name))

    @property
    def units(self) -> Mapping[str, str]:
        """Names of the units of length, force, moment and others; empty where there are none."""
        units: Mapping[str, str] = self.summary["units"]
        return units

    @property
    def flow(self) -> LinearFlow:
        """The flow in which the aggregate was."""
        if self.is_breakup:
            return LinearFlow(self.summary["flow_gradient_per_s"], self.summary["flow_rate_per_s"])
        return LinearFlow(self.summary["flow"]["gradient_per_s"], self.summary["flow"]["rate_per_s"])


def read_result(folder: str | os.PathLike[str]) -> Result:
    """What a command left in a folder.

    Raises
    ------
    FileNotFoundError
        If there is no such folder, or no results in it.
    FileFormatError
        If one of the files is not as it was written.
    """
    path = Path(folder)
    if not path.is_dir():
        what = "a file" if path.exists() else "nothing of that name"
        raise FileNotFoundError(f"{path}: expected a folder with the results of stress, break or survey, got {what}")
    missing = [name for name in NEEDED if not (path / name).is_file()]
    if missing:
        raise FileNotFoundError(
            f"{path}: expected the results of stress, break or survey, got a folder without {', '.join(missing)}; "
            f"write them with rheoclast stress FILE --output {path}"
        )
    summary = _summary(path / "summary.json")
    spheres = _table(path / "spheres.csv", SPHERE_COLUMNS)
    contacts = _without_rounding_errors(_table(path / "contacts.csv", CONTACT_COLUMNS), spheres["radius"])
    _refuse_wrong_pairs(path / "contacts.csv", contacts, len(spheres["x"]))
    broken = "outcome" in summary
    failures = _table(path / "failures.csv", FAILURE_COLUMNS) if broken and summary["initiation_rate_per_s"] else {}
    fragments = _table(path / "fragments.csv", FRAGMENT_COLUMNS) if broken else {}
    pieces = _table(path / "pieces.csv", PIECE_COLUMNS, are_finite=False) if "cascade" in summary else {}
    return Result(path, summary, contacts, spheres, failures, fragments, pieces)


def _summary(path: Path) -> Mapping[str, Any]:
    file = load(path)
    try:
        summary = json.loads("\n".join(file.lines))
    except ValueError as error:
        raise file.error(f"expected JSON ({error}); write it anew") from None
    if not isinstance(summary, dict):
        raise file.error(f"expected an object with the names of results, got {type(summary).__name__}")
    wanted = BREAK_KEYS if "outcome" in summary else STRESS_KEYS
    missing = [key for key in wanted if key not in summary]
    if missing:
        raise file.error(f"expected the summary of stress or break, got one without {missing[0]}; write it anew")
    return summary


def _table(path: Path, wanted: tuple[str, ...], *, are_finite: bool = True) -> Table:
    """Columns of numbers, and of words where not all cells are numbers."""
    file = load(path)
    rows = list(named_rows(file))
    names = [_UNIT_TAG.sub("", name) for name in rows[0][1]] if rows else []
    missing = [name for name in wanted if name not in names]
    if missing:
        raise file.error(f"expected a column {missing[0]}, got {', '.join(names)!r:.80}; write the file anew")
    for line, cells in rows[1:]:
        if len(cells) != len(names):
            raise file.error(f"expected {len(names)} cells, got {len(cells)}; write the file anew", line)
    if len(rows) == 1:
        return {name: np.empty(0) for name in names}
    columns = zip(*(cells for _, cells in rows[1:]), strict=True)
    return {name: _column(file, name, cells, are_finite) for name, cells in zip(names, columns, strict=True)}


def _column(file: TextFile, name: str, cells: tuple[str, ...], are_finite: bool) -> NDArray[Any]:
    try:
        values = np.array(cells, dtype=np.float64)
    except ValueError:
        if name == "criterion":
            return np.array(cells)
        raise file.error(f"expected numbers in the column {name}, got words; write the file anew") from None
    if are_finite and not np.isfinite(values).all():
        raise file.error(
            f"expected finite numbers in the column {name}, got {cells[int(np.isfinite(values).argmin())]}"
        )
    return values


def _without_rounding_errors(contacts: Table, radii: NDArray[np.float64]) -> Table:
    """The same loads, with zeros for those that are nothing beside the largest force of any contact."""
    force = max(float(np.abs(contacts[name]).max(initial=0.0)) for name in FORCES if name in contacts)
    sizes = {
        **dict.fromkeys(FORCES, force),
        **dict.fromkeys(MOMENTS, force * radii.mean()),
        **dict.fromkeys(RATIOS, 1.0),
    }
    return {
        name: np.where(np.abs(values) > ROUNDING * sizes[name], values, 0.0) if name in sizes else values
        for name, values in contacts.items()
    }


def _refuse_wrong_pairs(path: Path, contacts: Table, spheres: int) -> None:
    pairs = np.stack([contacts["i"], contacts["j"]])
    if ((pairs < 0) | (pairs >= spheres)).any():
        raise FileFormatError(
            f"{path}: expected spheres below {spheres}, the number in spheres.csv, got {pairs.max():g}; "
            "write both files anew"
        )
