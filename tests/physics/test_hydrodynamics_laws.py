"""Laws that every hydrodynamic model must obey, on irregular clusters and for every model and order."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.vectors import strain_components

DIRECTIONS = np.array([[-6.0, -3, 2], [-2, 1, -2], [2, -6, -3], [1, 2, 2], [-1, -4, 8], [4, 4, -7]])
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)
HOSTS = [0, 1, 1, 0, 4, 4]


def branched(radii):
    """A branched tree of seven touching spheres that has no symmetry."""
    centers = [np.array([0.3, -0.7, 1.1])]
    for new, (host, direction) in enumerate(zip(HOSTS, DIRECTIONS, strict=True), start=1):
        centers.append(centers[host] + (radii[host] + radii[new]) * direction)
    return rc.Spheres(np.array(centers), radii)


SPHERES = {
    "equal": branched(np.ones(7)),
    "polydisperse": branched(np.array([1.0, 0.6, 1.3, 0.8, 0.5, 1.1, 0.7])),
}
MODELS = {
    "free draining": rc.FreeDraining(),
    "order 1": rc.StokesianDynamics(order=1),
    "order 2": rc.StokesianDynamics(order=2),
    "order 3": rc.StokesianDynamics(order=3),
    "order 4": rc.StokesianDynamics(order=4),
}
GRADIENT = np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]])
FLOW = rc.LinearFlow(GRADIENT)
ROUNDING = 1e-11  # condition numbers below 10³ times 1e-16, and room for sums


@cache
def respond(cluster, model, viscosity=1.0):
    return rc.rigid_response(SPHERES[cluster], MODELS[model], viscosity=viscosity)


@pytest.fixture(params=SPHERES)
def cluster(request):
    return request.param


@pytest.fixture(params=MODELS)
def model(request):
    return request.param


@pytest.fixture
def response(cluster, model):
    return respond(cluster, model)


def close(ours, expected, tolerance=ROUNDING, scale=None):
    scale = np.abs(expected).max() if scale is None else scale
    np.testing.assert_allclose(ours, expected, rtol=0, atol=tolerance * scale)


def total(loads, spheres, point):
    """Force and torque about `point` of all loads together, (6,)."""
    torque = loads.torque + np.cross(spheres.centers - point, loads.force)
    return np.concatenate([loads.force.sum(axis=0), torque.sum(axis=0)])


def stacked(loads):
    return np.concatenate([loads.force, loads.torque], axis=-1)


def ambient(flow, point):
    """The flow on the eleven unit flows about a point, (11,)."""
    return np.concatenate([flow.velocity(point), flow.angular_velocity, strain_components(flow.strain_rate)])


class TestReciprocityAndDissipation:
    def test_grand_resistance_is_symmetric(self, response):
        """Lorentz' reciprocal theorem."""
        close(response.grand_resistance, response.grand_resistance.T)

    def test_grand_resistance_dissipates(self, response):
        """Power is spent in every motion and strain: all eigenvalues positive."""
        assert np.linalg.eigvalsh(response.grand_resistance).min() > 0

    def test_freely_suspended_aggregate_dissipates(self, response):
        """Force and torque do no work on a free aggregate; E : S > 0 is what it costs the fluid, in every strain."""
        grand = response.grand_resistance
        free = grand[6:, 6:] - grand[6:, :6] @ response.mobility @ grand[:6, 6:]
        assert np.linalg.eigvalsh(free).min() > 0
        assert response.intrinsic_viscosity > 0

    def test_settling_force_does_work(self, response):
        for force in np.eye(3):
            assert force @ response.settling(force).velocity > 0

    def test_mobility_and_resistance_are_inverse(self, response):
        close(response.mobility @ response.resistance, np.eye(6))
        close(response.resistance, response.grand_resistance[:6, :6])

    def test_resistance_grows_with_order(self, cluster):
        """Order p is the largest dissipation its modes allow, and order p + 1 has all its modes and more."""
        for order in (1, 2, 3):
            step = (
                respond(cluster, f"order {order + 1}").grand_resistance
                - respond(cluster, f"order {order}").grand_resistance
            )
            assert np.linalg.eigvalsh(step).min() > 0

    def test_more_spheres_resist_more(self, cluster):
        """Hill & Power: a body resists less than one that contains it, here with one sphere more.

        Both are brought to one centre by moving the reference point: streams at the old centre are streams, spins and
        strains at the new.
        """
        spheres = SPHERES[cluster]
        whole = respond(cluster, "order 3")
        for left_out in range(2, len(spheres)):
            kept = np.delete(np.arange(len(spheres)), left_out)
            rest = rc.Spheres(spheres.centers[kept], spheres.radii[kept])
            part = rc.rigid_response(rest, MODELS["order 3"], viscosity=1.0)
            moved = np.eye(11)
            offset = part.center - whole.center
            moved[:3, 3:6] = np.cross(np.eye(3), offset).T
            moved[:3, 6:] = (rc.vectors.STRAIN_BASIS @ offset).T
            gain = whole.grand_resistance - moved.T @ part.grand_resistance @ moved
            assert np.linalg.eigvalsh(gain).min() > 0

    def test_enclosing_sphere_resists_more(self, cluster):
        """Hill & Power again, against exact laws: 6πR, 8πR³, 20/3 πR³ of the enclosing sphere bound all orders."""
        spheres = SPHERES[cluster]
        response = respond(cluster, "order 4")
        reach = (np.linalg.norm(spheres.centers - response.center, axis=1) + spheres.radii).max()
        bound = np.pi * np.diag(np.repeat([6 * reach, 8 * reach**3, 20 / 3 * reach**3], [3, 3, 5]))
        assert np.linalg.eigvalsh(bound - response.grand_resistance).min() > 0


class TestFreeAggregate:
    def test_total_force_and_torque_vanish(self, response):
        """To 1e-12 of the largest load; torques collect levers of up to six radii."""
        loads = response.loads(FLOW)
        assert np.abs(total(loads, response.spheres, response.center)).max() < 1e-12 * 10 * np.abs(loads.force).max()

    def test_loads_do_not_depend_on_the_origin(self, cluster, model):
        spheres, shift = SPHERES[cluster], np.array([11.0, -7, 5])
        here = respond(cluster, model)
        there = rc.rigid_response(rc.Spheres(spheres.centers + shift, spheres.radii), MODELS[model], viscosity=1.0)
        close(stacked(there.loads(FLOW)), stacked(here.loads(FLOW)))
        close(there.grand_resistance, here.grand_resistance)
        close(there.motion(FLOW).angular_velocity, here.motion(FLOW).angular_velocity)
        close(there.motion(FLOW).velocity, here.motion(FLOW).velocity + FLOW.velocity(shift))

    def test_turning_fluid_carries_it_along_without_loads(self, response):
        """Solid rotation of the fluid, Ω = ω and U = ω × x, and no load anywhere."""
        spin = np.array([0.4, -1.2, 0.9])
        flow = rc.LinearFlow(rc.vectors.cross_matrix(spin))
        motion = response.motion(flow)
        close(motion.angular_velocity, spin)
        close(motion.velocity, np.cross(spin, response.center))
        assert np.abs(stacked(response.loads(flow))).max() < 1e-12

    def test_loads_are_those_of_the_aggregate_held_in_the_flow_it_sees(self, cluster, model):
        """In the frame of the aggregate the flow is Γ·x − U − Ω×(x − c), at rest where it vanishes.

        Put with that point at the origin and held still, the aggregate bears what it bears in free suspension.
        """
        spheres, response = SPHERES[cluster], respond(cluster, model)
        motion = response.motion(FLOW)
        seen = rc.LinearFlow(GRADIENT - rc.vectors.cross_matrix(motion.angular_velocity))
        offset = np.linalg.solve(seen.gradient, FLOW.velocity(response.center) - motion.velocity)
        moved = rc.Spheres(spheres.centers - response.center + offset, spheres.radii)
        held = rc.rigid_response(moved, MODELS[model], viscosity=1.0).held(seen)
        close(stacked(held), stacked(response.loads(FLOW)))

    def test_loads_are_the_contraction_of_the_table(self, response):
        strain = strain_components(FLOW.strain_rate)
        close(response.table @ strain, stacked(response.loads(FLOW)))
        close(np.moveaxis(stacked(response.strain_loads), 0, -1), response.table)

    def test_couplings_give_the_motion(self, response):
        motion, strain = response.motion(FLOW), FLOW.strain_rate
        turning = FLOW.angular_velocity + np.einsum("ijk,jk->i", response.rotation_coupling, strain)
        moving = FLOW.velocity(response.center) + np.einsum("ijk,jk->i", response.translation_coupling, strain)
        close(motion.angular_velocity, turning)
        close(motion.velocity, moving)


class TestHeldAggregate:
    def test_loads_add_up_to_the_grand_resistance(self, response):
        """Held in a flow, the whole bears the grand resistance times the flow at its centre: signs and basis agree."""
        expected = response.grand_resistance[:6] @ ambient(FLOW, response.center)
        close(total(response.held(FLOW), response.spheres, response.center), expected)

    def test_loads_do_depend_on_the_origin(self, cluster):
        """Moved by s, it is held in a stream Γ·s more: the force grows by resistance · (Γ·s)."""
        spheres, shift = SPHERES[cluster], np.array([1.0, -2, 3])
        here = respond(cluster, "order 2")
        there = rc.rigid_response(rc.Spheres(spheres.centers + shift, spheres.radii), MODELS["order 2"], viscosity=1.0)
        growth = there.held(FLOW).force.sum(axis=0) - here.held(FLOW).force.sum(axis=0)
        close(growth, here.resistance[:3, :3] @ FLOW.velocity(shift), tolerance=1e-10)


class TestSettling:
    FORCE = np.array([0.6, -0.3, -1.1])

    def test_fluid_balances_the_force_and_no_torque(self, response):
        loads = response.settling(self.FORCE).loads
        close(total(loads, response.spheres, response.center), np.concatenate([-self.FORCE, np.zeros(3)]))

    def test_motion_is_the_mobility_times_the_force(self, response):
        settling = response.settling(self.FORCE)
        expected = response.mobility[:, :3] @ self.FORCE
        close(np.concatenate([settling.velocity, settling.angular_velocity]), expected)

    def test_stresslet_and_drift_are_reciprocal(self, response):
        """A settling body strains the fluid as a strained one drifts: F · (drift in E) = E : S of settling.

        S of settling is R_SF · (−U, −Ω); drift is the velocity in the strain beyond the fluid's. Free draining of equal
        spheres has none, hence the bound from the force and the strain (spheres of radius about one).
        """
        settling = response.settling(self.FORCE)
        moving = np.concatenate([settling.velocity, settling.angular_velocity])
        stresslet = response.grand_resistance[6:, :6] @ moving
        drift = np.einsum("ijk,jk->i", response.translation_coupling, FLOW.strain_rate)
        size = np.linalg.norm(self.FORCE) * np.linalg.norm(FLOW.strain_rate)
        difference = self.FORCE @ drift - stresslet @ strain_components(FLOW.strain_rate)
        assert abs(difference) < 1e-12 * size


class TestInvariance:
    @pytest.mark.parametrize("seed", [1, 2])
    @pytest.mark.parametrize("handedness", [1, -1])
    def test_turning_or_mirroring_everything(self, cluster, model, seed, handedness):
        """Aggregate and flow turned together: vectors turn, and axial vectors change sign in a mirror besides."""
        turn = handedness * Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
        spheres, here = SPHERES[cluster], respond(cluster, model)
        turned = rc.rigid_response(rc.Spheres(spheres.centers @ turn.T, spheres.radii), MODELS[model], viscosity=1.0)
        flow = rc.LinearFlow(turn @ GRADIENT @ turn.T)
        for name in ("loads", "held"):
            old, new = getattr(here, name)(FLOW), getattr(turned, name)(flow)
            close(new.force, old.force @ turn.T)
            close(new.torque, handedness * old.torque @ turn.T, scale=np.abs(stacked(old)).max())
        close(turned.motion(flow).velocity, turn @ here.motion(FLOW).velocity)
        close(turned.motion(flow).angular_velocity, handedness * turn @ here.motion(FLOW).angular_velocity)
        assert turned.hydrodynamic_radius == pytest.approx(here.hydrodynamic_radius, rel=ROUNDING)
        assert turned.intrinsic_viscosity == pytest.approx(here.intrinsic_viscosity, rel=ROUNDING)

    def test_units(self, cluster, model):
        """μ = 1e-3 Pa s, lengths times 1e-6, rates times 1e5: force μ ℓ² γ, torque μ ℓ³ γ, resistances by dimension."""
        viscosity, length, rate = 1e-3, 1e-6, 1e5
        spheres, here = SPHERES[cluster], respond(cluster, model)
        small = rc.rigid_response(
            rc.Spheres(length * spheres.centers, length * spheres.radii), MODELS[model], viscosity=viscosity
        )
        old, new = here.loads(FLOW), small.loads(rc.LinearFlow(rate * GRADIENT))
        close(new.force, viscosity * length**2 * rate * old.force)
        close(
            new.torque,
            viscosity * length**3 * rate * old.torque,
            scale=viscosity * length**3 * rate * np.abs(old.force).max(),
        )
        power = length ** np.repeat([0, 1], [3, 8])
        expected = viscosity * length * np.outer(power, power) * here.grand_resistance
        scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
        close(small.grand_resistance / scale, expected / scale)
        assert small.hydrodynamic_radius / length == pytest.approx(here.hydrodynamic_radius, rel=ROUNDING)
        assert small.intrinsic_viscosity == pytest.approx(here.intrinsic_viscosity, rel=ROUNDING)
        close(small.rotation_coupling, here.rotation_coupling)
        close(small.translation_coupling, length * here.translation_coupling, scale=length)
        force = np.array([1e-12, 2e-12, -1e-12])
        factor = 1 / (viscosity * length)
        falling = factor * here.settling(force).velocity
        close(small.settling(force).velocity, falling)
        turning = factor / length * here.settling(force).angular_velocity
        close(small.settling(force).angular_velocity, turning, scale=np.linalg.norm(falling) / length)
        close(small.settling(force).loads.force, here.settling(force).loads.force)

    def test_numbering_of_spheres(self, cluster, model):
        spheres, here = SPHERES[cluster], respond(cluster, model)
        shuffled = np.random.default_rng(5).permutation(len(spheres))
        there = rc.rigid_response(
            rc.Spheres(spheres.centers[shuffled], spheres.radii[shuffled]), MODELS[model], viscosity=1.0
        )
        close(there.table, here.table[shuffled])
        close(there.grand_resistance, here.grand_resistance)

    def test_loads_are_linear_in_the_flow(self, response):
        other = rc.LinearFlow(GRADIENT[::-1, ::-1].T)
        both = rc.LinearFlow(2 * GRADIENT - 3 * other.gradient)
        for loads in (response.loads, response.held):
            close(stacked(loads(both)), 2 * stacked(loads(FLOW)) - 3 * stacked(loads(other)))

    def test_settling_is_linear_in_the_force(self, response):
        first, second = np.array([1.0, 2, -1]), np.array([0.5, -1, 3])
        both = response.settling(2 * first - 3 * second)
        close(both.velocity, 2 * response.settling(first).velocity - 3 * response.settling(second).velocity)


def test_centre_is_the_centre_of_volume(cluster):
    spheres = SPHERES[cluster]
    by_hand = (spheres.radii**3) @ spheres.centers / np.sum(spheres.radii**3)
    close(respond(cluster, "order 2").center, by_hand)
