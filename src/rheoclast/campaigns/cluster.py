"""Work on the machines of a cluster, by the scheduler of dask.distributed."""

from __future__ import annotations

import logging
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from itertools import islice
from typing import Any, TypeVar

from rheoclast.campaigns.worker import WorkerLost

T = TypeVar("T")
R = TypeVar("R")

MOST = 10_000
"""Items at the scheduler at a time; enough that a cluster that grows with its load sees the load."""


def performed(
    function: Callable[[T], R], items: Iterable[T], scheduler: str
) -> Generator[tuple[T, R | WorkerLost], None, None]:
    """Each item with its result, as they come.

    The scheduler gives the items of a worker that dies to others, and gives up an item on which four died (its setting
    `allowed-failures`).

    Parameters
    ----------
    function, items
        Both can be pickled; the workers need Rheoclast too, the same version.
    scheduler
        Address, for instance tcp://10.0.0.1:8786.

    Raises
    ------
    ImportError
        If dask.distributed is not installed.
    OSError
        If the scheduler is not there, or goes away.
    """
    distributed = _distributed()
    waiting = iter(items)
    with _quiet(), distributed.Client(scheduler, set_as_default=False) as client:
        running: dict[Any, T] = {}

        def start(count: int) -> list[Any]:
            started = {client.submit(function, item, pure=False): item for item in islice(waiting, count)}
            running.update(started)
            return list(started)

        finished = distributed.as_completed(start(MOST), loop=client.loop)
        for future in finished:
            yield running.pop(future), _result(future, distributed.scheduler.KilledWorker)
            finished.update(start(1))


def _result(future: Any, killed: type[Exception]) -> Any:
    """Result of a task that is over."""
    if future.status in ("cancelled", "lost"):
        raise ConnectionError("the scheduler went away; start it anew, and run the same command again to go on")
    error = future.exception() if future.status == "error" else None
    if isinstance(error, killed):
        return WorkerLost("the processes that worked on it ended, one after the other")
    if error is not None:
        raise OSError(f"the cluster failed to work on a task: {error}; are its workers of the same version?") from error
    return future.result()


@contextmanager
def _quiet() -> Iterator[None]:
    """Leave out what the client logs when the scheduler goes away, as it is raised too."""
    logger = logging.getLogger("distributed.client")
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before


def _distributed() -> Any:
    try:
        return import_module("distributed")
    except ImportError:
        raise ImportError("a cluster needs the package distributed: pip install 'rheoclast[cluster]'") from None
