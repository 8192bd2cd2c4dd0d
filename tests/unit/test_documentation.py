"""The documentation: its links lead somewhere, its equations have names, its reference is whole."""

import inspect
import re
from pathlib import Path

import pytest

import rheoclast as rc
from rheoclast import generation, view

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
GENERATED = ("_build", "_examples", "gallery", "validation")
PAGES = {
    page.relative_to(DOCS).as_posix(): page.read_text(encoding="utf-8")
    for page in sorted(DOCS.rglob("*.md"))
    if page.relative_to(DOCS).parts[0] not in GENERATED
}
PAGES["../CONTRIBUTING.md"] = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere(name):
    """Relative links, pictures and tables of contents; pages that are built from elsewhere count by their source."""
    text = re.sub(r"^ *```python\n.*?^ *```\n", "", PAGES[name], flags=re.S | re.M)
    here = (DOCS / name).parent
    for target, anchor in re.findall(r"\]\(([^)#:\s]*)(?:#([^)\s]*))?\)", text):
        page = (here / target).resolve() if target else (DOCS / name).resolve()
        assert source_of(page).exists(), target
        if anchor:
            assert anchor in anchors(page.read_text(encoding="utf-8")), f"{target}#{anchor}"
    for entries in re.findall(r"```\{toctree\}\n((?:[^`]|`(?!``))*)```", text):
        for entry in re.findall(r"^([\w/]+)$", entries, re.M):
            assert source_of((here / f"{entry}.md").resolve()).exists() or entry == "gallery/index", entry


def source_of(page):
    """What a page is made from."""
    folder = page.relative_to(DOCS).parts[0] if page.is_relative_to(DOCS) else ""
    if folder == "validation":
        return ROOT / "validation" / page.stem / "README.md"
    if folder == "gallery":
        return DOCS / "gallery_header.rst" if page.stem == "index" else ROOT / "examples" / f"{page.stem}.py"
    return page


def anchors(text):
    """Names of labels, and of headings up to the third level as MyST makes them."""
    headings = re.findall(r"^#{1,3} (.*)$", text, re.M)
    slugs = {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}
    return slugs | set(re.findall(r"^\((.*)\)=$", text, re.M))


def test_equations_are_labelled_once_and_every_citation_has_its_equation():
    whole = "\n".join(PAGES.values())
    labels = re.findall(r"^\$\$ \(([\w-]+)\)$", whole, re.M)
    assert len(labels) == len(set(labels))
    sources = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.py"))
    cited = re.findall(r"\{eq\}`([\w-]+)`", whole) + re.findall(r":eq:`([\w-]+)`", sources)
    assert cited
    assert set(cited) <= set(labels)


def test_order_of_the_gallery_names_examples():
    ordered = re.search(r"FROM_EASY_TO_HARD = \((.*?)\n\)", (DOCS / "conf.py").read_text(encoding="utf-8"), re.S)[1]
    named = re.findall(r'"(\w+\.py)"', ordered)
    assert named
    assert set(named) <= {path.name for path in (ROOT / "examples").glob("*.py")}


def documented(page):
    return re.findall(r"^\.\. (?:auto\w+|data):: (?:[\w.]+\.)?(\w+)$", PAGES[f"reference/{page}.md"], re.M)


def test_every_public_name_is_in_the_reference_once():
    pages = [name.removeprefix("reference/")[:-3] for name in PAGES if name.startswith("reference/")]
    apart = {"generation", "view", "vectors"}
    found = [name for page in pages if page not in apart for name in documented(page)]
    modules = {name for name in rc.__all__ if inspect.ismodule(getattr(rc, name))}
    assert sorted(found) == sorted(set(rc.__all__) - modules | set(rc.turbulence.__all__))
    assert sorted(documented("generation")) == sorted(generation.__all__)
    assert sorted(documented("view")) == sorted(view.__all__)


@pytest.mark.parametrize("name", [name for name in PAGES if name.startswith("reference/") and "index" not in name])
def test_overview_of_a_reference_page_lists_what_is_on_it(name):
    overview = re.search(r"\.\. autosummary::\n +:nosignatures:\n\n((?: +[\w.~]+\n)+)", PAGES[name])
    listed = [entry.split(".")[-1] for entry in overview.group(1).split()]
    assert [each for each in documented(name.removeprefix("reference/")[:-3]) if each != "STRAIN_BASIS"] == listed
