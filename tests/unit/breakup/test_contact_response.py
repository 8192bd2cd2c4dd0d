"""The linear map from flow to contact loads, for one flow and for many at once."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import strain_components


@pytest.fixture(scope="module")
def table():
    floc = rc.generation.cluster_cluster(12, 1.0, seed=3)
    return rc.contact_response(floc, rc.rigid_response(floc.spheres, rc.FreeDraining(), 1.0))


def test_many_flows_at_once_are_each_alone(table):
    flows = [[rc.simple_shear(rate), rc.uniaxial_extension(rate), rc.planar_extension(rate)] for rate in (1.0, 2.5)]
    components = np.array([[strain_components(flow.strain_rate) for flow in row] for row in flows])
    together = table.loads_of(components)
    for k, row in enumerate(flows):
        for m, flow in enumerate(row):
            alone = table.loads(flow)
            for name in ("force", "moment"):
                by_hand = np.einsum("cik,k->ci", getattr(table, name), components[k, m])
                np.testing.assert_allclose(getattr(alone, name), by_hand, atol=1e-12)
                np.testing.assert_allclose(getattr(together, name)[k, m], by_hand, atol=1e-12)


def test_by_order_as_solved_at_each():
    floc, bonds = rc.generation.random_packed_ball(8, 1.0, seed=1), rc.Bonds(1.0, 0.8, 6e-3, 8e-3)
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(3), 1.0)
    table = rc.contact_response(floc, response, bonds)
    assert [each.order for each in table.by_order] == [1, 2, 3]
    assert table.by_order[-1] is table
    for each, order in zip(table.by_order, response.by_order, strict=True):
        loads = rc.contact_loads(floc, order.loads(rc.simple_shear(1.0)), bonds)
        scale = np.abs(loads.force).max()
        np.testing.assert_allclose(each.loads(rc.simple_shear(1.0)).force, loads.force, atol=1e-9 * scale)


@pytest.mark.parametrize(
    ("normals", "force", "moment", "message"),
    [
        ((1, 3), (7, 3, 5), (1, 3, 5), r"force: expected shape \(1, 3, 5\), got \(7, 3, 5\)"),
        ((2, 3), (2, 3, 5), (2, 3, 4), r"moment: expected shape \(2, 3, 5\), got \(2, 3, 4\)"),
        ((2, 2), (2, 3, 5), (2, 3, 5), r"normals: expected shape \(C, 3\), got \(2, 2\)"),
    ],
)
def test_refused_shapes(normals, force, moment, message):
    with pytest.raises(ValueError, match=message):
        rc.ContactResponse(*map(np.ones, (normals, force, moment)))
