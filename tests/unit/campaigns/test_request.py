"""Campaign files: what they ask for, and how they are refused."""

from pathlib import Path

import pytest

import rheoclast as rc

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns import read_campaign
from rheoclast.campaigns.identity import canonical

BASE = {
    "viscosity": "1e-3",
    "radius": "0.5e-6",
    "sizes": "[10, 20]",
    "flows": '["shear"]',
    "orientations": "{ number = 3 }",
    "materials": '["polystyrene"]',
    "families": '[{ name = "cluster-cluster" }]',
}


def campaign(folder, **changed):
    """The campaign of `BASE` with some values changed, or left out if None."""
    path = folder / "campaign.toml"
    lines = {key: value for key, value in {**BASE, **changed}.items() if value is not None}
    path.write_text("\n".join(f"{key} = {value}" for key, value in lines.items()), encoding="utf-8")
    return read_campaign(path)


def test_lists_mean_every_combination(tmp_path):
    families = """[
        { name = "cluster-cluster", fractal_dimension = [1.8, 2], prefactor = 1.3 },
        { name = "straight-chain", count = 7, radius = 1e-6 },
        { name = "lattice-block", lattice = ["fcc", "hcp"], counts = [[3, 3, 2], [2, 2, 2]] },
    ]"""
    tasks = campaign(tmp_path, families=families, seeds="{ number = 3, first = 5 }").tasks()
    clusters = [task for task in tasks if task.family == "cluster-cluster"]
    assert [(task.parameters["count"], task.parameters["fractal_dimension"], task.replicate) for task in clusters] == [
        (size, dimension, replicate) for size in (10, 20) for dimension in (1.8, 2.0) for replicate in (5, 6, 7)
    ]
    assert all(task.parameters["prefactor"] == 1.3 and task.parameters["radius"] == 0.5e-6 for task in clusters)
    (chain,) = (task for task in tasks if task.family == "straight-chain")
    assert chain.parameters == {"count": 7, "radius": 1e-6}
    assert chain.seed is None
    blocks = [task.parameters for task in tasks if task.family == "lattice-block"]
    assert [(block["lattice"], block["counts"]) for block in blocks] == [
        (lattice, counts) for lattice in ("fcc", "hcp") for counts in ((3, 3, 2), (2, 2, 2))
    ]


def test_every_family_can_be_asked_for(tmp_path):
    needed = {
        "bend": "0.2",
        "coordination": "4",
        "amount": "0.5",
        "arm": "2",
        "lattice": '"fcc"',
        "counts": "[[2, 2, 2]]",
    }
    for name in rc.generation.FAMILIES:
        complaint = f'[{{ name = "{name}" }}]'
        for _ in needed:
            try:
                tasks = campaign(tmp_path, families=complaint).tasks()
                break
            except ValueError as error:
                key = str(error).rpartition(" ")[2]
                complaint = complaint.replace(" }", f", {key} = {needed[key]} }}")
        assert len(tasks[0].grown()) > 1


def test_what_is_asked_for_twice_is_done_once(tmp_path):
    assert len(campaign(tmp_path, sizes="[10, 10]").tasks()) == 1


def test_seeds_follow_from_what_an_aggregate_is(tmp_path):
    """Neither the other aggregates nor the conditions matter, but the campaign's seed does."""
    few = campaign(tmp_path, sizes="[20]").tasks()
    many = campaign(
        tmp_path, seeds="{ number = 4 }", viscosity="2e-3", materials='[{ name = "polystyrene", pull_off = 1e-9 }]'
    )
    other = campaign(tmp_path, sizes="[20]", seed="1").tasks()
    seeds = {task.parameters["count"]: task.seed for task in reversed(many.tasks())}
    assert seeds[20] == few[0].seed != other[0].seed
    assert few[0].digest not in {task.digest for task in many.tasks()}
    drawn = [task.seed for task in many.tasks()] + [task.orientation_seed for task in many.tasks()]
    assert len(set(drawn)) == len(drawn)
    assert all(0 <= seed < 2**63 for seed in drawn)


def test_equal_requests_are_equal_however_they_are_written(tmp_path):
    assert campaign(tmp_path, viscosity="1.0e-3", radius="5e-7") == campaign(tmp_path)
    assert campaign(tmp_path, event='"breakup"') != campaign(tmp_path)


HISTORIES = {
    "event": '"history"',
    "flows": None,
    "orientations": None,
    "histories": '{ model = "gaussian", number = 2, duration = 5, dissipations = [0.1], density = 1e3 }',
}


def test_seeds_of_histories_follow_from_what_an_aggregate_is(tmp_path):
    few = campaign(tmp_path, **HISTORIES, sizes="[20]").tasks()
    many = campaign(tmp_path, **HISTORIES, seeds="{ number = 3 }").tasks()
    other = campaign(tmp_path, **HISTORIES, sizes="[20]", seed="1").tasks()
    assert few[0].history_seed in {task.history_seed for task in many}
    assert few[0].history_seed not in {few[0].seed, few[0].orientation_seed, other[0].history_seed}
    assert len({task.history_seed for task in many}) == 6
    assert campaign(tmp_path).tasks()[0].history_seed is None


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"flows": '["shear"]'}, "flows: event 'history' takes histories instead; remove flows"),
        ({"orientations": '"worst"'}, "orientations: event 'history' takes histories instead; remove orientations"),
        ({"histories": None}, "histories: expected with event 'history', got none; add it"),
        ({"event": '"breakup"'}, "flows: expected with event 'breakup', got none; add it"),
        (
            {"event": '"breakup"', "flows": '["shear"]'},
            "orientations: expected with event 'breakup', got none; add it",
        ),
        (
            {"event": '"breakup"', "flows": '["shear"]', "orientations": '"worst"'},
            "histories: event 'breakup' takes flows and orientations instead; remove histories",
        ),
    ],
)
def test_histories_and_flows_exclude_each_other(tmp_path, changed, message):
    with pytest.raises(ValueError, match=rf"campaign\.toml: {message}"):
        campaign(tmp_path, **{**HISTORIES, **changed})


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("{ density = 1e3 }", "histories: model, files: expected one of them"),
        ('{ model = "gaussian", files = ["a.csv"], density = 1e3 }', "histories: model, files: expected one of them"),
        ('{ model = "gaussian" }', "histories: density, kinematic_viscosity: expected one of them"),
        (
            '{ model = "gaussian", density = 1e3, kinematic_viscosity = 1e-6 }',
            "histories: density, kinematic_viscosity: expected one of them",
        ),
        (
            '{ model = "chaos", density = 1e3 }',
            "histories: model: expected one of gaussian, .*, got 'chaos'",
        ),
        ('{ model = "gaussian", density = 1e3 }', "histories: number: expected with a model of turbulence"),
        (
            '{ model = "gaussian", density = 1e3, number = 0 }',
            r"histories\.number: expected an integer of at least 1, got 0",
        ),
        ('{ model = "gaussian", density = 1e3, number = 1 }', "histories: duration: expected with a model"),
        ('{ model = "gaussian", density = 1e3, duration = 0 }', "histories: duration: expected a positive number"),
        (
            '{ model = "gaussian", density = 1e3, number = 1, duration = 5 }',
            "histories: dissipations: expected with a model of turbulence, got none; add it",
        ),
        (
            '{ model = "gaussian", density = 1e3, dissipations = [1, 0] }',
            r"histories: dissipations\[1\]: expected a positive number, got 0",
        ),
        (
            '{ model = "gaussian", density = 1e3, dissipations = [1, 1.0] }',
            r"histories: dissipations: expected different ones, got 1\.0 2 times",
        ),
        (
            '{ model = "gaussian", density = 1e3, dissipations = [] }',
            r"histories.dissipations: expected a list of length at least 1, got \[\]",
        ),
        ('{ model = "gaussian", density = -1 }', "histories: density: expected a positive number, got -1"),
        ("{ files = [], density = 1e3 }", "histories.files: expected a list of length at least 1, got \\[\\]"),
        (
            '{ files = ["nothing.csv"], density = 1e3 }',
            r"histories: files\[0\]: path: .*nothing\.csv cannot be read \(No such file .*; check its name and folder",
        ),
        (
            '{ files = [{ path = "a.csv", row = 3 }], density = 1e3 }',
            r"histories\.files\[0\]: unknown key row",
        ),
        ("{ files = [3], density = 1e3 }", r"histories\.files\[0\]: expected text or a table, got 3"),
        (
            "{ files = [{ path = 3 }], density = 1e3 }",
            r"histories\.files\[0\]\.path: expected the name of a file, got 3",
        ),
        ("{ files = [{ order = 'row' }], density = 1e3 }", r"histories\.files\[0\]: missing key path"),
    ],
)
def test_refusals_of_histories(tmp_path, table, message):
    with pytest.raises(ValueError, match=rf"campaign\.toml: {message}"):
        campaign(tmp_path, **{**HISTORIES, "histories": table})


def test_files_are_read_with_the_campaign(tmp_path):
    rc.write_histories(tmp_path / "paths.csv", rc.gaussian_histories(3, 0.01, 1.0, 1e-6, seed=1))
    table = '{{ files = ["paths.csv"], density = 1e3, {} }}'
    first = campaign(tmp_path, **{**HISTORIES, "histories": table.format("number = 3")})
    with pytest.raises(ValueError, match=r"histories: number: expected at most 3, the histories in the files, got 4"):
        campaign(tmp_path, **{**HISTORIES, "histories": table.format("number = 4")})
    with pytest.raises(ValueError, match=r"histories: duration: expected at most .* Kolmogorov times, .* got 1000"):
        campaign(tmp_path, **{**HISTORIES, "histories": table.format("duration = 1000")})
    rc.write_histories(tmp_path / "paths.csv", rc.gaussian_histories(3, 0.01, 1.0, 1e-6, seed=2), overwrite=True)
    changed = campaign(tmp_path, **{**HISTORIES, "histories": table.format("number = 3")})
    assert first.tasks()[0].digest != changed.tasks()[0].digest
    assert first.tasks()[0].history_seed == changed.tasks()[0].history_seed
    (tmp_path / "paths.csv").write_text("1, 2\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"campaign\.toml: histories: .*paths\.csv"):
        campaign(tmp_path, **{**HISTORIES, "histories": table.format("number = 3")})


@pytest.mark.parametrize("entry", ['"data/paths.csv"', '{ path = "data/paths.csv", tolerance = 0.1 }'])
def test_files_lie_where_the_campaign_says_from_its_folder_on(tmp_path, monkeypatch, entry):
    """Moved together they are the same campaign; tasks know the place, from whatever folder they are performed."""
    table = f"{{ files = [{entry}], density = 1e3 }}"
    found = []
    for name in ("here", "there"):
        (tmp_path / name / "data").mkdir(parents=True)
        rc.write_histories(tmp_path / name / "data" / "paths.csv", rc.gaussian_histories(2, 0.01, 1.0, 1e-6, seed=1))
        monkeypatch.chdir(tmp_path / name)
        found.append(campaign(Path(), **{**HISTORIES, "histories": table}))
        monkeypatch.chdir(tmp_path)
    here, there = (each.tasks()[0] for each in found)
    assert here.digest == there.digest
    assert canonical(found[0]) == canonical(found[1])
    assert [file.path for file in here.conditions.histories.files] == [tmp_path / "here" / "data" / "paths.csv"]
    assert len(there.conditions.histories.drawn(1)) == 2


@pytest.mark.parametrize("event", ['"first failure"', '"history"'])
def test_a_bound_on_the_rate_needs_a_flow_that_is_raised(tmp_path, event):
    changed = {"event": event, "up_to": "1.0"}
    with pytest.raises(ValueError, match=f"up_to: only event 'breakup' raises the flow, got {event[1:-1]!r}; remove"):
        campaign(tmp_path, **({**HISTORIES, **changed} if "history" in event else changed))
    assert campaign(tmp_path, event='"breakup"', up_to="1.0").up_to == 1


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"viscosity": None}, "missing key viscosity"),
        ({"viscosity": '"thick"'}, "viscosity: expected a number, got 'thick'"),
        ({"viscosity": "-1.0"}, "viscosity: expected a positive number, got -1"),
        ({"radius": "0"}, "radius: expected a positive number, got 0"),
        ({"up_to": "0.0"}, "up_to: expected a positive number, got 0"),
        ({"sizes": "[10, 0]"}, r"sizes\[1\]: expected an integer of at least 1, got 0"),
        (
            {"sizes": None},
            r"families\[0\]: sizes: cluster-cluster needs numbers of spheres; give sizes, or the family its own count",
        ),
        ({"colour": "1"}, "unknown key colour; known are event, viscosity, "),
        ({"size": "[10]"}, r"unknown key size; did you mean sizes\?"),
        ({"hydrodynamics": "{ modle = 1 }"}, r"hydrodynamics: unknown key modle; did you mean model\?"),
        (
            {"materials": '[{ name = "a", pulloff = 1 }]'},
            r"materials\[0\]: unknown key pulloff; did you mean pull_off\?",
        ),
        ({"seeds": "3"}, "seeds: expected a table, got 3"),
        ({"families": '[{ name = "bent-chain", bent = 1 }]'}, r"families\[0\]: unknown key bent; did you mean bend\?"),
        ({"event": '"lunch"'}, "event: expected one of first failure, breakup, history, got 'lunch'"),
        ({"rule": '"strongest"'}, "rule: expected one of weakest, overloaded, got 'strongest'"),
        ({"criterion": '"taste"'}, "criterion: expected one of every-limit, .*, got 'taste'"),
        ({"criterion": '"sliding"'}, "criterion: 'sliding' never fails 'polystyrene', .*; add friction"),
        ({"orientations": '"best"'}, "orientations: expected 'worst' or { number = … }, got 'best'"),
        ({"orientations": "{ number = 0 }"}, "orientations.number: expected an integer of at least 1, got 0"),
        ({"flows": "[]"}, "flows: expected a list of length at least 1, got \\[\\]"),
        ({"flows": '["twirl"]'}, "flows: expected one of shear, uniaxial, biaxial, planar, got 'twirl'"),
        ({"flows": '["shear", "shear"]'}, "flows: expected different ones, got 'shear' 2 times"),
        ({"flows": '[{ name = "a" }]'}, r"flows\[0\]: missing key gradient"),
        ({"flows": '[{ name = "a", gradient = [[1, 0, 0], [0, 0, 0], [0, 0, 0]] }]'}, r"flows\[0\]: gradient: .*trace"),
        ({"flows": '[{ name = "a", gradient = [[0, 1, 0], [-1, 0, 0], [0, 0, 0]] }]'}, r"flows\[0\]: .* a rotation"),
        (
            {"materials": '["cheese"]'},
            r"materials\[0\]: expected polystyrene, or a table { name = …, youngs_modulus = …, .* }, got 'cheese'",
        ),
        (
            {"materials": '[{ name = "cheese", youngs_modulus = 1e6, work_of_adhesion = 0.1 }]'},
            r"materials\[0\]: material: 'cheese' is none of the known ones \(polystyrene\); give its poisson_ratio$",
        ),
        (
            {"materials": '[{ name = "polystyrene", law = "oil" }]'},
            r"materials\[0\]: law: expected one of jkr.*, got 'oil'",
        ),
        ({"materials": '[{ name = "a", stiffness = [1, 1, 1, 1] }]'}, r"materials\[0\]: stiffness: .*add pull_off"),
        (
            {"materials": '[{ name = "a", stiffness = [1, 1, 1, 1], pull_off = 1, friction = 0.1 }]'},
            r"materials\[0\]: friction: explicit stiffness does not take this; leave one of them out",
        ),
        ({"hydrodynamics": '{ model = "magic" }'}, "hydrodynamics: model: expected one of stokesian, .*, got 'magic'"),
        ({"hydrodynamics": "{ order = 0 }"}, "hydrodynamics: .*order"),
        ({"families": "[]"}, "families: expected a list of length at least 1, got \\[\\]"),
        ({"families": '[{ name = "weed" }]'}, r"families\[0\]: name: expected one of straight-chain, .*, got 'weed'"),
        (
            {"families": '[{ name = ["ring", "straight-chain"] }]'},
            r"families\[0\]: name: expected the name of one family, got \['ring', 'straight-chain'\]; give every",
        ),
        ({"families": '[{ name = "ring", bend = 1 }]'}, r"families\[0\]: unknown key bend"),
        ({"families": '[{ name = "bent-chain" }]'}, r"families\[0\]: missing key bend"),
        (
            {"families": '[{ name = "bent-chain", bend = "a" }]'},
            r"families\[0\]: bend: expected a number or a list, got 'a'",
        ),
        (
            {"families": '[{ name = "thinned-fcc-ball", coordination = [] }]'},
            r"families\[0\]: coordination: expected a list of length at least 1, got \[\]",
        ),
        (
            {"families": '[{ name = "cluster-cluster", prefactor = [] }]'},
            r"families\[0\]: prefactor: expected a list of",
        ),
        (
            {"families": '[{ name = "lattice-block", lattice = "fcc", counts = [] }]'},
            r"families\[0\]: counts: expected",
        ),
        (
            {"families": '[{ name = "ring", count = [] }]'},
            r"families\[0\]: count: expected a list of length at least 1, got \[\]",
        ),
        ({"viscosity": ""}, "expected a campaign in TOML, with lines key = value; invalid value"),
    ],
)
def test_refusals_name_file_and_key(tmp_path, changed, message):
    with pytest.raises(ValueError, match=rf"campaign\.toml: {message}"):
        campaign(tmp_path, **changed)


@pytest.mark.parametrize(("changed", "message"), [({"radius": "0.5"}, "exceed 1 mm"), ({"viscosity": "1e6"}, "Pa s")])
def test_units_that_are_probably_wrong(tmp_path, changed, message):
    with pytest.warns(rc.UnitWarning, match=message):
        campaign(tmp_path, **changed)


def test_units_of_a_family_s_own_radius(tmp_path):
    with pytest.warns(rc.UnitWarning, match="radii up to 500 m exceed 1 mm"):
        campaign(tmp_path, families='[{ name = "ring" }, { name = "straight-chain", radius = [1e-6, 500.0] }]')
    campaign(tmp_path, viscosity="1.0", families='[{ name = "straight-chain", radius = 500.0 }]')


def test_what_is_no_campaign(tmp_path):
    for content, message in (
        (b"0 0 0 1\n", r"expected a campaign in TOML, with lines key = value; expected '=' after a key"),
        (b"viscosity = \x94", r"expected a campaign in TOML, got byte 0x94 at position 12, .*; save it as UTF-8"),
    ):
        (tmp_path / "chain.dat").write_bytes(content)
        with pytest.raises(ValueError, match=rf"chain\.dat: {message}"):
            read_campaign(tmp_path / "chain.dat")
    with pytest.raises(IsADirectoryError, match="expected a campaign in TOML, got a folder; name a file in it"):
        read_campaign(tmp_path)


def test_missing_file(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nothing\.toml: there is no such file"):
        read_campaign(tmp_path / "nothing.toml")


def test_the_example_is_understood():
    example = read_campaign(Path(__file__).parents[3] / "examples" / "campaign.toml")
    assert len(example.tasks()) == 2 * (2 + 2) * 5


def test_the_example_in_turbulence_is_understood():
    example = read_campaign(Path(__file__).parents[3] / "examples" / "campaign_in_turbulence.toml")
    assert len(example.tasks()) == 2 * 2 * 5
    assert list(example.histories.kolmogorov_times(1e-3).values()) == pytest.approx([10**-2.5, 3e5**-0.5, 1e-3])
