"""The dense solver: all orders from one factorization, and its refusals."""

import re

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.mobility import Mobility

from ...agreement.clusters import sticking_cluster

ORDER = 5


@pytest.fixture(scope="module", params=[(2, 1, (0.3, 1.0)), (7, 2, 1.0), (6, 3, (0.5, 1.4))], ids=str)
def solved(request):
    """Tractions of orders 1 to 5 of a cluster, and its spheres."""
    centers, radii = sticking_cluster(*request.param)
    mobility = Mobility(centers, radii, MultipoleBasis(ORDER))
    solutions = DenseCholesky().solve(mobility, mobility.ambient_velocities())
    return mobility, [each.tractions for each in solutions]


def test_tractions_give_the_velocities(solved):
    """Residual of the system itself, through the product without the matrix."""
    mobility, tractions = solved
    wanted = mobility.ambient_velocities()
    np.testing.assert_allclose(mobility @ tractions[-1], wanted, rtol=0, atol=1e-11 * np.abs(wanted).max())


def test_lower_orders_are_those_solved_by_themselves(solved):
    """Condition numbers below 10⁴ leave 1e-12 of the largest; a wrong leading part would differ in the first digit."""
    mobility, tractions = solved
    assert len(tractions) == ORDER
    for order, nested in enumerate(tractions, start=1):
        alone = Mobility(mobility.centers, mobility.radii, MultipoleBasis(order))
        (*_, expected) = DenseCholesky().solve(alone, alone.ambient_velocities())
        assert nested.shape == (len(mobility.radii), MultipoleBasis(order).size, 11)
        np.testing.assert_allclose(nested, expected.tractions, rtol=0, atol=1e-11 * np.abs(expected.tractions).max())


def test_progress_names_both_steps():
    mobility = Mobility(*sticking_cluster(4, 4), MultipoleBasis(2))
    steps = []
    DenseCholesky().solve(mobility, mobility.ambient_velocities(), lambda *step: steps.append(step))
    assert steps[-2:] == [("factorization", 0.0), ("factorization", 1.0)]
    assert steps[-3] == ("pair mobilities", 1.0)


@pytest.mark.parametrize("order", [6, 10])
def test_overlapping_spheres_lose_positive_definiteness(order):
    """A quarter of a radius deep and told to be fine: at high order the hierarchy has no solution, and says so."""
    spheres = rc.Spheres(np.array([[0.0, 0, 0], [0, 0, 1.5], [0, 1.5, 0]]), 1.0, overlap_tolerance=1.0)
    with pytest.raises(
        rc.GeometryError,
        match="the mobility of these spheres is not positive definite, as happens when spheres overlap; "
        "shrink the radii until they only touch",
    ):
        rc.rigid_response(spheres, rc.StokesianDynamics(order=order), viscosity=1.0)


@pytest.mark.parametrize("order", [2, 6, 8])
def test_overlap_within_the_contact_tolerance_changes_loads_by_its_own_size(order):
    """1e-3 radii are solved, and the tension moves by a few of these at most."""

    def tension(distance):
        spheres = rc.Spheres(np.array([[0.0, 0, 0], [0, 0, distance]]), 1.0)
        response = rc.rigid_response(spheres, rc.StokesianDynamics(order=order), viscosity=1.0)
        loads = response.loads(rc.uniaxial_extension(1.0))
        return rc.contact_loads(rc.Aggregate(spheres, np.array([[0, 1]])), loads).tension[0]

    assert tension(2 - 0.999e-3) == pytest.approx(tension(2.0), rel=3e-3)


def test_refuses_what_does_not_fit_into_memory():
    """10⁵ spheres at order 2: a matrix of 9.7 TB and its copy of order 1, more than any machine that runs tests has."""
    centers = np.zeros((100_000, 3))
    centers[:, 2] = 2.0 * np.arange(len(centers))
    message = (
        r"order 2 of 100000 spheres needs 1\.04e\+04 GB of memory, [\d.e+]+ GB are free; "
        "use a lower order or fewer spheres"
    )
    model = rc.StokesianDynamics(order=2, solver=DenseCholesky())
    with pytest.raises(MemoryError, match=f"^{message}$"):
        rc.rigid_response(rc.Spheres(centers, 1.0), model, viscosity=1.0)


@pytest.mark.parametrize(("order", "both"), [(1, 3**2), (2, 11**2 + 3**2), (3, 26**2 + 11**2)])
def test_memory_is_that_of_the_matrix_and_of_its_leading_part(order, both):
    """8 bytes per element of a matrix of this order and of the next lower one."""
    expected = 8 * 200**2 * both
    assert DenseCholesky().memory(200, MultipoleBasis(order)) == pytest.approx(expected)
    assert rc.StokesianDynamics(order=order, solver=DenseCholesky()).memory(200) == pytest.approx(expected)


@pytest.mark.parametrize("order", [0, -1, 2.5, "high", None, True])
def test_order_of_the_model(order):
    """Refused where it is given, not where it is used."""
    with pytest.raises(ValueError, match=re.escape(f"order: expected an integer of at least 1, got {order!r}")):
        rc.StokesianDynamics(order=order)


@pytest.mark.parametrize(
    ("accuracy", "message"), [(0, "a positive number, got 0"), (-0.1, "a positive number, got -0.1")]
)
def test_accuracy_of_the_model(accuracy, message):
    with pytest.raises(ValueError, match=f"accuracy: expected {message}"):
        rc.StokesianDynamics(order="auto", accuracy=accuracy)
