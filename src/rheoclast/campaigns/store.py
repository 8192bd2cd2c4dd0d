"""What a campaign keeps: a folder of Parquet files.

Every finished task is one file, named after the hash of its inputs. It is written under another name first and then
renamed, so that a file that is there is whole. When all are there they are merged, in the order of the campaign. One
process at a time works in a folder.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import msgspec
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.identity import canonical
from rheoclast.campaigns.lock import locked
from rheoclast.campaigns.request import Campaign
from rheoclast.campaigns.task import AGGREGATE, EVENT_LIST, IDENTITY, Task
from rheoclast.io.files import replacing

ROWS_TOGETHER = 500_000
"""Rows that are gathered before they are written, in one row group."""


@dataclass(frozen=True)
class Store:
    """The folder of one campaign.

    Attributes
    ----------
    folder
        With `campaign.json`, the request, `tasks/`, and in the end `events.parquet` and `aggregates.parquet`.
    """

    folder: Path

    @property
    def request(self) -> Path:
        """The campaign that the folder belongs to."""
        return self.folder / "campaign.json"

    @property
    def events(self) -> Path:
        """One row per material, and flow and orientation or history and dissipation, of every aggregate."""
        return self.folder / "events.parquet"

    @property
    def aggregates(self) -> Path:
        """One row per material of every aggregate."""
        return self.folder / "aggregates.parquet"

    @contextmanager
    def claimed(self, campaign: Campaign) -> Iterator[None]:
        """Make the folder that of a campaign, and keep other processes out of it meanwhile.

        Raises
        ------
        FileExistsError
            If it belongs to another campaign, or holds other things.
        BlockingIOError
            If another process works in it.
        """
        self._claim(campaign)
        with locked(self.folder):
            yield

    def _claim(self, campaign: Campaign) -> None:
        request = msgspec.json.format(canonical(campaign), indent=2)
        if not self.request.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            others = [path.name for path in self.folder.iterdir() if not path.name.startswith(".")]
            if others:
                raise FileExistsError(
                    f"{self.folder}: expected a new or empty folder, got one with {others[0]}; choose another folder"
                )
            with replacing(self.request, overwrite=True) as unfinished:
                unfinished.write_bytes(request)
        elif self.request.read_bytes() != request:
            raise FileExistsError(
                f"{self.folder} belongs to another campaign (see {self.request.name} there); choose another folder, "
                "or remove this one if its results are no longer needed"
            )
        (self.folder / "tasks").mkdir(exist_ok=True)

    def has(self, task: Task) -> bool:
        """Whether a task is finished; a file that cannot be read, as a full disk may leave one, does not count."""
        try:
            pq.read_metadata(self._path(task))
        except (OSError, pa.ArrowInvalid):
            return False
        return True

    def keep(self, task: Task, results: pa.Table) -> None:
        """Write the results of a task, all or nothing."""
        with replacing(self._path(task), overwrite=True) as unfinished:
            pq.write_table(results, unfinished)

    def failed(self, tasks: Iterable[Task]) -> list[Task]:
        """Those of some finished tasks that came to nothing for any material."""
        return [task for task in tasks if len(self._results(task, ["failure"]).drop_null())]

    def forget(self, task: Task) -> None:
        """Remove the results of a task, so that it is done again."""
        self._path(task).unlink(missing_ok=True)

    def merge(self, campaign: Campaign) -> None:
        """Write the tables of all events and of all aggregates, once every task is finished."""
        aggregate = pa.schema([*IDENTITY, *AGGREGATE])
        event = pa.schema([*IDENTITY, *EVENTS[campaign.event].type])
        tasks = campaign.tasks()
        _write(self.aggregates, aggregate, (self._results(task, aggregate.names) for task in tasks))
        _write(self.events, event, (_events(self._results(task, [*IDENTITY.names, EVENT_LIST])) for task in tasks))

    def _results(self, task: Task, columns: list[str]) -> pa.Table:
        with pq.ParquetFile(self._path(task)) as file:
            return file.read(columns, use_threads=False)  # threads cost more than such a small file

    def _path(self, task: Task) -> Path:
        return self.folder / "tasks" / f"{task.digest}.parquet"


def _write(path: Path, schema: pa.Schema, tables: Iterable[pa.Table]) -> None:
    """Write many tables as one."""
    with (
        replacing(path, overwrite=True) as unfinished,
        pq.ParquetWriter(unfinished, schema, compression="zstd") as writer,
    ):
        for table in _gathered(tables):
            writer.write_table(table, row_group_size=table.num_rows)


def _gathered(tables: Iterable[pa.Table]) -> Iterator[pa.Table]:
    """The same rows in fewer tables."""
    waiting: list[pa.Table] = []
    rows = 0
    for table in tables:
        waiting.append(table)
        rows += table.num_rows
        if rows >= ROWS_TOGETHER:
            yield pa.concat_tables(waiting)
            waiting, rows = [], 0
    if rows:
        yield pa.concat_tables(waiting)


def _events(results: pa.Table) -> pa.Table:
    """One row per event, with the identity of its aggregate."""
    listed = results[EVENT_LIST].combine_chunks()
    events = listed.flatten()
    identity = results.select(IDENTITY.names).take(pc.list_parent_indices(listed))
    return pa.table([*identity.columns, *events.flatten()], names=[*IDENTITY.names, *events.type.names])
