"""What `rheoclast survey` left in a folder, read back, whether all of it is done or not."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from inspect import signature
from pathlib import Path
from typing import Any

from rheoclast.errors import FileFormatError
from rheoclast.generation.families import FAMILIES
from rheoclast.io.files import load

ArrowTable = Any
REQUEST = "campaign.json"
REQUEST_KEYS = ("event", "families", "sizes", "seeds", "viscosity", "materials", "criterion", "rule", "hydrodynamics")
AGGREGATE = ("spheres", "contacts", "mean_coordination", "radius_of_gyration_m")
AGGREGATE_COLUMNS = ("task", "family", "parameters", "material", "rheoclast", *AGGREGATE, "failure")
EVENT_COLUMNS: Mapping[str, tuple[str, ...]] = {
    "first failure": ("flow", "initiation_rate_per_s", "criterion", "margin", "radial_position"),
    "breakup": ("flow", "outcome", "initiation_rate_per_s", "breakup_rate_per_s", "surface", "fragments"),
    "history": (
        *("dissipation_m2_per_s3", "time_s", "failed", "overloaded", "largest_load_ratio", "criterion"),
        *("radial_position", "smaller_share"),
    ),
}
IDENTITY = ("task", "family", "parameters", "material")


@dataclass(frozen=True, eq=False)
class CampaignResult:
    """What a campaign has brought so far. Made by `read_campaign_result`.

    Attributes
    ----------
    folder
        Where the files are.
    request
        The content of campaign.json.
    asked
        Number of aggregates that the campaign asks for.
    aggregates
        Arrow table, one row per material of every aggregate that is done.
    events
        Arrow table, one row per event, of those columns that the page needs.
    """

    folder: Path
    request: Mapping[str, Any]
    asked: int
    aggregates: ArrowTable
    events: ArrowTable

    @property
    def event(self) -> str:
        """The kind of event: "first failure", "breakup" or "history"."""
        return str(self.request["event"])

    @property
    def done(self) -> int:
        """Number of aggregates that are done, those that came to nothing included."""
        return len(self.aggregates["task"].unique())

    @property
    def failures(self) -> list[tuple[str, str, str]]:
        """Family, parameters and reason of everything that came to nothing."""
        rows = self.aggregates.select(["family", "parameters", "failure"]).to_pylist()
        return [tuple(row.values()) for row in rows if row["failure"] is not None]


def is_campaign(folder: str | os.PathLike[str]) -> bool:
    """Whether a folder is that of a campaign."""
    return (Path(folder) / REQUEST).is_file()


def read_campaign_result(folder: str | os.PathLike[str]) -> CampaignResult:
    """What a campaign left in a folder; of one that goes on, what is done.

    Raises
    ------
    FileNotFoundError
        If no aggregate is done yet.
    FileFormatError
        If one of the files is not as it was written.
    ImportError
        If pyarrow is not installed.
    """
    path = Path(folder)
    request = _request(path / REQUEST)
    _arrow("pyarrow")
    if (path / "aggregates.parquet").is_file() and (path / "events.parquet").is_file():
        aggregates = _read(path / "aggregates.parquet", AGGREGATE_COLUMNS)
        events = _read(path / "events.parquet", (*IDENTITY, *EVENT_COLUMNS[request["event"]]))
        return CampaignResult(path, request, len(aggregates["task"].unique()), aggregates, events)
    aggregates, events = _unfinished(path, EVENT_COLUMNS[request["event"]])
    return CampaignResult(path, request, _asked(request), aggregates, events)


def _request(path: Path) -> Mapping[str, Any]:
    file = load(path)
    try:
        request = json.loads("\n".join(file.lines))
    except json.JSONDecodeError as error:
        raise file.error(f"expected JSON ({error}); start the campaign anew") from None
    missing = [key for key in REQUEST_KEYS if key not in request] if isinstance(request, dict) else REQUEST_KEYS
    if missing:
        raise file.error(f"expected the request of a campaign, got one without {missing[0]}; start the campaign anew")
    if request["event"] not in EVENT_COLUMNS:
        raise file.error(f"event: expected one of {', '.join(EVENT_COLUMNS)}, got {request['event']!r}")
    return request


def _asked(request: Mapping[str, Any]) -> int:
    """Number of aggregates: all combinations of a family's values, and of sizes and seeds where it has them."""
    return sum(_of_family(asked, request) for asked in request["families"])


def _of_family(asked: Mapping[str, Any], request: Mapping[str, Any]) -> int:
    known = signature(FAMILIES[asked["name"]]).parameters if asked.get("name") in FAMILIES else {}
    number = math.prod(len(value) for value in asked.values() if isinstance(value, list))
    sizes = len(request["sizes"]) if "count" in known and "count" not in asked else 1
    return number * sizes * (request["seeds"]["number"] if "seed" in known else 1)


def _unfinished(folder: Path, columns: tuple[str, ...]) -> tuple[ArrowTable, ArrowTable]:
    """Aggregates and events of the tasks that are done; a file that cannot be read is not done."""
    arrow, parquet = _arrow("pyarrow"), _arrow("pyarrow.parquet")
    done = []
    for path in sorted((folder / "tasks").glob("[!.]*.parquet")):
        try:
            with parquet.ParquetFile(path) as file:
                done.append(file.read([*AGGREGATE_COLUMNS, "events"], use_threads=False))
        except (OSError, arrow.ArrowInvalid):
            continue
    if not done:
        raise FileNotFoundError(f"{folder}: no aggregate of the campaign is done yet; make the page later")
    tasks = arrow.concat_tables(done).sort_by([("family", "ascending"), ("parameters", "ascending")])
    return tasks.select(AGGREGATE_COLUMNS), _events(tasks, columns)


def _events(tasks: ArrowTable, columns: tuple[str, ...]) -> ArrowTable:
    """One row per event, with the identity of its aggregate."""
    arrow, compute = _arrow("pyarrow"), _arrow("pyarrow.compute")
    listed = tasks["events"].combine_chunks()
    events = listed.flatten()
    identity = tasks.select(IDENTITY).take(compute.list_parent_indices(listed))
    fields = [events.field(name) for name in columns]
    return arrow.table([*identity.columns, *fields], names=[*IDENTITY, *columns])


def _read(path: Path, columns: tuple[str, ...]) -> ArrowTable:
    arrow, parquet = _arrow("pyarrow"), _arrow("pyarrow.parquet")
    try:
        missing = [name for name in columns if name not in parquet.read_schema(path).names]
        table = None if missing else parquet.read_table(path, columns=list(columns))
    except (OSError, arrow.ArrowInvalid) as error:
        raise FileFormatError(f"{path}: expected the table of a campaign ({error}); run the campaign again") from None
    if missing:
        raise FileFormatError(f"{path}: expected a column {missing[0]}, got none; run the campaign again")
    return table


def _arrow(name: str) -> Any:
    try:
        return import_module(name)
    except ImportError:
        raise ImportError("a page on a campaign needs the package pyarrow: pip install 'rheoclast[parquet]'") from None
