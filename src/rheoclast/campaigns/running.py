"""Run a campaign, from the beginning or from where it was left."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from rheoclast import _checks
from rheoclast.campaigns import cluster, local_pool
from rheoclast.campaigns.request import Campaign
from rheoclast.campaigns.store import Store
from rheoclast.campaigns.task import Task, failed, perform
from rheoclast.campaigns.worker import WorkerLost
from rheoclast.names import one_of

Progress = Callable[[int, int], None]

Performed = Callable[[list[Task]], Generator[tuple[Task, pa.Table | WorkerLost], None, None]]

TABLES = ("events", "aggregates")


@dataclass(frozen=True)
class Survey:
    """What a campaign has brought. Made by `survey`.

    Attributes
    ----------
    events, aggregates
        Parquet files with one row per event, and one per aggregate and material.
    """

    events: Path
    aggregates: Path

    def table(self, name: str, columns: list[str] | None = None) -> pa.Table:
        """One of the tables, "events" or "aggregates", or some of its columns.

        Raises
        ------
        ValueError
            If there is no such table.
        """
        one_of("name", TABLES, name)
        return pq.read_table(getattr(self, name), columns=columns)


def survey(
    campaign: Campaign,
    folder: str | os.PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    retry: bool = False,
    progress: Progress | None = None,
) -> Survey:
    """Do all tasks of a campaign that are not finished in a folder, then merge their results.

    It may be stopped at any moment, and goes on from there when called again: finished tasks stay. The tables do not
    depend on the workers, nor on interruptions.

    Parameters
    ----------
    campaign
        From `read_campaign`.
    folder
        For the results; made if needed.
    workers
        Number of processes on this machine, by default one per core. A script that calls this needs the usual
        ``if __name__ == "__main__":``, as the processes load it.
    scheduler
        Address of a scheduler of dask.distributed, to work on its workers instead; best with one thread each.
    retry
        Do again the tasks that failed.
    progress
        Called as progress(finished, all) whenever a task is finished.

    Raises
    ------
    FileExistsError
        If the folder belongs to another campaign.
    BlockingIOError
        If another process works in the folder.
    OSError
        If the scheduler is not there, or goes away.
    """
    store = Store(Path(folder))
    performed = _performed(workers, scheduler)
    with store.claimed(campaign):
        _complete(store, campaign.tasks(), performed, retry, progress or (lambda done, number: None))
        store.merge(campaign)
    return Survey(store.events, store.aggregates)


def _complete(store: Store, tasks: tuple[Task, ...], performed: Performed, retry: bool, tell: Progress) -> None:
    """Do the tasks that are not finished, and keep their results as they come."""
    for task in store.failed(task for task in tasks if store.has(task)) if retry else ():
        store.forget(task)
    missing = [task for task in tasks if not store.has(task)]
    finished = len(tasks) - len(missing)
    tell(finished, len(tasks))
    with closing(performed(missing)) as arriving:  # an interruption ends the workers at once
        for done, (task, results) in enumerate(arriving, finished + 1):
            store.keep(task, failed(task, results.reason) if isinstance(results, WorkerLost) else results)
            tell(done, len(tasks))


def _performed(workers: int | None, scheduler: str | None) -> Performed:
    """How tasks are performed: by processes of this machine, or by a cluster."""
    if scheduler is None:
        number = (os.cpu_count() or 1) if workers is None else _checks.whole_number("workers", workers, 1)
        return partial(local_pool.performed, perform, workers=number)
    if workers is not None:
        raise ValueError("workers: a cluster has workers of its own; leave out workers or the scheduler")
    return partial(cluster.performed, perform, scheduler=scheduler)
