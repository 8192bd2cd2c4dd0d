"""The text of the page says what the results say."""

import json

import pytest

import rheoclast as rc
from rheoclast.report.result import read_result
from rheoclast.report.summary import sizes_in_words, summary


def figures(folder):
    return {figure.label: figure for figure in summary(read_result(folder)).figures}


def test_stress(stressed):
    told = json.loads((stressed / "summary.json").read_text())
    text = summary(read_result(stressed))
    assert text.lead.startswith("6 spheres with 5 contacts in simple shear of rate 1 × 10⁴ 1/s")
    given = figures(stressed)["Initiation rate, as it lies"]
    assert given.value.endswith("1/s")
    assert f"contact {told['given_orientation']['contact']}, by tension" in given.note
    assert f"± {100 * told['given_orientation']['initiation_rate_error']:.2g} % from the multipole order" in given.note
    rows = {label: value for group in text.groups for label, value in group.rows}
    assert rows["Velocity gradient"] == "[0, 1 × 10⁴, 0; 0, 0, 0; 0, 0, 0] 1/s"
    assert rows["Largest compression"] == "none"
    assert rows["Hydrodynamics"] == "Stokesian dynamics, multipole order 2"
    assert rows["Contacts"] == "polystyrene, law jkr"
    assert rows["Young's modulus"] == "3.4 × 10⁹ Pa"
    assert rows["Work of adhesion"] == "0.02 J/m²"
    smallest, largest = told["contact_law"]["pull_off_N"]
    assert rows["Pull-off force"] == f"{1e9 * smallest:.3g} nN to {1e9 * largest:.3g} nN"
    assert "Friction" not in rows


def test_breakup(broken):
    told = json.loads((broken / "summary.json").read_text())
    text = summary(read_result(broken))
    assert f"it breaks by a crack of {told['failures']} failures" in text.lead
    found = figures(broken)
    assert found["Failed contacts"].value == str(told["failures"])
    assert found["Fragments"].value == str(len(told["fragments"]))
    ratio = told["breakup_rate_per_s"] / told["initiation_rate_per_s"]
    assert found["Breakup rate"].note == f"{ratio:.4g} × initiation rate"
    assert f"± {100 * told['initiation_rate_error']:.2g} %" in found["Initiation rate"].note
    rows = {label: value for group in text.groups for label, value in group.rows}
    assert rows["Velocity gradient, over its rate"] == "[−0.5, 0, 0; 0, −0.5, 0; 0, 0, 1]"


def test_nothing_is_pulled_apart(results):
    doublet = "0 0 0 1\n2 0 0 1\n"
    held = results("break", doublet, "--unit", "um", "--flow", "uniaxial")
    assert "it stays whole" in summary(read_result(held)).lead
    assert figures(held)["Breakup rate"].value == "none"
    loaded = results("stress", doublet, "--unit", "um", "--flow", "uniaxial")
    assert figures(loaded)["Initiation rate, as it lies"].note == "no contact is pulled apart"


def test_liquid_at_rest(results):
    folder = results("stress", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--rate", 0)
    assert summary(read_result(folder)).lead.startswith("2 spheres with 1 contact in liquid at rest: the load")


def test_model_without_order(results):
    folder = results("stress", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--model", "free-draining")
    rows = {label: value for group in summary(read_result(folder)).groups for label, value in group.rows}
    assert rows["Hydrodynamics"] == "free draining"
    assert "±" not in figures(folder)["Initiation rate, as it lies"].note


def test_cascade(results):
    cluster = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    folder = results("break", cluster, "--rate", 1e9, "--cascade")
    told = json.loads((folder / "summary.json").read_text())
    rows = {label: value for group in summary(read_result(folder)).groups for label, value in group.rows}
    assert rows["Hold at 1 × 10⁹ 1/s"].startswith(f"{len(told['cascade']['sizes'])} pieces: ")
    assert figures(folder)["Fragments of the first split"].value == str(len(told["fragments"]))
    assert figures(folder)["Pieces that hold at 1 × 10⁹ 1/s"].value == str(len(told["cascade"]["sizes"]))


def test_rounding_errors_are_no_loads(results):
    """A doublet along a shear is not pulled apart; what the sum of its loads leaves is no tension."""
    folder = results("stress", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--rate", 1e5)
    found = figures(folder)
    assert found["Initiation rate, as it lies"].value == found["Largest tension"].value == "none"
    assert found["Initiation rate, worst orientation"].value.endswith("1/s")
    rows = {label: value for group in summary(read_result(folder)).groups for label, value in group.rows}
    assert rows["Largest shear"].endswith("pN")
    assert rows["Largest twisting"] == "none"


def test_a_tree_splits_with_its_first_failure(results):
    folder = results("break", "0 0 0 1\n2 0 0 1\n4 0 0 1\n6 0 0 1\n", "--unit", "um", "--flow", "biaxial")
    assert figures(folder)["Breakup rate"].note == "with the first failure"


@pytest.mark.parametrize("name", ["stressed", "broken"])
def test_every_row_says_something(name, request):
    text = summary(read_result(request.getfixturevalue(name)))
    assert all(label and value for group in text.groups for label, value in group.rows)
    assert all(figure.label and figure.value for figure in text.figures)


def test_contacts_as_given(results):
    law = ["--stiffness", 1, 1, 1e-13, 1e-13, "--pull-off", 2e-9]
    given = ["--orientation", "random", "--seed", 7, "--up-to", 1e9]
    folder = results("break", "0 0 0 1\n2 0 0 1\n2 2 0 1\n", "--unit", "um", *law, *given)
    rows = {label: value for group in summary(read_result(folder)).groups for label, value in group.rows}
    assert (rows["Contacts"], rows["Pull-off force"]) == ("explicit stiffness", "2 nN, as given")
    assert (rows["Orientation"], rows["Largest rate"]) == ("random, seed 7", "1 × 10⁹ 1/s")
    assert "Young's modulus" not in rows


def test_limits_of_contacts(results):
    folder = results("break", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--friction", 0.3, "--rolling-distance", 1e-9)
    rows = {label: value for group in summary(read_result(folder)).groups for label, value in group.rows}
    assert (rows["Friction"], rows["Rolling distance"]) == ("0.3", "1 nm")


def test_sizes_in_words():
    assert sizes_in_words([1]) == "1 sphere"
    assert sizes_in_words([60]) == "60 spheres"
    assert sizes_in_words([1, 99]) == "99 and 1 spheres"
    assert sizes_in_words([50, 1, 20, 50]) == "2 × 50, 20 and 1 spheres"
    assert sizes_in_words(range(1, 30)).endswith("22, … spheres")
