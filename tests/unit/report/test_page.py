"""The page is one file with everything inside."""

import json
import re
from html.parser import HTMLParser

import pytest

import rheoclast as rc
from rheoclast.report import write_report


class Page(HTMLParser):
    """Elements of a page, and the text inside of them."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.texts, self.open = [], {}, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self.open.append(dict(attributes).get("id") or tag)

    def handle_data(self, data):
        if self.open:
            self.texts[self.open[-1]] = self.texts.get(self.open[-1], "") + data


def read(path):
    return Page(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", ["stressed", "broken"])
def test_refers_to_nothing_outside(name, request, tmp_path):
    write_report(request.getfixturevalue(name), tmp_path / "page.html")
    for tag, attributes in read(tmp_path / "page.html").elements:
        assert tag not in ("link", "img", "iframe", "object")
        assert not {"src", "href"} & set(attributes)
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert not re.search(r"url\(|@import|\bimport\b.*\bfrom\b|fetch\(|XMLHttpRequest", text)
    assert "default-src 'none'" in text


def test_placeholders_are_filled(stressed, tmp_path):
    write_report(stressed, tmp_path / "page.html")
    page = read(tmp_path / "page.html")
    assert page.texts["title"].strip() == "floc.dat – Contact loads"
    assert len(json.loads(page.texts["data"])["tables"]["contacts"]["rows"]["i"]) == 5
    assert not re.search(
        r"\$[a-z]+\b", "".join(text for name, text in page.texts.items() if name not in ("script", "style"))
    )


def test_words_of_the_results_are_text(broken, copied, tmp_path):
    """Whatever a name or a word holds, it ends no element and starts none."""
    folder = copied(broken)
    evil = '</script><script>alert(1)</script><b title="x">&amp;'
    told = json.loads((folder / "summary.json").read_text())
    (folder / "summary.json").write_text(json.dumps(told | {"file": evil, "criterion": evil}))
    table = (folder / "failures.csv").read_text()
    (folder / "failures.csv").write_text(table.replace("tension", "</script><!--<script>", 1))
    write_report(folder, tmp_path / "page.html")
    page = read(tmp_path / "page.html")
    assert [tag for tag, _ in page.elements].count("script") == 2
    assert "b" not in [tag for tag, _ in page.elements]
    assert "</script><!--<script>" in json.loads(page.texts["data"])["tables"]["failures"]["rows"]["criterion"]


def test_size_of_a_thousand_spheres(results, tmp_path):
    """A block of 1000 spheres with 2700 contacts."""
    block = rc.generation.lattice_block("sc", (10, 10, 10), radius=0.5e-6)
    write_report(results("stress", block, "--model", "free-draining"), tmp_path / "page.html")
    assert (tmp_path / "page.html").stat().st_size < 2e6


def test_default_place_and_overwriting(stressed, copied):
    folder = copied(stressed)
    write_report(folder)
    with pytest.raises(FileExistsError, match="exists already"):
        write_report(folder)
    write_report(folder, overwrite=True)
    assert (folder / "report.html").stat().st_size > 1e4


def test_nothing_is_written_when_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="expected the results of stress, break or survey"):
        write_report(tmp_path, tmp_path / "page.html")
    assert not list(tmp_path.iterdir())
