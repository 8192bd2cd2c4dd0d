"""Balance where rounding is all there is: loads that vanish by symmetry, and long chains with large held loads."""

import numpy as np
import pytest

import rheoclast as rc

MODELS = [rc.FreeDraining(), rc.ExposedArea(), *(rc.StokesianDynamics(order) for order in (1, 2, 3))]
SYMMETRIC = {
    "doublet": [[0, 0, 0], [2, 0, 0]],
    "chain along y": [[0, 2 * k, 0] for k in range(7)],
    "chain along a diagonal": [[2 * k / np.sqrt(3)] * 3 for k in range(12)],
    "chain far from the origin": [[1000 + 2 * k, 0, 0] for k in range(20)],
}


def aggregate(name):
    return rc.Aggregate.touching(rc.Spheres(1e-6 * np.array(SYMMETRIC[name], dtype=float), 1e-6))


@pytest.mark.parametrize("model", MODELS, ids=str)
@pytest.mark.parametrize("name", SYMMETRIC)
def test_every_strain_and_every_weight_is_accepted(name, model):
    """Some strains load nothing, and equal spheres settling alike press on none: totals are rounding over rounding."""
    chain = aggregate(name)
    response = rc.rigid_response(chain.spheres, model, viscosity=1e-3)
    assert np.isfinite(rc.contact_response(chain, response).map).all()
    for force in 1e-12 * np.eye(3):
        rc.contact_loads(chain, response.settling(force).net_loads)


@pytest.mark.parametrize("count", [100, 400])
def test_each_sphere_of_a_long_chain_is_in_balance(count):
    """Loads of the held chain are 10⁵ times those of the free one; what they leave must stay below 1e-10 of a load."""
    chain = rc.Aggregate.touching(rc.Spheres(np.outer(2.0 * np.arange(count), [1, 0, 0]), 1.0))
    loads = rc.rigid_response(chain.spheres, rc.StokesianDynamics(), viscosity=1.0).strain_loads
    carried = rc.contact_loads(chain, loads)
    force, torque = loads.force.copy(), loads.torque.copy()
    for sign, end in ((1, 0), (-1, 1)):
        sphere = chain.pairs[:, end]
        arm = chain.contact_points - chain.spheres.centers[sphere]
        for case in range(5):
            np.add.at(force[case], sphere, sign * carried.force[case])
            np.add.at(torque[case], sphere, sign * (np.cross(arm, carried.force[case]) + carried.moment[case]))
    largest = np.abs(loads.force).max()
    assert np.abs(force).max() < 1e-10 * largest
    assert np.abs(torque).max() < 1e-10 * largest
