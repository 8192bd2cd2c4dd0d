"""Every hydrodynamic model there is keeps the contract of its interface. A model that is not listed here fails."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast
import rheoclast as rc
from rheoclast.hydrodynamics.model import Approximation
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.dense import DenseCholesky

from ...agreement.clusters import sticking_cluster

ROUNDING = 1e-11  # condition numbers below 10⁴ and sums over spheres
RAYS = 4096
MODELS = {
    "free draining": (rc.FreeDraining(), ROUNDING),
    # A cap errs by rays^(−3/4), before and after the turn, on the most loaded sphere and on those that balance it.
    "exposed area": (rc.ExposedArea(RAYS), 4 * RAYS**-0.75),
    "order 1": (rc.StokesianDynamics(order=1), ROUNDING),
    "order 2": (rc.StokesianDynamics(order=2), ROUNDING),
    "order 5": (rc.StokesianDynamics(order=5), ROUNDING),
    "order auto": (rc.StokesianDynamics(order="auto"), ROUNDING),
}
SPHERES = rc.Spheres(*sticking_cluster(6, 8, (0.5, 1.3)))


def concrete_models():
    """All final descendants of `HydrodynamicModel` that the package defines, in whatever module."""
    for module in pkgutil.walk_packages(rheoclast.__path__, "rheoclast."):
        if module.name != "rheoclast.__main__":
            importlib.import_module(module.name)
    found, queue = set(), [rc.HydrodynamicModel]
    while queue:
        below = queue.pop().__subclasses__()
        queue.extend(below)
        found.update(c for c in below if c.__module__.startswith("rheoclast.") and not inspect.isabstract(c))
    return found


def test_every_model_is_tested():
    assert concrete_models() == {type(model) for model, _ in MODELS.values()}


@pytest.fixture(scope="module", params=MODELS)
def named(request):
    return request.param


@pytest.fixture(scope="module")
def response(named):
    return rc.rigid_response(SPHERES, MODELS[named][0], viscosity=1.0)


def stacked(loads):
    return np.concatenate([loads.force, loads.torque], axis=-1)


class TestEveryModel:
    def test_grand_resistance_is_symmetric_and_positive(self, response):
        """Reciprocity, and dissipation in every motion and strain."""
        grand = response.grand_resistance
        np.testing.assert_allclose(grand, grand.T, rtol=0, atol=ROUNDING * np.abs(grand).max())
        assert np.linalg.eigvalsh(grand).min() > 0

    def test_free_loads_balance(self, response):
        """No total force and torque about the centre in any of the five strains."""
        loads = response.strain_loads
        torque = loads.torque + np.cross(SPHERES.centers - response.center, loads.force)
        scale = np.abs(loads.force).max()
        assert np.abs(loads.force.sum(axis=1)).max() < ROUNDING * scale
        assert np.abs(torque.sum(axis=1)).max() < ROUNDING * scale

    def test_turns_with_the_aggregate(self, named, response):
        """Aggregate and flow turned together bear the same loads, turned."""
        model, accuracy = MODELS[named]
        turn = Rotation.from_rotvec([0.7, -1.9, 0.4])
        flow = rc.LinearFlow(np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]]))
        turned = rc.rigid_response(SPHERES.rotated(turn), model, viscosity=1.0)
        matrix = turn.as_matrix()
        flow_turned = rc.LinearFlow(matrix @ flow.gradient @ matrix.T)
        for ours, before in (
            (turned.loads(flow_turned), response.loads(flow)),
            (turned.held(flow_turned), response.held(flow)),
        ):
            scale = np.abs(stacked(before)).max()
            np.testing.assert_allclose(ours.force, before.force @ matrix.T, rtol=0, atol=accuracy * scale)
            np.testing.assert_allclose(ours.torque, before.torque @ matrix.T, rtol=0, atol=accuracy * scale)

    def test_shapes_and_orders_of_the_approximations(self, named):
        """(N, 11, 11) each, of increasing order, and frozen once they are in a response."""
        model = MODELS[named][0]
        approximations = model.elementary_loads(SPHERES.centers, SPHERES.radii)
        assert all(isinstance(each, Approximation) for each in approximations)
        assert all(each.loads.shape == (6, 11, 11) for each in approximations)
        orders = [each.order for each in approximations]
        assert orders == ([None] if orders[-1] is None else list(range(1, orders[-1] + 1)))

    def test_memory(self, named):
        """A number of bytes, known before anything is solved, that does not fall with the number of spheres."""
        memory = [MODELS[named][0].memory(count) for count in (1, 10, 100)]
        assert all(isinstance(each, float) for each in memory)
        assert memory == sorted(memory)
        assert memory[0] >= 0

    def test_is_a_value(self, named):
        """Equal settings make equal models, and nothing can be changed afterwards."""
        model = MODELS[named][0]
        assert model == type(model)(**vars(model))
        assert hash(model) == hash(type(model)(**vars(model)))
        name = next(iter(vars(model)), "order")
        with pytest.raises((AttributeError, TypeError)):
            setattr(model, name, 3)


class TestOrders:
    def test_stokesian_dynamics_keeps_all_lower_orders(self):
        """Order, model and spheres along the chain, down to order 1, below which there is nothing."""
        response = rc.rigid_response(SPHERES, rc.StokesianDynamics(order=4), viscosity=1.0)
        for order in (4, 3, 2, 1):
            assert response.order == order
            assert response.spheres is SPHERES
            alone = rc.rigid_response(SPHERES, rc.StokesianDynamics(order=order), viscosity=1.0)
            scale = np.abs(alone.table).max()
            np.testing.assert_allclose(response.table, alone.table, rtol=0, atol=ROUNDING * scale)
            assert not response.elementary_loads.flags.writeable
            response = response.coarser
        assert response is None

    @pytest.mark.parametrize("model", [rc.FreeDraining(), rc.ExposedArea()], ids=str)
    def test_simple_models_have_none(self, model):
        response = rc.rigid_response(SPHERES, model, viscosity=1.0)
        assert response.order is None
        assert response.coarser is None

    def test_contact_tables_follow(self):
        """The same chain, contact by contact, and each table that of its own response."""
        aggregate = rc.Aggregate.touching(SPHERES)
        response = rc.rigid_response(SPHERES, rc.StokesianDynamics(order=3), viscosity=1.0)
        table = rc.contact_response(aggregate, response)
        for order in (3, 2, 1):
            assert table.order == response.order == order
            alone = rc.contact_response(
                aggregate, rc.rigid_response(SPHERES, rc.StokesianDynamics(order=order), viscosity=1.0)
            )
            np.testing.assert_allclose(table.map, alone.map, rtol=0, atol=ROUNDING * np.abs(alone.map).max())
            table, response = table.coarser, response.coarser
        assert table is None
        simple = rc.contact_response(aggregate, rc.rigid_response(SPHERES, rc.FreeDraining(), viscosity=1.0))
        assert simple.order is None
        assert simple.coarser is None


class TestMemory:
    def test_models_without_a_matrix_need_none(self):
        assert rc.FreeDraining().memory(10_000) == 0
        assert rc.ExposedArea().memory(10_000) == 0

    @pytest.mark.parametrize("order", [1, 2, 3, 6])
    def test_holds_the_dense_matrix(self, order):
        """At least 8 bytes per element of the (N M)² matrix, and not twice that for many spheres."""
        matrix = 8 * (300 * MultipoleBasis(order).size) ** 2
        assert matrix <= rc.StokesianDynamics(order=order, solver=DenseCholesky()).memory(300) < 2 * matrix

    def test_automatic_order_states_its_first(self):
        assert rc.StokesianDynamics(order="auto").memory(50) == rc.StokesianDynamics(order=2).memory(50)
