"""The page of a campaign: one small file, and in a real browser charts that show something and tables that sort."""

import json
import re
import shutil

import numpy as np
import pytest

from rheoclast.report import write_report

pq = pytest.importorskip("pyarrow.parquet")

CHARTS = "#charts figure"
POINT = re.compile(r"translate\((\S+) (\S+)\)")
WORDS_AS_NUMBERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")


def number(text):
    """Value of a text such as "1.316 × 10⁵"."""
    mantissa, _, power = text.strip().translate(WORDS_AS_NUMBERS).partition(" × 10")
    return float(mantissa) * 10.0 ** int(power or 0)


def cells(page, table, column):
    return page.locator("#tables .table").nth(table).locator(f"tbody td:nth-child({column + 1})").all_inner_texts()


def column_named(page, table, label):
    heads = page.locator("#tables .table").nth(table).locator("th button").all_inner_texts()
    return next(k for k, head in enumerate(heads) if head.startswith(label))


def test_is_small_and_refers_to_nothing_outside(surveyed, tmp_path):
    write_report(surveyed, tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert len(text) < 2e5
    assert "default-src 'none'" in text
    assert not re.search(r"<(link|img|iframe|object)\b|\b(src|href)=|url\(|@import|fetch\(|XMLHttpRequest", text)
    assert not re.search(r"\$[a-z]+\b", re.sub(r"<(script|style).*?</\1>", "", text, flags=re.DOTALL))


def test_default_place(first_failures, copied):
    folder = copied(first_failures)
    write_report(folder)
    with pytest.raises(FileExistsError, match="exists already"):
        write_report(folder)
    assert (folder / "report.html").stat().st_size > 1e4


def test_a_hundred_thousand_events_take_no_more_room_than_some(first_failures, tmp_path):
    """Aggregates multiplied a hundredfold, with names of their own."""
    folder = tmp_path / "many"
    folder.mkdir()
    shutil.copy(first_failures / "campaign.json", folder)
    for name in ("aggregates", "events"):
        table = pq.read_table(first_failures / f"{name}.parquet")
        place = table.column_names.index("task")
        copies = [
            table.set_column(place, "task", [[f"{k} {task}" for task in table["task"].to_pylist()]]) for k in range(270)
        ]
        with pq.ParquetWriter(folder / f"{name}.parquet", copies[0].schema) as writer:
            for each in copies:
                writer.write_table(each)
    assert pq.read_metadata(folder / "events.parquet").num_rows > 1e5
    write_report(folder)
    assert (folder / "report.html").stat().st_size < 3e5


@pytest.mark.parametrize(("width", "scheme"), [(400, "dark"), (1300, "light")])
def test_opens_at_any_width(opened, surveyed, overlapping_texts, width, scheme):
    """Charts of every condition show something, and no text of theirs covers another."""
    page = opened(surveyed, width, scheme, until=CHARTS)
    assert page.evaluate("document.scrollingElement.scrollWidth") <= width
    assert page.locator("#charts svg").count() >= 3
    for k in range(page.locator("#condition option").count()):
        page.select_option("#condition", str(k))
        for chart in page.locator("#charts svg").all():
            assert chart.locator("path.distribution, path.point").count() or "nothing" in chart.text_content()
        assert overlapping_texts(page) == []


def test_points_lie_where_their_values_are(opened, first_failures):
    """Median rates in the table, and the heights of the large points, which are logarithms of them."""
    page = opened(first_failures, 1300, until=CHARTS)
    condition = page.locator("#condition option").first.inner_text()
    names = [cells(page, 0, column_named(page, 0, label)) for label in ("Material", "Flow")]
    medians = [number(text) if text != "–" else None for text in cells(page, 0, column_named(page, 0, "Median"))]
    here = [
        rate
        for material, flow, rate in zip(*names, medians, strict=True)
        if rate and f"{material}, {flow}" == condition
    ]
    marks = page.locator("#charts figure").first.locator("path.point[stroke]")
    heights = [float(POINT.match(mark.get_attribute("transform"))[2]) for mark in marks.all()]
    told = [number(mark.text_content().rpartition(": ")[2]) for mark in marks.all()]
    assert sorted(told) == pytest.approx(sorted(here), rel=1e-3)
    slope, offset = np.polyfit(np.log(told), heights, 1)
    assert slope < 0
    np.testing.assert_allclose(slope * np.log(told) + offset, heights, atol=0.5)


def test_areas_below_distributions_are_shares(opened, first_failures):
    """Steps of equal width, in the order of the legend, as high as the shares that the data hold."""
    page = opened(first_failures, 1300, until=CHARTS)
    view = json.loads(page.locator("#data").text_content())["charts"][2]["views"][0]
    lines = page.locator("#charts figure").nth(2).locator("path.distribution")
    drawn = [share for share in view["shares"] if any(share)]
    assert lines.count() == len(drawn)
    for line, shares in zip(lines.all(), drawn, strict=True):
        heights = [float(y) for y in re.findall(r"V(\S+?)(?=H)", line.get_attribute("d"))]
        start = float(re.match(r"M\S+ (\S+?)V", line.get_attribute("d"))[1])
        rise = start - np.array(heights)
        np.testing.assert_allclose(rise / rise.sum(), np.array(shares) / sum(shares), atol=1e-6)


def test_a_condition_can_be_chosen(opened, first_failures):
    page = opened(first_failures, until=CHARTS)
    seen = set()
    for k in range(4):
        page.select_option("#condition", str(k))
        seen.add(page.locator("#charts").inner_html())
    assert len(seen) == 4


def test_tables_sort_and_what_is_missing_comes_last(opened, first_failures):
    page = opened(first_failures, 1300, until=CHARTS)
    column = column_named(page, 0, "Fractal")
    head = page.locator("#tables .table").first.locator("th").nth(column)
    for direction, sign in (("descending", -1), ("ascending", 1)):
        head.locator("button").click()
        assert head.get_attribute("aria-sort") == direction
        texts = cells(page, 0, column)
        known = [float(text) for text in texts if text != "–"]
        assert known == sorted(known, key=lambda value: sign * value)
        assert texts == [f"{value:g}" for value in known] + ["–"] * (len(texts) - len(known))
        assert 0 < len(known) < len(texts)


def test_reasons_are_told(opened, first_failures):
    page = opened(first_failures, until=CHARTS)
    assert "What came to nothing" in page.inner_text("#tables")
    assert "lower the prefactor" in page.inner_text("#tables")


def test_a_hostile_name_is_text(opened, campaign):
    evil = "</script><img src=x onerror=alert(1)>"
    folder = campaign(f"""
event = "first failure"
viscosity = 1e-3
radius = 1e-6
hydrodynamics = {{ model = "free-draining" }}
flows = [{{ name = "{evil}", gradient = [[1, 0, 0], [0, -1, 0], [0, 0, 0]] }}]
orientations = {{ number = 3 }}
materials = [{{ name = "{evil}", stiffness = [1, 1, 1, 1], pull_off = 1e-9 }}]
families = [{{ name = "straight-chain", count = 4 }}]
""")
    page = opened(folder, until=CHARTS)
    assert page.locator("img").count() == 0
    assert page.locator("#condition option").inner_text() == f"{evil}, {evil}"
    assert cells(page, 0, 1) == [evil]


def test_one_aggregate_is_drawn(opened, campaign, overlapping_texts):
    """Axes of one value, of a rate that some orientations do not have, and of a distance that is rounding."""
    folder = campaign("""
event = "first failure"
viscosity = 1e-3
radius = 1e-6
hydrodynamics = { model = "free-draining" }
flows = ["uniaxial"]
orientations = { number = 3 }
materials = ["polystyrene"]
families = [{ name = "straight-chain", count = 4 }]
""")
    page = opened(folder, 1300, until=CHARTS)
    assert page.locator("#charts figure").first.locator("path.point, path[stroke-width='1.6']").count() > 0
    assert page.locator("#charts path.distribution").count() == 2
    assert "NaN" not in page.locator("#charts").inner_html()
    assert overlapping_texts(page) == []


def test_printed_charts_fit_the_paper(opened, surveyed):
    """Charts are drawn for the screen and scaled on paper of another width."""
    page = opened(surveyed, 1300, until=CHARTS)
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 680, "height": 900})
    for chart in page.locator("#charts svg").all():
        width, inside = chart.evaluate(
            "(svg) => [svg.clientWidth, svg.querySelector('g').getBoundingClientRect().width]"
        )
        assert inside <= width * 1.02
