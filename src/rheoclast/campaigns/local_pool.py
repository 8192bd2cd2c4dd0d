"""Work on the cores of this machine, in processes of which any may be killed."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import Counter, deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import TypeVar

from rheoclast.campaigns.worker import WorkerLost

T = TypeVar("T")
R = TypeVar("R")

DEATHS = 3
AHEAD = 2
"""Items that a worker has, with the one that it is working on: it need not wait for the next."""

NO_START = (
    "workers: processes end as soon as they start; if a script of yours calls this, put the call below "
    'if __name__ == "__main__":, otherwise see that there is memory for them'
)


def performed(
    function: Callable[[T], R], items: Iterable[T], workers: int
) -> Generator[tuple[T, R | WorkerLost], None, None]:
    """Each item with its result, as they come.

    When a worker dies, the pool cannot tell which item it was working on: those that may have been are tried again one
    by one, each alone. An item in whose company workers died three times is given up.

    Parameters
    ----------
    function, items
        Both can be pickled.
    workers
        Number of processes.

    Raises
    ------
    OSError
        If processes end as soon as they start.
    """
    waiting, suspects = deque(items), deque[T]()
    deaths: Counter[int] = Counter()
    while waiting or suspects:
        if suspects:
            lost = yield from _until_broken(function, suspects, workers=1, most=1)
        else:
            lost = yield from _until_broken(function, waiting, workers, most=AHEAD * workers)
        for item in lost:
            deaths[id(item)] += 1
            if deaths[id(item)] < DEATHS:
                suspects.append(item)
            else:
                yield item, WorkerLost(f"the process that worked on it ended {DEATHS} times")


def _until_broken(
    function: Callable[[T], R], items: deque[T], workers: int, most: int
) -> Generator[tuple[T, R | WorkerLost], None, list[T]]:
    """Results of one pool with at most `most` items at a time; returns those that were lost when a worker died."""
    running: dict[Future[R], T] = {}
    with _pool(min(workers, len(items))) as pool:
        start = _submitted(pool, abs, 0)
        while items or running:
            try:
                while items and len(running) < most:
                    running[_submitted(pool, function, items[0])] = items[0]
                    items.popleft()
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    result = future.result()
                    yield running.pop(future), result
            except BrokenProcessPool:
                if start.exception():
                    raise OSError(NO_START) from None
                break
    for future in [each for each in running if not each.exception()]:
        yield running.pop(future), future.result()
    return list(running.values())


def _submitted(pool: ProcessPoolExecutor, function: Callable[[T], R], item: T) -> Future[R]:
    """The result to come. An interruption from the keyboard waits: a process that starts here never hears of one."""
    if not hasattr(signal, "pthread_sigmask"):
        return pool.submit(function, item)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        return pool.submit(function, item)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of processes that end with it at once if it is left early, and with this process whatever happens."""
    others = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"), initializer=_begin)
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in set(multiprocessing.active_children()) - others:
            process.terminate()
        raise
    pool.shutdown()


def _begin() -> None:
    """In a new worker: leave interruptions to the parent, and end when it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)
