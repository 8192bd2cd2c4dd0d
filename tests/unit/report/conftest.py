"""Results as the command line leaves them, made once for all tests of the page."""

import csv
import os
import shutil

import pytest

import rheoclast as rc
from rheoclast.cli import main
from rheoclast.report import write_report

BENT_CHAIN = (
    "0 0 0 1\n2 0 0 1\n4 0 0 1\n5.4 1.4282856857085699 0 1\n7.4 1.4282856857085699 0 1\n7.4 2.9282856857085699 0 .5\n"
)
NAMES = ("chromium", "chromium-browser", "google-chrome")
BROWSER = os.environ.get("RHEOCLAST_BROWSER") or next(filter(None, map(shutil.which, NAMES)), None)
ARGUMENTS = (
    *("--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic"),
    *("--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"),
)
CAMPAIGN = """
event = "{event}"
viscosity = 1e-3
radius = 1e-6
hydrodynamics = {{ model = "free-draining" }}
"""
IN_FLOWS = """
sizes = [12, 20]
seeds = { number = 3 }
flows = ["shear", "uniaxial"]
materials = ["polystyrene", { name = "weak", stiffness = [1, 1, 1, 1], pull_off = 2e-10 }]
families = [
    { name = "cluster-cluster", fractal_dimension = [1.8, 2.9], prefactor = [1.3, 6.0] },
    { name = "straight-chain", count = 5 },
    { name = "lattice-block", lattice = "sc", counts = [[2, 2, 2], [3, 2, 2]] },
]
"""
IN_TURBULENCE = """
sizes = [12]
seeds = { number = 3 }
materials = [{ name = "weak", stiffness = [1, 1, 1, 1], pull_off = 2e-10 }]
families = [{ name = "cluster-cluster" }, { name = "straight-chain" }]

[histories]
model = "gaussian"
number = 6
duration = 5
dissipations = [1e-3, 3, 30]
density = 1e3
"""

OVERLAPPING = """
(charts) => charts.flatMap((chart) => {
  const boxes = [...chart.querySelectorAll("g > text")].map((text) => [text.textContent, text.getBoundingClientRect()]);
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  const others = ([text, box], k) => boxes.slice(k + 1).filter(([, other]) => meet(box, other));
  return boxes.flatMap((one, k) => others(one, k).map(([text]) => `${one[0]} and ${text}`));
})
"""


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    """Run a command with some arguments on an aggregate; returns the folder with its results."""

    def results(command, aggregate, *arguments):
        folder = tmp_path_factory.mktemp(command)
        file = folder / "floc.dat"
        if isinstance(aggregate, str):
            file.write_text(aggregate)
        else:
            rc.write(file, aggregate)
        with pytest.raises(SystemExit) as stop:
            main([command, str(file), *map(str, arguments), "--output", str(folder / "out")])
        assert not stop.value.code
        return folder / "out"

    return results


@pytest.fixture(scope="session")
def stressed(results):
    """Loads of a flat bent chain of five spheres and a smaller one, lengths in µm."""
    return results("stress", BENT_CHAIN, "--unit", "um", "--rate", 1e4)


@pytest.fixture(scope="session")
def broken(results):
    """Breakup of a cluster of thirty spheres with loops."""
    aggregate = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    return results("break", aggregate, "--flow", "uniaxial", "--rate", 1e5)


@pytest.fixture
def copied(tmp_path):
    """A copy of a folder of results, to be changed."""

    def copied(folder):
        return shutil.copytree(folder, tmp_path / "copy")

    return copied


@pytest.fixture(scope="session")
def rows():
    """Rows of a table of results, as words by column."""

    def rows(path: os.PathLike):
        with path.open(newline="") as file:
            return list(csv.DictReader(file))

    return rows


@pytest.fixture(scope="session")
def campaign(tmp_path_factory):
    """Run a campaign, written in TOML, here and now; returns its folder."""
    pytest.importorskip("msgspec")
    pytest.importorskip("pyarrow")
    from rheoclast.campaigns import read_campaign, survey

    def campaign(text):
        folder = tmp_path_factory.mktemp("campaign")
        (folder / "campaign.toml").write_text(text, encoding="utf-8")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("rheoclast.campaigns.local_pool.performed", in_turn)
            survey(read_campaign(folder / "campaign.toml"), folder / "mixers")
        return folder / "mixers"

    return campaign


def in_turn(function, items, **_):
    return ((item, function(item)) for item in items)


@pytest.fixture(scope="session")
def first_failures(campaign):
    """Some kinds of aggregates in random orientations; those of a large prefactor cannot be made."""
    return campaign(CAMPAIGN.format(event="first failure") + "orientations = { number = 7 }" + IN_FLOWS)


@pytest.fixture(scope="session")
def breakups(campaign):
    """The same aggregates, broken up to a rate that not all of them reach."""
    return campaign(CAMPAIGN.format(event="breakup") + "orientations = { number = 2 }\nup_to = 1e6" + IN_FLOWS)


@pytest.fixture(scope="session")
def in_turbulence(campaign):
    """Two kinds of aggregates at a dissipation where nothing fails, one where some do, and one where all do."""
    return campaign(CAMPAIGN.format(event="history") + IN_TURBULENCE)


@pytest.fixture(params=["first_failures", "breakups", "in_turbulence"])
def surveyed(request):
    """Each of these campaigns."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def unfinished(copied):
    """A campaign of which some tasks are not done yet; returns the folder and the names of those that are."""

    def unfinished(folder, share=0.5):
        copy = copied(folder)
        for name in ("events.parquet", "aggregates.parquet"):
            (copy / name).unlink()
        tasks = sorted((copy / "tasks").glob("*.parquet"))
        for path in tasks[int(share * len(tasks)) :]:
            path.unlink()
        return copy, [path.stem for path in tasks[: int(share * len(tasks))]]

    return unfinished


@pytest.fixture(scope="session")
def browser():
    if BROWSER is None:
        pytest.skip("needs a browser: install chromium, or set RHEOCLAST_BROWSER to the path of one")
    sync_api = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=BROWSER, args=list(ARGUMENTS))
        yield browser
        browser.close()


@pytest.fixture
def opened(browser, tmp_path):
    """Open the page on a folder of results; afterwards nothing may have gone wrong or been asked of a network."""
    contexts, problems = [], []

    def on_console(message):
        if message.type in ("error", "warning") and "GL Driver Message" not in message.text:  # of reading pixels
            problems.append(message.text)

    def opened(folder, width=800, scheme="light", script=None, until="#scale-bar"):
        write_report(folder, tmp_path / "page.html", overwrite=True)
        contexts.append(browser.new_context(viewport={"width": width, "height": 600}, color_scheme=scheme))
        page = contexts[-1].new_page()
        page.on("console", on_console)
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("request", lambda request: request.url.startswith("file:") or problems.append(request.url))
        if script:
            page.add_init_script(script)
        page.goto((tmp_path / "page.html").as_uri())
        page.wait_for_selector(until)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert problems == []


@pytest.fixture
def overlapping_texts():
    """Pairs of texts in the charts of a page that cover each other."""
    return lambda page: page.locator("#charts svg").evaluate_all(OVERLAPPING)
