"""Block conjugate gradients without the matrix ↔ dense Cholesky."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.stokes.automatic import Automatic
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.fast_mobility import fast_mobility
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.stokes.mobility import Mobility

from .clusters import sticking_cluster


def ball(count):
    """Sites of a face-centred cubic lattice nearest to one of them."""
    sites = np.array(np.meshgrid(*[np.arange(-4, 5)] * 3)).reshape(3, -1).T
    sites = sites[sites.sum(axis=1) % 2 == 0]
    return np.sqrt(2) * sites[np.argsort((sites**2).sum(axis=1), kind="stable")[:count]], np.ones(count)


CLUSTERS = {
    "tree": sticking_cluster(120, 1),
    "polydisperse": sticking_cluster(100, 2, (0.5, 1.5)),
    "chain": (np.outer(2.0 * np.arange(90), [0.6, 0, 0.8]), np.ones(90)),
    "ball": ball(79),
}


@pytest.fixture(scope="module", params=CLUSTERS)
def aggregate(request):
    return rc.Aggregate.touching(rc.Spheres(*CLUSTERS[request.param]))


def contact_table(aggregate, order, solver):
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(order, solver=solver), viscosity=1.0)
    return rc.contact_response(aggregate, response, rc.Bonds(1, 0.8, 6e-3, 8e-3)), response


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_fast_operator_is_the_mobility(order):
    """Faxén's closed form as compiled, or blocks stored, against the sum over pair blocks: nothing but rounding."""
    mobility = Mobility(*CLUSTERS["polydisperse"], MultipoleBasis(order))
    tractions = np.random.default_rng(order).normal(size=(100, mobility.basis.size, 4))
    expected = mobility @ tractions
    fast = fast_mobility(mobility, accuracy=1e-7)
    np.testing.assert_allclose(fast @ tractions, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("order", [2, 3, 4])
def test_lower_order_is_the_leading_part(order):
    """Nested: the lower order's operator is this one on its first modes, to rounding or, where one of the two goes
    through the octree, to its accuracy.
    """
    mobility = Mobility(*sticking_cluster(450, 7), MultipoleBasis(order))
    lower = MultipoleBasis(order - 1).size
    tractions = np.zeros((450, mobility.basis.size, 2))
    tractions[:, :lower] = np.random.default_rng(order).normal(size=(450, lower, 2))
    fast = fast_mobility(mobility, accuracy=1e-4)
    expected = (fast @ tractions)[:, :lower]
    found = fast.lowered() @ np.ascontiguousarray(tractions[:, :lower])
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize("order", [1, 2, 3])
def test_contact_loads_are_as_good_as_the_tolerance_says(aggregate, order):
    """Forces within five tolerances of the largest force; moments within five of it times the radius of a sphere.

    A straight chain is the exception: its moments are small remainders of large loads on the held chain, which cancel
    to one part in N². They are within two hundred tolerances.
    """
    straight = len(aggregate) == 90
    exact, _ = contact_table(aggregate, order, DenseCholesky())
    for tolerance in (1e-3, 1e-5, 1e-7):
        table, response = contact_table(aggregate, order, BlockConjugateGradients(tolerance))
        assert response.convergence.residual <= tolerance
        largest = np.abs(exact.force).max()
        assert np.abs(table.force - exact.force).max() < 5 * tolerance * largest
        assert np.abs(table.moment - exact.moment).max() < (200 if straight else 5) * tolerance * largest


def test_iterations_are_few(aggregate):
    """The factor of the inverse leaves a spectrum near one: without it the ball takes 80 iterations to 1e-6."""
    _, response = contact_table(aggregate, 2, BlockConjugateGradients(1e-6))
    assert response.convergence.iterations <= 20


def test_order_below_serves_the_error_bar(aggregate):
    """It is solved to 3e-3 of the loads only, which changes the bars, a tenth of the loads, by a few per cent."""
    exact, _ = contact_table(aggregate, 2, DenseCholesky())
    table, response = contact_table(aggregate, 2, BlockConjugateGradients(1e-6))
    assert response.coarser.order == 1
    flow = rc.simple_shear(1.0)
    ours, truth = rc.truncation_error(table, flow), rc.truncation_error(exact, flow)
    np.testing.assert_allclose(ours.tension, truth.tension, rtol=0, atol=0.05 * truth.tension.max())


def test_two_orders_below_serve_the_error_bar_of_higher_orders():
    """The bars of order 4, where the changes between orders are below a hundredth of the loads."""
    spread = rc.Aggregate.touching(rc.Spheres(*sticking_cluster(60, 8)))
    exact, _ = contact_table(spread, 4, DenseCholesky())
    table, response = contact_table(spread, 4, BlockConjugateGradients())
    assert [response.coarser.order, response.coarser.coarser.order] == [3, 2]
    flow = rc.simple_shear(1.0)
    ours, truth = rc.truncation_error(table, flow), rc.truncation_error(exact, flow)
    for load in ("tension", "shear", "bending", "twisting"):
        expected = getattr(truth, load)
        np.testing.assert_allclose(getattr(ours, load), expected, rtol=0, atol=0.1 * expected.max())


def test_automatic_choice():
    """Few unknowns go to the dense solver, which takes no iterations."""
    for count, order, iterative in ((20, 2, False), (120, 1, False), (80, 2, False), (200, 2, True), (150, 3, True)):
        mobility = Mobility(*sticking_cluster(count, 5), MultipoleBasis(order))
        solution = Automatic().solve(mobility, mobility.ambient_velocities())[-1]
        assert (solution.convergence.iterations > 0) == iterative


def test_refusals():
    with pytest.raises(ValueError, match="tolerance: expected a positive number, got 0"):
        BlockConjugateGradients(tolerance=0)


def test_progress_tells_the_residual():
    mobility = Mobility(*CLUSTERS["tree"], MultipoleBasis(2))
    steps = []
    BlockConjugateGradients().solve(mobility, mobility.ambient_velocities(), lambda *step: steps.append(step))
    assert "residual" in steps[-1][0]
    assert steps[-1][1] == 1.0


def test_far_field_serves_large_clusters(monkeypatch):
    """The path of clusters too large for direct sums, on a small one: contact loads stay within the tolerance."""
    monkeypatch.setattr("rheoclast.stokes.fast_mobility.FEWEST_IN_OCTREE", 100)
    centers, radii = sticking_cluster(450, 7)
    spread = rc.Aggregate.touching(rc.Spheres(centers, radii))
    exact, _ = contact_table(spread, 2, DenseCholesky())
    table, _ = contact_table(spread, 2, BlockConjugateGradients(1e-5))
    assert np.abs(table.force - exact.force).max() < 3e-5 * np.abs(exact.force).max()
    assert np.abs(table.moment - exact.moment).max() < 3e-5 * np.abs(exact.moment).max()
