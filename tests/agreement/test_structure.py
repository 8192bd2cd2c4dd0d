"""Independent routes to the contact loads meet: dense frame, linear map, sampling of orientations."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.vectors import STRAIN_BASIS

VISCOSITY = 1e-3
MODELS = {"free draining": rc.FreeDraining(), "order 2": rc.StokesianDynamics(order=2)}


def compact(seed, radius=1.0):
    """Random polydisperse hyperstatic cluster: part of a cubic lattice with jitter, gaps and overlaps."""
    rng = np.random.default_rng(seed)
    lattice = [(x, y, z) for x in range(3) for y in range(2) for z in range(3)]
    sites = [(1, 1, 1)]
    while len(sites) < 12:
        beside = [site for site in lattice if site not in sites and any(math.dist(site, s) == 1 for s in sites)]
        sites.append(beside[rng.integers(len(beside))])
    centers = 2.0 * np.array(sites) + rng.uniform(-0.03, 0.03, (12, 3))
    spheres = rc.Spheres(radius * centers, radius * rng.uniform(0.95, 1.05, 12), overlap_tolerance=0.3)
    return rc.Aggregate.touching(spheres, tolerance=0.3)


def zigzag(radius=1.0):
    """Tree of seven unequal touching spheres, bent in three dimensions."""
    radii = np.array([1.0, 0.7, 1.3, 1.0, 0.6, 1.1, 0.9])
    steps = np.array([[2, 1, 0], [1, 0, 2], [2, -1, 1], [0, 2, 1], [2, 2, -1], [1, 0, -2]], dtype=float)
    steps *= ((radii[1:] + radii[:-1]) / np.linalg.norm(steps, axis=1))[:, None]
    centers = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    return rc.Aggregate.touching(rc.Spheres(radius * centers, radius * radii))


def spring_constants(aggregate, seed, radius=1.0):
    """Stiffness (C, 4) of the normal, tangential, bending and twisting springs over two decades."""
    stiffness = 10 ** np.random.default_rng(seed).uniform(-1, 1, (len(aggregate.pairs), 4))
    return stiffness * np.array([1.0, 1.0, radius**2, radius**2])


def as_bonds(stiffness):
    return rc.Bonds(
        normal=stiffness[:, 0], tangential=stiffness[:, 1], bending=stiffness[:, 2], twisting=stiffness[:, 3]
    )


def dense_frame_loads(aggregate, loads, stiffness):
    """Contact forces and moments (C, 3) from a dense stiffness matrix (6 N, 6 N), assembled spring by spring.

    Each spring is one row: its elongation per velocity-like freedom of the two spheres. The matrix is singular by
    the six rigid motions; least squares picks the displacement without them, which does not affect the springs.
    """
    spheres, rows, constants, directions = len(aggregate), [], [], []
    for c, (i, j) in enumerate(aggregate.pairs):
        normal, point = aggregate.normals[c], aggregate.contact_points[c]
        first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
        first /= np.linalg.norm(first)
        for direction, translation, rotation in (
            (normal, stiffness[c, 0], stiffness[c, 3]),
            (first, stiffness[c, 1], stiffness[c, 2]),
            (np.cross(normal, first), stiffness[c, 1], stiffness[c, 2]),
        ):
            slide, turn = np.zeros((2, spheres, 6))
            for sphere, sign in ((i, -1.0), (j, 1.0)):
                slide[sphere, :3] = sign * direction
                arm = point - aggregate.spheres.centers[sphere]
                for axis in range(3):
                    slide[sphere, 3 + axis] = sign * direction @ np.cross(np.eye(3)[axis], arm)
                turn[sphere, 3:] = sign * direction
            rows += [slide.ravel(), turn.ravel()]
            constants += [translation, rotation]
            directions += [(c, 0, direction), (c, 3, direction)]
    elongation, constant = np.array(rows), np.array(constants)
    matrix = elongation.T @ (constant[:, None] * elongation)
    right = np.concatenate([loads.force, loads.torque], axis=1).ravel()
    displacement = np.linalg.lstsq(matrix, right, rcond=1e-13)[0]
    carried = np.zeros((len(aggregate.pairs), 6))
    for (c, start, direction), load in zip(directions, constant * (elongation @ displacement), strict=True):
        carried[c, start : start + 3] += load * direction
    return carried[:, :3], carried[:, 3:]


def balanced_loads(aggregate, seed):
    rng = np.random.default_rng(seed)
    force, torque = rng.normal(size=(2, len(aggregate), 3))
    force -= force.mean(axis=0)
    torque -= (np.cross(aggregate.spheres.centers, force) + torque).mean(axis=0)
    return rc.SphereLoads(force, torque)


def random_flow(rng, rate=1.0):
    gradient = rate * rng.normal(size=(3, 3))
    return rc.LinearFlow(gradient - np.trace(gradient) / 3 * np.eye(3))


def table_of(aggregate, model, bonds=None):
    response = rc.rigid_response(aggregate.spheres, MODELS[model], viscosity=VISCOSITY)
    return response, rc.contact_response(aggregate, response, bonds)


@pytest.mark.parametrize("seed", range(6))
def test_contact_loads_equal_a_dense_frame(seed):
    """The sparse solution is that of the defining springs, one by one; rounding is 1e-16 times a condition of 1e4."""
    aggregate = compact(seed)
    assert aggregate.hyperstaticity > 0
    stiffness, loads = spring_constants(aggregate, seed + 100), balanced_loads(aggregate, seed + 200)
    force, moment = dense_frame_loads(aggregate, loads, stiffness)
    carried = rc.contact_loads(aggregate, loads, as_bonds(stiffness))
    size = max(np.abs(force).max(), np.abs(moment).max())
    np.testing.assert_allclose(carried.force, force, atol=1e-10 * size)
    np.testing.assert_allclose(carried.moment, moment, atol=1e-10 * size)


def test_one_stiffness_for_all_contacts_equals_one_each():
    """A single value is spread over all contacts."""
    aggregate = compact(1)
    loads, count = balanced_loads(aggregate, 2), len(aggregate.pairs)
    single = rc.Bonds(normal=3.0, tangential=2.0, bending=0.1, twisting=0.2)
    force, moment = dense_frame_loads(aggregate, loads, np.tile([3.0, 2.0, 0.1, 0.2], (count, 1)))
    carried = rc.contact_loads(aggregate, loads, single)
    np.testing.assert_allclose(carried.force, force, atol=1e-10 * np.abs(force).max())
    np.testing.assert_allclose(carried.moment, moment, atol=1e-10 * np.abs(force).max())


@pytest.mark.parametrize("method", ["auto", "statics", "springs"])
def test_all_methods_on_a_tree_equal_a_dense_frame(method):
    """Three routes and the springs one by one."""
    aggregate = zigzag()
    stiffness, loads = spring_constants(aggregate, 3), balanced_loads(aggregate, 4)
    force, moment = dense_frame_loads(aggregate, loads, stiffness)
    carried = rc.contact_loads(aggregate, loads, as_bonds(stiffness), method=method)
    size = max(np.abs(force).max(), np.abs(moment).max())
    np.testing.assert_allclose(carried.force, force, atol=1e-10 * size)
    np.testing.assert_allclose(carried.moment, moment, atol=1e-10 * size)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("shape", ["tree", "cluster"])
def test_contact_response_equals_contact_loads(model, shape):
    """One table gives, for any flow and orientation, what the loads of that flow give: in SI, micrometre spheres."""
    aggregate = zigzag(1e-6) if shape == "tree" else compact(3, 1e-6)
    bonds = None if shape == "tree" else as_bonds(spring_constants(aggregate, 5, 1e-6))
    response, table = table_of(aggregate, model, bonds)
    contacts = len(aggregate.pairs)
    assert table.force.shape == table.moment.shape == (contacts, 3, 5)
    np.testing.assert_array_equal(table.map, np.concatenate([table.force, table.moment], axis=1))
    rng = np.random.default_rng(6)
    for turn in Rotation.random(6, rng=rng):
        flow = random_flow(rng, 1e5).rotated(turn)
        expected = rc.contact_loads(aggregate, response.loads(flow), bonds)
        carried = table.loads(flow)
        strain = np.einsum("kij,ij->k", STRAIN_BASIS, flow.strain_rate)
        force_size, moment_size = np.abs(expected.force).max(), np.abs(expected.moment).max()
        for force, moment in ((carried.force, carried.moment), (table.force @ strain, table.moment @ strain)):
            np.testing.assert_allclose(force, expected.force, rtol=0, atol=1e-9 * force_size)
            np.testing.assert_allclose(moment, expected.moment, rtol=0, atol=1e-9 * moment_size)
        by_tensor = np.einsum("cij,ij->c", table.tension, flow.strain_rate)
        for tension in (carried.tension, by_tensor):
            np.testing.assert_allclose(tension, expected.tension, rtol=0, atol=1e-9 * force_size)
        for name in ("shear", "bending", "twisting"):
            size = force_size if name == "shear" else moment_size
            np.testing.assert_allclose(getattr(carried, name), getattr(expected, name), rtol=0, atol=1e-9 * size)


@pytest.mark.parametrize("model", MODELS)
def test_tension_tensors_are_symmetric_and_traceless(model):
    """Only then are they the unique tensors of the tension, and their eigenvalues its extremes."""
    aggregate = compact(4, 1e-6)
    _, table = table_of(aggregate, model, as_bonds(spring_constants(aggregate, 6, 1e-6)))
    size = np.abs(table.tension).max()
    assert table.tension.shape == (len(aggregate.pairs), 3, 3)
    np.testing.assert_allclose(table.tension, table.tension.transpose(0, 2, 1), rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(np.trace(table.tension, axis1=1, axis2=2), 0, rtol=0, atol=1e-14 * size)


FLOWS = {
    "shear": rc.simple_shear(1e4),
    "uniaxial": rc.uniaxial_extension(1e4),
    "biaxial": rc.biaxial_extension(1e4),
    "planar": rc.planar_extension(1e4),
    "any": random_flow(np.random.default_rng(12), 1e4),
}


@pytest.fixture(scope="module", params=["tree", "cluster"])
def tabulated(request):
    aggregate = zigzag(1e-6) if request.param == "tree" else compact(5, 1e-6)
    bonds = None if request.param == "tree" else as_bonds(spring_constants(aggregate, 7, 1e-6))
    return (aggregate, bonds, *table_of(aggregate, "order 2", bonds))


@pytest.mark.parametrize("name", FLOWS)
def test_worst_tension_against_sampled_orientations(tabulated, name):
    """No one of 10⁵ random orientations is worse, and the worst of them comes within 1 %.

    The largest sampled tension falls short by about the square of the angle to the nearest sample: 10⁵ rotations leave
    about (8 π²/10⁵)^⅓/2 = 0.05 rad, a few parts in a thousand.
    """
    *_, table = tabulated
    flow, worst = FLOWS[name], table.worst_tension(FLOWS[name])
    turn = Rotation.random(100_000, rng=np.random.default_rng(8)).as_matrix()
    strain = turn @ flow.strain_rate @ turn.transpose(0, 2, 1)
    sampled = (table.tension.reshape(-1, 9) @ strain.reshape(-1, 9).T).max(axis=1)
    assert worst.shape == (len(table.tension),)
    assert (sampled <= worst * (1 + 1e-12)).all()
    assert (sampled >= 0.99 * worst).all()


@pytest.mark.parametrize("name", FLOWS)
def test_worst_orientation_attains_the_worst_tension(tabulated, name):
    """Turned by R[c], the flow puts exactly the worst tension on contact c; loads are solved anew."""
    aggregate, bonds, response, table = tabulated
    flow = FLOWS[name]
    worst, orientation = table.worst_tension(flow), table.worst_orientation(flow)
    assert orientation.shape == (len(aggregate.pairs), 3, 3)
    for c, turn in enumerate(orientation):
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-13)
        assert np.linalg.det(turn) == pytest.approx(1.0)
        turned = flow.rotated(turn)
        anew = rc.contact_loads(aggregate, response.loads(turned), bonds)
        size = np.abs(anew.force).max()
        assert table.loads(turned).tension[c] == pytest.approx(worst[c], rel=1e-10, abs=1e-10 * size)
        assert anew.tension[c] == pytest.approx(worst[c], rel=1e-9, abs=1e-9 * size)


def test_worst_tension_does_not_depend_on_where_one_starts(tabulated):
    """The flow turned beforehand, or with another vorticity, has the same worst tension; twice as fast, twice."""
    *_, table = tabulated
    flow = FLOWS["any"]
    worst = table.worst_tension(flow)
    turn = Rotation.from_rotvec([0.3, 2.0, -1.0])
    np.testing.assert_allclose(table.worst_tension(flow.rotated(turn)), worst, rtol=1e-12)
    np.testing.assert_allclose(table.worst_tension(rc.LinearFlow(flow.strain_rate)), worst, rtol=1e-12)
    np.testing.assert_allclose(table.worst_tension(flow.scaled(2.0)), 2 * worst, rtol=1e-12)


def test_extension_is_twice_as_bad_as_shear(tabulated):
    """Planar extension and simple shear of equal rate: strain rates ±1 against ±1/2."""
    *_, table = tabulated
    np.testing.assert_allclose(
        table.worst_tension(FLOWS["planar"]), 2 * table.worst_tension(FLOWS["shear"]), rtol=1e-12
    )


def test_doublet_in_free_draining_extension():
    """Two spheres on the axis of a uniaxial extension: Stokes drag 6πμa·(ε̇ a) on each pulls the contact.

    The centre of mass is at rest, so each centre lags the fluid by ε̇ a along the axis, its distance from the middle.
    """
    radius, rate = 0.5e-6, 1e4
    doublet = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [0, 0, 2 * radius]], radius))
    _, table = table_of(doublet, "free draining")
    pull = 6 * np.pi * VISCOSITY * radius * (rate * radius)
    flow = rc.uniaxial_extension(rate)
    assert table.loads(flow).tension[0] == pytest.approx(pull, rel=1e-10)
    assert table.worst_tension(flow)[0] == pytest.approx(pull, rel=1e-10)
    assert table.worst_tension(rc.planar_extension(rate))[0] == pytest.approx(pull, rel=1e-10)
    assert table.worst_tension(rc.biaxial_extension(rate))[0] == pytest.approx(pull, rel=1e-10)


@pytest.mark.parametrize("order", [1, 2])
def test_loads_that_vanish_by_symmetry_count_as_balanced(order):
    """A doublet across the strain carries nothing: its loads are rounding, and no reason to refuse them."""
    turn = Rotation.random(random_state=3).as_matrix()
    doublet = rc.Aggregate.touching(rc.Spheres(1e-6 * np.array([[0, 0, -1.0], [0, 0, 1.0]]) @ turn.T, 1e-6))
    response = rc.rigid_response(doublet.spheres, rc.StokesianDynamics(order), viscosity=1e-3)
    along = rc.contact_loads(doublet, response.loads(rc.uniaxial_extension(1.0).rotated(turn)))
    across = rc.contact_loads(doublet, response.loads(rc.planar_extension(1.0).rotated(turn)))
    assert abs(across.tension[0]) < 1e-12 * along.tension[0]
    table = rc.contact_response(doublet, response)
    assert table.worst_tension(rc.uniaxial_extension(1.0))[0] == pytest.approx(along.tension[0], rel=1e-9)
