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
