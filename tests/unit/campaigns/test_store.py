"""The folder of a campaign."""

import os

import numpy as np
import pytest

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

import msgspec
import pyarrow.parquet as pq

from rheoclast.campaigns.conditions import Hydrodynamics, Orientations
from rheoclast.campaigns.request import Campaign, Seeds
from rheoclast.campaigns.store import Store
from rheoclast.campaigns.task import failed, perform

CAMPAIGN = Campaign(
    viscosity=1e-3,
    radius=1e-6,
    flows=("shear", "uniaxial"),
    orientations=Orientations(3),
    materials=("polystyrene",),
    hydrodynamics=Hydrodynamics("free-draining"),
    families=({"name": "thinned-fcc-ball", "coordination": 4.0},),
    sizes=(12,),
    seeds=Seeds(4),
)
TASKS = CAMPAIGN.tasks()


@pytest.fixture
def store(tmp_path):
    store = Store(tmp_path / "out")
    with store.claimed(CAMPAIGN):
        yield store


def test_a_folder_belongs_to_one_campaign(tmp_path):
    for _ in range(2):
        with Store(tmp_path / "out").claimed(CAMPAIGN):
            pass
    other = msgspec.structs.replace(CAMPAIGN, seed=3)
    with (
        pytest.raises(FileExistsError, match=r"belongs to another campaign .* choose another folder"),
        Store(tmp_path / "out").claimed(other),
    ):
        pass


def test_one_process_at_a_time(store):
    with (
        pytest.raises(BlockingIOError, match=r"out: another process works in this folder; wait until it ends, or"),
        Store(store.folder).claimed(CAMPAIGN),
    ):
        pass


def test_a_folder_with_other_things_is_refused(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with (
        pytest.raises(FileExistsError, match=r"expected a new or empty folder, got one with thesis\.tex"),
        Store(tmp_path).claimed(CAMPAIGN),
    ):
        pass
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_a_task_is_there_when_it_is_whole(store, monkeypatch):
    monkeypatch.setattr("os.replace", lambda *names: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        store.keep(TASKS[0], perform(TASKS[0]))
    assert not store.has(TASKS[0])
    monkeypatch.undo()
    store.keep(TASKS[0], perform(TASKS[0]))
    assert store.has(TASKS[0])
    assert len(list((store.folder / "tasks").iterdir())) == 1
    store.forget(TASKS[0])
    assert not store.has(TASKS[0])


@pytest.mark.parametrize("content", [b"", b"PAR1", bytes(4000)])
def test_a_file_that_cannot_be_read_is_done_again(store, content):
    store.keep(TASKS[0], failed(TASKS[0], "no luck"))
    (path,) = (store.folder / "tasks").iterdir()
    path.write_bytes(content)
    assert not store.has(TASKS[0])
    store.keep(TASKS[0], failed(TASKS[0], "no luck"))
    assert store.failed([TASKS[0]]) == [TASKS[0]]


def test_two_that_write_the_same_task_do_not_meet(store, monkeypatch):
    """While one is about to rename its file, another writes the whole of it."""
    replace, results = os.replace, perform(TASKS[0])

    def second_first(*names):
        monkeypatch.setattr("os.replace", replace)
        store.keep(TASKS[0], results)
        replace(*names)

    monkeypatch.setattr("os.replace", second_first)
    store.keep(TASKS[0], results)
    assert store.has(TASKS[0])
    assert len(list((store.folder / "tasks").iterdir())) == 1


@pytest.mark.parametrize("together", [1, 10, 1000])
def test_merged_in_the_order_of_the_campaign(store, monkeypatch, together):
    """However the tasks came, and however many rows are written together."""
    monkeypatch.setattr("rheoclast.campaigns.store.ROWS_TOGETHER", together)
    for task in reversed(TASKS):
        store.keep(task, failed(task, "no luck") if task is TASKS[1] else perform(task))
    assert store.failed(TASKS) == [TASKS[1]]
    store.merge(CAMPAIGN)
    aggregates, events = pq.read_table(store.aggregates), pq.read_table(store.events)
    assert aggregates["task"].to_pylist() == [task.digest for task in TASKS]
    assert aggregates["failure"].to_pylist() == [None, "no luck", None, None]
    done = [task for task in TASKS if task is not TASKS[1]]
    assert events["task"].to_pylist() == [task.digest for task in done for _ in range(6)]
    assert events["seed"].to_pylist() == [task.seed for task in done for _ in range(6)]
    assert events["flow"].to_pylist() == (["shear"] * 3 + ["uniaxial"] * 3) * 3
    listed = [event for task in done for event in perform(task)["events"][0].as_py()]
    np.testing.assert_array_equal(events["contact"].to_pylist(), [event["contact"] for event in listed])


def test_all_failed_leaves_an_empty_table_of_events(store):
    for task in TASKS:
        store.keep(task, failed(task, "no luck"))
    store.merge(CAMPAIGN)
    events = pq.read_table(store.events)
    assert events.num_rows == 0
    assert "initiation_rate_per_s" in events.column_names
