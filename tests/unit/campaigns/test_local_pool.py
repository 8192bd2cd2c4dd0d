"""Processes of this machine, and what becomes of the work when they die."""

import multiprocessing
import operator
import os
import time
from functools import partial

import psutil
import pytest

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns.local_pool import performed
from rheoclast.campaigns.worker import WorkerLost


def test_a_deadly_item_is_given_up_and_the_others_are_done():
    """Each item is called; one ends the process that calls it."""
    deadly = partial(os._exit, 1)
    items = [partial(abs, -1), deadly, partial(abs, -2), partial(abs, -3)]
    results = dict(performed(operator.call, items, workers=2))
    lost = results.pop(deadly)
    assert isinstance(lost, WorkerLost)
    assert lost.reason == "the process that worked on it ended 3 times"
    assert results == {item: k for k, item in zip((1, 2, 3), (items[0], *items[2:]), strict=True)}


def test_processes_end_when_results_are_no_longer_wanted():
    before = set(multiprocessing.active_children())
    results = performed(operator.call, [partial(abs, -1), partial(time.sleep, 60), partial(time.sleep, 60)], workers=2)
    assert next(results)[1] == 1
    # By psutil, since a child that another thread has just waited for counts as alive with multiprocessing.
    workers = [psutil.Process(child.pid) for child in set(multiprocessing.active_children()) - before]
    assert workers
    results.close()
    assert psutil.wait_procs(workers, timeout=20)[1] == []


def test_processes_that_cannot_start(monkeypatch):
    monkeypatch.setattr("rheoclast.campaigns.local_pool._begin", partial(os._exit, 1))
    with pytest.raises(OSError, match=r"processes end as soon as they start; .* __name__"):
        next(performed(operator.call, [partial(abs, -1)], workers=1))


def test_nothing_to_do():
    assert list(performed(operator.call, [], workers=2)) == []
