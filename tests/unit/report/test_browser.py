"""The page in a real browser: it draws, turns, picks, colours, steps and sorts, from a file and without a network."""

import base64
import csv
import io
import re
from itertools import combinations

import numpy as np
import pytest
from PIL import Image

import rheoclast as rc
from rheoclast.view.projection import view_axes

sync_api = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")

WITHOUT_WEBGL = """
const original = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind === "webgl2" ? null : original.call(this, kind, ...rest);
};
"""
PREFIXES = {"a": 1e-18, "f": 1e-15, "p": 1e-12, "n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0}
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
LOADS = {"tension": "tension_N", "shear": "shear_N", "bending": "bending_Nm", "load_ratio": "load_ratio"}


def picture(page):
    """The canvas (H, W, 3), in its own resolution, from 0 to 255."""
    page.evaluate("new Promise(requestAnimationFrame)")
    data = page.evaluate("document.getElementById('scene').toDataURL().split(',')[1]")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)


def covered(page):
    """Where the canvas differs from its upper left corner."""
    shown = picture(page)
    return np.abs(shown - shown[0, 0]).sum(axis=2) > 12


def move(page, control, value):
    """Set a slider as a user does."""
    page.locator(control).evaluate(
        "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }", str(value)
    )


def pixels(page, points):
    """Where points (P, 3) in m from the centre of mass are on the canvas (P, 2), as first seen.

    Only differences count: the scale is that of the scale bar.
    """
    bar = page.locator("#scale-bar")
    scale = float(bar.get_attribute("data-pixels")) / float(bar.get_attribute("data-length"))
    return scale * points * [1, -1]


def frame(page, folder):
    """Projected centres (N, 2), radii (N,) and contact points (C, 2) in pixels of the canvas.

    The silhouette of the spheres at full size fixes the place, so nothing is taken from the script.
    """
    aggregate = rc.read(folder / "spheres.csv", contacts=folder / "contacts.csv")
    axes = view_axes(aggregate.spheres)[:2]
    centers = pixels(page, aggregate.spheres.centers @ axes.T)
    radii = np.abs(pixels(page, np.ones((len(centers), 2)) * aggregate.spheres.radii[:, None])[:, 0])
    rows, columns = np.nonzero(covered(page))
    ratio = picture(page).shape[1] / page.locator("#scene").bounding_box()["width"]
    corner = np.array([columns.min(), rows.min()]) / ratio
    shift = corner - (centers - radii[:, None]).min(axis=0)
    far = np.array([columns.max() + 1, rows.max() + 1]) / ratio
    np.testing.assert_allclose((centers + radii[:, None]).max(axis=0) + shift, far, atol=1.5)
    return centers + shift, radii, pixels(page, aggregate.contact_points @ axes.T) + shift


def in_si(text):
    """Value of a text such as "−1.276 ± 0.033 nN"."""
    value, mantissa_unit = re.match(r"(\S+(?: × 10\S+)?)(?: ± \S+(?: × 10\S+)?)?(.*)", text).groups()
    number, _, power = value.replace("−", "-").partition(" × 10")
    unit = mantissa_unit.strip()
    prefix = unit[:-3] if unit.endswith("N m") else unit[:-1]
    return float(number) * 10.0 ** int(power.translate(SUPERSCRIPTS) or 0) * PREFIXES[prefix]


def table(folder, name):
    with (folder / name).open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize(("width", "scheme"), [(400, "dark"), (900, "light"), (2000, "dark")])
@pytest.mark.parametrize("name", ["stressed", "broken"])
def test_opens_at_any_width(opened, request, overlapping_texts, name, width, scheme):
    page = opened(request.getfixturevalue(name), width, scheme)
    assert page.evaluate("document.scrollingElement.scrollWidth") <= width
    shown = picture(page)
    assert 0.03 < covered(page).mean() < 0.9
    assert len(np.unique(shown @ [65536, 256, 1])) > 100
    assert (shown[0, 0].mean() > 128) == (scheme == "light")
    assert page.locator("#charts svg").count() >= 2
    assert page.locator("#charts .dot").count() >= 5
    assert overlapping_texts(page) == []


def test_shows_spheres_where_they_are(opened, stressed):
    """Covered are the discs of the spheres and the necks that contacts fill, and nothing else."""
    page = opened(stressed)
    move(page, "#size", 1)
    centers, radii, contacts = frame(page, stressed)
    pairs = rc.read(stressed / "spheres.csv", contacts=stressed / "contacts.csv").pairs
    mask = covered(page)
    ratio = mask.shape[1] / page.locator("#scene").bounding_box()["width"]
    y, x = (np.indices(mask.shape) + 0.5) / ratio

    def discs(points, radii):
        return np.any([(x - px) ** 2 + (y - py) ** 2 < r**2 for (px, py), r in zip(points, radii, strict=True)], axis=0)

    spheres, necks = discs(centers, radii), discs(contacts, 0.6 * radii[pairs].min(axis=1))
    assert (spheres & ~mask).sum() < 0.005 * spheres.sum()
    assert (mask & ~spheres & ~necks).sum() < 0.005 * spheres.sum()


@pytest.mark.parametrize("script", [None, WITHOUT_WEBGL], ids=["webgl", "canvas"])
def test_picking_shows_the_loads_of_the_contact(opened, stressed, script):
    page = opened(stressed, script=script)
    move(page, "#size", 1)
    _, _, contacts = frame(page, stressed)
    for number, row in enumerate(table(stressed, "contacts.csv")):
        page.click("#scene", position={"x": contacts[number, 0], "y": contacts[number, 1]})
        assert page.input_value("#number") == str(number)
        assert f"spheres {row['i']} and {row['j']}," in page.inner_text("#selected")
        for load, column in LOADS.items():
            shown = in_si(page.inner_text(f"[data-load={load}]"))
            assert shown == pytest.approx(float(row[column]), rel=6e-4), load
        ring = page.locator("#ring")
        found = [float(ring.get_attribute(name)) for name in ("cx", "cy")]
        np.testing.assert_allclose(found, contacts[number], atol=1.5)


def test_picking_a_sphere_takes_its_nearest_contact(opened, stressed):
    page = opened(stressed)
    move(page, "#size", 1)
    centers, _, contacts = frame(page, stressed)
    for number in (0, 1):
        x, y = 0.4 * centers[1] + 0.6 * contacts[number]
        page.click("#scene", position={"x": x, "y": y})
        assert page.input_value("#number") == str(number)


def test_a_click_beside_the_spheres_chooses_nothing(opened, stressed):
    page = opened(stressed)
    before = page.inner_text("#selected")
    page.click("#scene", position={"x": 8, "y": 8})
    assert page.inner_text("#selected") == before


def test_colours_of_contacts(opened, broken):
    """Pulled ones are red, compressed ones blue, and every load looks different."""
    page = opened(broken)
    seen = {}
    for load in ("tension", "shear", "bending", "twisting", "load_ratio"):
        page.select_option("#load", load)
        seen[load] = picture(page)
    keys = list(seen)
    for k, load in enumerate(keys):
        for other in keys[k + 1 :]:
            assert (np.abs(seen[load] - seen[other]).sum(axis=2) > 30).mean() > 0.001
    redness = seen["tension"][..., 0] - seen["tension"][..., 2]
    assert redness.max() > 60
    assert redness.min() < -60


def test_colour_at_a_contact_is_that_of_its_tension(opened, stressed, results):
    """Along the stretching axis of an extension a chain is pulled, across it pressed."""
    chain = "0 0 0 1\n2 0 0 1\n4 0 0 1\n6 0 0 1\n"
    for flow, sign in (("biaxial", 1), ("uniaxial", -1)):
        folder = results("stress", chain, "--unit", "um", "--flow", flow)
        page = opened(folder)
        move(page, "#size", 1)
        _, _, contacts = frame(page, folder)
        shown = picture(page)
        ratio = shown.shape[1] / page.locator("#scene").bounding_box()["width"]
        column, row = (contacts[1] * ratio).astype(int)
        red, _, blue = shown[row, column]
        assert sign * (red - blue) > 60
        assert min(float(each["tension_N"]) * sign for each in table(folder, "contacts.csv")) > 0


def test_legend_has_unit_and_limits(opened, broken):
    page = opened(broken)
    page.select_option("#load", "bending")
    assert re.search(r"Bending \([afpnµm]N m\)", page.inner_text("#legend"))
    page.select_option("#load", "load_ratio")
    assert page.inner_text("#legend").split("\n")[0] == "Load / strength"
    assert page.locator("#charts figcaption").first.inner_text() == "Load / strength: distribution over contacts"


def test_turning_zooming_and_back(opened, stressed):
    page = opened(stressed)
    first = picture(page)
    page.locator("#scene").scroll_into_view_if_needed()
    box = page.locator("#scene").bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 380, box["y"] + 260, steps=4)
    page.mouse.up()
    turned = picture(page)
    assert (turned != first).any(axis=2).mean() > 0.02
    page.focus("#scene")
    page.keyboard.press("ArrowLeft")
    assert (picture(page) != turned).any()
    size = covered(page).mean()
    page.keyboard.press("+")
    assert covered(page).mean() == pytest.approx(1.44 * size, rel=0.1)
    page.keyboard.press("0")
    np.testing.assert_array_equal(picture(page), first)


def test_stepping_through_the_crack(opened, broken):
    page = opened(broken)
    failures = table(broken, "failures.csv")
    before = picture(page)
    for k, failure in enumerate(failures):
        page.click("#forth")
        text = page.inner_text("#step-text")
        assert text.startswith(f"failure {k + 1} of {len(failures)}: contact {failure['contact']}, at ")
        assert text.endswith(f"by {failure['criterion']}")
        assert page.input_value("#number") == failure["contact"]
    after = picture(page)
    assert (np.abs(after - before).sum(axis=2) > 30).mean() > 0.005
    move(page, "#parting", 1)
    parted = picture(page)
    assert (np.abs(parted - after).sum(axis=2) > 30).mean() > 0.005
    page.click("#back")
    assert page.input_value("#step") == str(len(failures) - 1)
    assert page.input_value("#parting") == "0"
    move(page, "#step", 0)
    assert page.inner_text("#step-text") == f"whole; {len(failures)} contacts will fail"


def test_playing_the_crack(opened, broken):
    page = opened(broken)
    page.click("#play")
    assert page.inner_text("#play") == "Pause"
    sync_api.expect(page.locator("#play")).to_have_text("Play", timeout=30_000)
    assert page.input_value("#step") == page.get_attribute("#step", "max")
    assert float(page.input_value("#parting")) == 1


def test_fragments_keep_in_sight_as_they_part(opened, broken):
    """No covered pixel lies on the rim of the canvas."""
    page = opened(broken)
    move(page, "#step", page.get_attribute("#step", "max"))
    move(page, "#parting", 1)
    mask = covered(page)
    assert not any(rim.any() for rim in (mask[0], mask[-1], mask[:, 0], mask[:, -1]))


def test_order_of_failure(opened, broken):
    page = opened(broken)
    plain = picture(page)
    page.select_option("#load", "order")
    assert (np.abs(picture(page) - plain).sum(axis=2) > 30).mean() > 0.005
    assert page.inner_text("#legend").startswith("Order of failure")


def test_tables_sort(opened, broken):
    page = opened(broken)
    contacts = table(broken, "contacts.csv")
    by_shear = sorted(range(len(contacts)), key=lambda k: -float(contacts[k]["shear_N"]))
    head = page.locator("#tables th[data-key=shear]").first
    cells = page.locator("#tables .table").first.locator("tbody td:first-child")
    head.locator("button").click()
    assert head.get_attribute("aria-sort") == "descending"
    assert [int(text) for text in cells.all_inner_texts()] == by_shear
    head.locator("button").click()
    assert head.get_attribute("aria-sort") == "ascending"
    assert [int(text) for text in cells.all_inner_texts()] == by_shear[::-1]


def test_rows_and_dots_choose_contacts(opened, broken):
    page = opened(broken)
    page.locator("#tables tbody tr").nth(3).locator("button").focus()
    page.keyboard.press("Enter")
    chosen = page.locator("#tables tbody tr").nth(3)
    assert page.input_value("#number") == chosen.locator("td").first.inner_text()
    assert "chosen" in chosen.get_attribute("class")
    dot = page.locator("#charts figure").nth(1).locator(".dot").nth(7)
    dot.dispatch_event("click")
    assert page.input_value("#number") == dot.get_attribute("data-contact")
    page.fill("#number", "2")
    page.keyboard.press("Enter")
    assert f"spheres {table(broken, 'contacts.csv')[2]['i']} and" in page.inner_text("#selected")


def test_histogram_counts_every_contact(opened, broken):
    page = opened(broken)
    titles = (
        page.locator("#charts figure")
        .first.locator(".bar title")
        .evaluate_all("all => all.map((each) => each.textContent)")
    )
    assert sum(int(title.split()[0]) for title in titles) == len(table(broken, "contacts.csv"))


def test_long_tables_show_some_hundreds_of_rows(opened, results):
    chain = rc.generation.straight_chain(400, radius=0.5e-6)
    page = opened(results("stress", chain, "--model", "free-draining"))
    body = page.locator("#tables tbody").first
    assert body.locator("tr").count() == 300
    assert "first 300 of 399 rows" in page.inner_text("#tables")
    page.click("text=Show 300 more")
    assert body.locator("tr").count() == 399


def test_a_hostile_name_is_text(opened, stressed, copied):
    folder = copied(stressed)
    text = (folder / "summary.json").read_text().replace("floc.dat", "<img src=x onerror=alert(1)>.dat")
    (folder / "summary.json").write_text(text)
    page = opened(folder)
    assert page.inner_text("h1") == "<img src=x onerror=alert(1)>.dat"


def test_contacts_too_small_to_be_seen_colour_their_spheres(opened, results):
    """A long chain in an extension: red in the middle, pale at the ends; and picking works."""
    chain = rc.generation.straight_chain(2100, radius=0.5e-6)
    page = opened(results("stress", chain, "--model", "free-draining", "--flow", "biaxial"), width=1300)
    assert "each sphere as its most loaded contact" in page.inner_text("#legend")
    shown, mask = picture(page), covered(page)
    redness = shown[..., 0] - shown[..., 2]
    columns = np.flatnonzero(mask.any(axis=0))
    if np.ptp(columns) < np.ptp(np.flatnonzero(mask.any(axis=1))):
        redness, columns = redness.T, np.flatnonzero(mask.any(axis=1))
    middle, end = columns[len(columns) // 2], columns[5]
    assert redness[:, middle].max() > 100 > 40 > redness[:, end].max()
    dots = page.locator("#charts figure").nth(1).locator(".dot")
    assert 100 < dots.count() < 2099


@pytest.fixture(scope="module")
def cascaded(results):
    cluster = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    return results("break", cluster, "--rate", 1e7, "--cascade")


def test_who_broke_into_whom(opened, cascaded):
    """Every piece is as high as its number of spheres, and lies on the right of the one it came from."""
    page = opened(cascaded)
    pieces = table(cascaded, "pieces.csv")
    blocks = {}
    for block in page.locator("#charts .piece rect").all():
        number = re.match(r"piece (\d+), ", block.text_content())[1]
        blocks[int(number)] = [float(block.get_attribute(name)) for name in ("x", "y", "width", "height")]
    assert len(blocks) == len(pieces) > 3
    pixel = blocks[0][3] / len(pieces and rc.read(cascaded / "spheres.csv").spheres)
    for k, piece in enumerate(pieces):
        x, y, _, height = blocks[k]
        assert height == pytest.approx(pixel * int(piece["spheres"]), abs=1.5)
        if k:
            left, top, _, high = blocks[int(piece["parent"])]
            assert x > left
            assert top - 1.5 <= y
            assert y + height <= top + high + 1.5
    for one, other in combinations(range(len(pieces)), 2):
        if pieces[one]["generation"] == pieces[other]["generation"]:
            (_, above, _, high), (_, below, *_) = sorted([blocks[one], blocks[other]], key=lambda block: block[1])
            assert above + high <= below + 0.01
    breaking = page.locator("#charts .piece.breaks").count()
    assert breaking == sum(piece["holds"] == "0" for piece in pieces)


def test_a_doublet_has_no_charts(opened, results):
    page = opened(results("stress", "0 0 0 1\n2 0 0 1\n", "--unit", "um"))
    assert page.locator("#charts figure").count() == 0


def test_printed_view_is_not_distorted(opened, stressed):
    """What stands beside the spheres is scaled as the picture is."""
    page = opened(stressed, width=1300)
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 680, "height": 900})
    assert page.locator("#scene").evaluate("(canvas) => getComputedStyle(canvas).objectFit") == "contain"
    canvas = page.locator("#scene").evaluate("(canvas) => canvas.width / canvas.height")
    box = [float(each) for each in page.get_attribute("#overlay", "viewBox").split()[2:]]
    assert canvas == pytest.approx(box[0] / box[1], rel=0.01)
