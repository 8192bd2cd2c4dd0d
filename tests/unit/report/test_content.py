"""What the scripts draw is what the tables hold, in other units and fewer digits."""

import json

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.report.content import content
from rheoclast.report.result import read_result
from rheoclast.view.projection import view_axes


@pytest.mark.parametrize("name", ["stressed", "broken"])
def test_loads(name, request):
    result = read_result(request.getfixturevalue(name))
    drawn = content(result)
    for load in drawn["loads"]:
        shown = np.array(drawn["tables"]["contacts"]["rows"][load["key"]]) * load["divisor"]
        exact = result.contacts[load["key"]]
        np.testing.assert_allclose(shown, exact, rtol=1e-4, atol=1e-28)
        if f"{load['key']}_error" in result.contacts:
            errors = np.array(drawn["tables"]["contacts"]["rows"][f"{load['key']}_error"]) * load["divisor"]
            np.testing.assert_allclose(errors, result.contacts[f"{load['key']}_error"], rtol=1e-4, atol=1e-28)
        largest = np.abs(exact).max()
        assert load["signed"] == bool((exact < -1e-9 * largest).any()) or not shown.any()
        assert 1 <= np.abs(shown).max() / load["divisor"] < 1000 or not load["base"] or not shown.any()
        assert load["unit"].endswith(load["base"])


def test_scene_is_in_mean_radii_from_the_centre_of_mass(stressed):
    drawn = content(read_result(stressed))["scene"]
    spheres = rc.read(stressed / "spheres.csv").spheres
    centers = np.reshape(drawn["centers"], (-1, 3))
    radii = np.array(drawn["radii"])
    assert radii.mean() == pytest.approx(1, abs=1e-4)
    np.testing.assert_allclose(radii**3 @ centers, 0, atol=1e-3)
    np.testing.assert_allclose(centers * drawn["radius"] + spheres.center_of_mass, spheres.centers, atol=1e-9)
    np.testing.assert_allclose(np.reshape(drawn["axes"], (3, 3)), view_axes(spheres), atol=1e-6)


@pytest.mark.parametrize("name", ["stressed", "broken"])
def test_contact_points_lie_on_both_spheres(name, request):
    drawn = content(read_result(request.getfixturevalue(name)))
    scene, rows = drawn["scene"], drawn["tables"]["contacts"]["rows"]
    centers, radii = np.reshape(scene["centers"], (-1, 3)), np.array(scene["radii"])
    for side in "ij":
        arms = np.reshape(scene["points"], (-1, 3)) - centers[rows[side]]
        np.testing.assert_allclose(np.linalg.norm(arms, axis=1), radii[rows[side]], atol=1e-3)


def test_strain_is_that_of_the_flow(broken):
    """Uniaxial extension along z."""
    strain = content(read_result(broken))["scene"]["strain"]
    np.testing.assert_allclose(strain["rates"], [1, -0.5, -0.5], atol=1e-12)
    np.testing.assert_allclose(np.abs(strain["directions"][0]), [0, 0, 1], atol=1e-12)


def test_breakup(broken, rows):
    drawn = content(read_result(broken))
    written = rows(broken / "failures.csv")
    assert drawn["tables"]["failures"]["rows"]["contact"] == [int(row["contact"]) for row in written]
    assert drawn["tables"]["failures"]["rows"]["criterion"] == [row["criterion"] for row in written]
    assert drawn["critical"] == int(written[0]["contact"])
    assert min(drawn["scene"]["fragment"]) == 0


def test_rounding_errors_are_zeros(results):
    """A single sphere is not anisotropic."""
    drawn = content(read_result(results("break", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--flow", "biaxial")))
    assert drawn["tables"]["fragments"]["rows"]["shape_anisotropy"] == [0.0, 0.0]


def test_json_holds_finite_numbers_only(stressed):
    assert json.loads(json.dumps(content(read_result(stressed)), allow_nan=False))


@pytest.fixture(scope="module")
def cascaded(results):
    """A cluster with loops at a rate at which its fragments break too."""
    cluster = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    return results("break", cluster, "--rate", 1e7, "--cascade")


def test_pieces_of_a_cascade(cascaded, rows):
    """As in the file, with nothing where there is no parent and no rate."""
    written = rows(cascaded / "pieces.csv")
    pieces = content(read_result(cascaded))["tables"]["pieces"]["rows"]
    assert len(written) > 3
    assert pieces["parent"] == [None, *(int(row["parent"]) for row in written[1:])]
    assert pieces["spheres"] == [int(row["spheres"]) for row in written]
    assert pieces["holds"] == ["yes" if row["holds"] == "1" else "no" for row in written]
    for shown, row in zip(pieces["initiation_rate"], written, strict=True):
        exact = float(row["initiation_rate_per_s"])
        assert shown is None if np.isinf(exact) else shown == pytest.approx(exact, rel=1e-4)


def test_no_pieces_without_a_cascade(broken):
    assert "pieces" not in content(read_result(broken))["tables"]


def test_unit_of_errors_where_the_value_is_zero(results):
    """A doublet along a shear: its tension is zero, but for the error of the multipole order."""
    drawn = content(read_result(results("stress", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--rate", 1e5)))
    rows = drawn["tables"]["contacts"]["rows"]
    assert rows["tension"] == [0.0]
    assert 1 <= rows["tension_error"][0] < 1000
    assert next(load for load in drawn["loads"] if load["key"] == "tension")["unit"] == "pN"
