"""What becomes of a task at a cluster; `test_campaign_interruption` has a real one."""

import operator
import sys
from types import SimpleNamespace

import pytest

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns import cluster
from rheoclast.campaigns.worker import WorkerLost


class Killed(Exception):  # noqa: N818 - in place of one that is so called
    """All workers that had the task have died."""


def future(status, result=None, error=None):
    return SimpleNamespace(status=status, result=lambda: result, exception=lambda: error)


def test_a_finished_task_has_a_result():
    assert cluster._result(future("finished", 3), Killed) == 3


def test_a_task_that_ends_its_workers_is_given_up():
    assert isinstance(cluster._result(future("error", error=Killed()), Killed), WorkerLost)


@pytest.mark.parametrize("status", ["cancelled", "lost"])
def test_a_scheduler_that_goes_away(status):
    with pytest.raises(ConnectionError, match=r"the scheduler went away; .* run the same command again"):
        cluster._result(future(status), Killed)


def test_workers_that_cannot_work():
    with pytest.raises(OSError, match=r"failed to work on a task: No module named 'rheoclast'; .* same version"):
        cluster._result(future("error", error=ImportError("No module named 'rheoclast'")), Killed)


def test_without_the_package(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r"pip install 'rheoclast\[cluster\]'"):
        next(cluster.performed(operator.call, [], "tcp://127.0.0.1:1"))
