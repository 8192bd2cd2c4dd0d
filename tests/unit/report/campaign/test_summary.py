"""The text of the page of a campaign says what was asked and how much is done."""

import json
from collections import defaultdict
from statistics import median_low

import pytest

from rheoclast.report.campaign.folder import read_campaign_result
from rheoclast.report.campaign.kinds import kinds
from rheoclast.report.campaign.summary import campaign_summary
from rheoclast.report.wording import written

pq = pytest.importorskip("pyarrow.parquet")


def text(folder):
    result = read_campaign_result(folder)
    return campaign_summary(result, kinds(result))


def rows(told):
    return {label: value for group in told.groups for label, value in group.rows}


def figures(told):
    return {figure.label: figure for figure in told.figures}


def test_first_failures(first_failures):
    told = text(first_failures)
    assert told.lead == (
        "27 aggregates of cluster-cluster, straight-chain and lattice-block, each in 7 random orientations "
        "in shear and uniaxial: the contact that fails first, and at what rate."
    )
    assert figures(told)["Aggregates done"].note == "all that were asked for"
    assert figures(told)["Events"].note == "24 came to nothing"
    found = rows(told)
    assert found["cluster-cluster"] == "fractal dimension 1.8 or 2.9, prefactor 1.3 or 6"
    assert found["lattice-block"] == "counts 2 × 2 × 2 or 3 × 2 × 2, lattice sc"
    assert found["Flows"] == "shear, uniaxial"
    assert found["weak"] == "stiffness 1 and 1 N/m, 1 and 1 N m/rad, pull-off force 200 pN"
    assert found["polystyrene"].startswith("Young's modulus 3.4 × 10⁹ Pa, Poisson's ratio")
    assert found["Hydrodynamics"] == "free draining"


def test_extremes(first_failures):
    """The most fragile kind and the strongest, by the medians of all rows of the tables."""
    medians = defaultdict(list)
    for row in pq.read_table(first_failures / "events.parquet").to_pylist():
        medians[row["family"], row["parameters"], row["material"], row["flow"]].append(row["initiation_rate_per_s"])
    found = figures(text(first_failures))
    for which, chosen in (("Lowest", min), ("Highest", max)):
        family, parameters, material, flow = chosen(medians, key=lambda kind: median_low(medians[kind]))
        figure = found[f"{which} initiation rate, median"]
        rate = median_low(medians[family, parameters, material, flow])
        assert figure.value == written(rate, "1/s")
        assert figure.note.startswith(f"{family}, ")
        assert figure.note.endswith(f" spheres, {material}, {flow}")


def test_breakups(breakups):
    told = text(breakups)
    assert "in shear and uniaxial: all failures up to the split, and the fragments." in told.lead
    assert rows(told)["Raised up to"] == "1 × 10⁶ 1/s"


def test_turbulence(in_turbulence):
    told = text(in_turbulence)
    assert told.lead == (
        "4 aggregates of cluster-cluster and straight-chain, in turbulence: "
        "the first failure along every path of the fluid."
    )
    found = rows(told)
    assert found["Histories"] == "gaussian"
    assert found["Number"] == "6 of every aggregate"
    assert found["Dissipations"] == "0.001 or 3 or 30 m²/s³"
    assert figures(told)["Lowest breakage rate"].value == "0 1/s"


def test_unfinished(first_failures, unfinished):
    folder, done = unfinished(first_failures)
    told = text(folder)
    assert figures(told)["Aggregates done"].value == str(len(done))
    assert figures(told)["Aggregates done"].note == "of 27; unfinished, the rest is still to come"


def test_flow_by_its_gradient_and_worst_orientation(first_failures, copied):
    folder = copied(first_failures)
    request = json.loads((folder / "campaign.json").read_text())
    request["flows"] = [{"name": "swirl", "gradient": [[1, 2, 0], [0, -1, 0], [0, 0, 0]]}]
    (folder / "campaign.json").write_text(json.dumps(request | {"orientations": "worst"}))
    told = text(folder)
    assert "each in the worst orientation in swirl" in told.lead
    assert rows(told)["Flows"] == "swirl (gradient [1, 2, 0; 0, −1, 0; 0, 0, 0] 1/s)"
    assert rows(told)["Orientations"] == "the worst"


def test_every_row_says_something(surveyed):
    told = text(surveyed)
    assert all(label and value for group in told.groups for label, value in group.rows)
    assert all(figure.label and figure.value and figure.note for figure in told.figures)


@pytest.mark.parametrize("name", ["first_failures", "in_turbulence"])
def test_versions(name, request):
    made = pq.read_table(request.getfixturevalue(name) / "aggregates.parquet")["rheoclast"].to_pylist()
    assert rows(text(request.getfixturevalue(name)))["Made with Rheoclast"] == made[0]
