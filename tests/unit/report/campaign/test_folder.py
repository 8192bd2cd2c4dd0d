"""A campaign is read back as it was written, done or not, or refused in one sentence."""

import json
import re
import shutil
import sys

import pytest

import rheoclast as rc
from rheoclast.report.campaign.folder import is_campaign, read_campaign_result

pq = pytest.importorskip("pyarrow.parquet")


def identified(events):
    """Events in an order of their own, whatever the order of the aggregates."""
    return sorted(events.to_pylist(), key=str)


def test_tables_are_those_of_the_campaign(surveyed):
    result = read_campaign_result(surveyed)
    written = pq.read_table(surveyed / "events.parquet")
    assert identified(result.events) == identified(written.select(result.events.column_names))
    assert result.done == result.asked == len(list((surveyed / "tasks").glob("*.parquet")))
    assert result.event == json.loads((surveyed / "campaign.json").read_text())["event"]


def test_unfinished_holds_what_is_done(surveyed, unfinished):
    folder, done = unfinished(surveyed)
    (folder / "tasks" / ".half-12345678.parquet").write_bytes(b"")
    (folder / "tasks" / "cut.parquet").write_bytes(b"PAR1")
    result, whole = read_campaign_result(folder), read_campaign_result(surveyed)
    assert result.done == len(done)
    assert identified(result.events) == identified(
        whole.events.filter([task in done for task in whole.events["task"].to_pylist()])
    )
    assert set(result.aggregates["task"].to_pylist()) == set(done)


@pytest.mark.parametrize("name", ["first_failures", "in_turbulence"])
def test_number_asked_for_is_that_of_the_tasks(name, request, unfinished):
    """Counted from the request alone, and by the campaign itself."""
    from rheoclast.campaigns import read_campaign

    folder = request.getfixturevalue(name)
    campaign = read_campaign(folder.parent / "campaign.toml")
    assert read_campaign_result(unfinished(folder, 0.3)[0]).asked == len(campaign.tasks())


def test_what_came_to_nothing(first_failures):
    """Two sizes, two dimensions, three seeds and two materials of a prefactor that is too large."""
    failures = read_campaign_result(first_failures).failures
    assert len(failures) == 2 * 2 * 3 * 2
    assert {family for family, _, _ in failures} == {"cluster-cluster"}
    assert all(
        '"prefactor":6.0' in parameters and "lower the prefactor" in reason for _, parameters, reason in failures
    )


def test_is_campaign(first_failures, stressed, tmp_path):
    assert is_campaign(first_failures)
    assert not is_campaign(stressed)
    assert not is_campaign(tmp_path / "none")


class TestRefusals:
    def test_nothing_done_yet(self, first_failures, unfinished):
        folder, _ = unfinished(first_failures, 0.0)
        with pytest.raises(FileNotFoundError, match="no aggregate of the campaign is done yet; make the page later"):
            read_campaign_result(folder)

    def test_without_pyarrow(self, first_failures, monkeypatch):
        monkeypatch.setitem(sys.modules, "pyarrow", None)
        with pytest.raises(ImportError, match=re.escape("needs the package pyarrow: pip install 'rheoclast[parquet]'")):
            read_campaign_result(first_failures)

    @pytest.mark.parametrize(
        ("text", "message"),
        [
            ("{", "campaign.json: expected JSON"),
            ("[]", "expected the request of a campaign, got one without event; start the campaign anew"),
            ('{"event": "breakup"}', "got one without families"),
        ],
    )
    def test_request(self, first_failures, copied, text, message):
        folder = copied(first_failures)
        (folder / "campaign.json").write_text(text)
        with pytest.raises(rc.FileFormatError, match=message):
            read_campaign_result(folder)

    def test_unknown_event(self, first_failures, copied):
        folder = copied(first_failures)
        path = folder / "campaign.json"
        path.write_text(path.read_text().replace('"first failure"', '"melting"'))
        with pytest.raises(rc.FileFormatError, match=r"expected one of first failure, breakup, history, got 'melting'"):
            read_campaign_result(folder)

    def test_tables_of_another_event(self, first_failures, breakups, copied):
        folder = copied(first_failures)
        shutil.copy(breakups / "events.parquet", folder / "events.parquet")
        with pytest.raises(rc.FileFormatError, match=r"events\.parquet: expected a column criterion, got none"):
            read_campaign_result(folder)

    def test_a_table_that_is_none(self, first_failures, copied):
        folder = copied(first_failures)
        (folder / "events.parquet").write_bytes(b"PAR1")
        with pytest.raises(rc.FileFormatError, match=r"events\.parquet: expected the table of a campaign"):
            read_campaign_result(folder)
