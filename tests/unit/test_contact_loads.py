"""Contact loads and bonds seen from outside: signs by hand on two spheres, and what is refused."""

import dataclasses

import numpy as np
import pytest

import rheoclast as rc

ALONG, ACROSS, UP = np.eye(3)
DOUBLET = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [4, 0, 0]], [1.0, 3.0]))
CHAIN = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1.0))
TRIANGLE = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]], 1.0))
ALIKE = {"normal": 1.0, "tangential": 1.0, "bending": 1.0, "twisting": 1.0}
ZEROS = np.zeros((3, 3))
PULLED = np.array([-ALONG, ALONG, 0 * ALONG])

METHODS = pytest.mark.parametrize("method", ["statics", "springs"])


def doublet_loads(method, force, torque):
    bonds = rc.Bonds(normal=50.0, tangential=20.0, bending=0.3, twisting=0.7)
    return rc.contact_loads(DOUBLET, rc.SphereLoads(np.array(force), np.array(torque)), bonds, method=method)


@METHODS
def test_pulled_apart_is_positive_tension(method):
    """Sphere 1 pulls sphere 0 towards itself, along n, to hold it against its own load."""
    carried = doublet_loads(method, [-2 * ALONG, 2 * ALONG], np.zeros((2, 3)))
    np.testing.assert_allclose(carried.force, [2 * ALONG], atol=1e-13)
    np.testing.assert_allclose(carried.moment, [0 * ALONG], atol=1e-13)
    np.testing.assert_allclose([carried.tension[0], carried.shear[0]], [2, 0], atol=1e-13)
    np.testing.assert_allclose([carried.bending[0], carried.twisting[0]], [0, 0], atol=1e-13)


@METHODS
def test_pushed_together_is_negative_tension(method):
    """Compression has the other sign."""
    carried = doublet_loads(method, [2 * ALONG, -2 * ALONG], np.zeros((2, 3)))
    assert carried.tension[0] == pytest.approx(-2)


@METHODS
def test_opposite_torques_about_the_axis_twist(method):
    """The moment that sphere 1 exerts on sphere 0 balances the torque on sphere 0."""
    carried = doublet_loads(method, np.zeros((2, 3)), [-5 * ALONG, 5 * ALONG])
    np.testing.assert_allclose(carried.moment, [5 * ALONG], atol=1e-12)
    np.testing.assert_allclose([carried.bending[0], carried.twisting[0]], [0, 5], atol=1e-12)
    assert doublet_loads(method, np.zeros((2, 3)), [5 * ALONG, -5 * ALONG]).twisting[0] == pytest.approx(-5)


@METHODS
def test_opposite_torques_across_the_axis_bend(method):
    """Bending is the length of the moment in the tangent plane, whatever its direction there."""
    carried = doublet_loads(method, np.zeros((2, 3)), [-3 * ACROSS - 4 * UP, 3 * ACROSS + 4 * UP])
    np.testing.assert_allclose(carried.moment, [3 * ACROSS + 4 * UP], atol=1e-12)
    np.testing.assert_allclose([carried.bending[0], carried.twisting[0]], [5, 0], atol=1e-12)
    np.testing.assert_allclose(carried.force, [0 * ALONG], atol=1e-12)


@METHODS
def test_shear_and_the_arms_of_unequal_spheres(method):
    """Forces ∓Q across the axis, arms 1 and 3: torques −Q on sphere 0 and −3 Q on sphere 1 leave no moment.

    With both torques on sphere 0, what it has in excess, 3 Q, bends the contact.
    """
    force = [-2 * ACROSS, 2 * ACROSS]
    plain = doublet_loads(method, force, [-2 * UP, -6 * UP])
    np.testing.assert_allclose(plain.force, [2 * ACROSS], atol=1e-13)
    np.testing.assert_allclose(plain.moment, [0 * UP], atol=1e-12)
    assert plain.shear[0] == pytest.approx(2)
    bent = doublet_loads(method, force, [-8 * UP, 0 * UP])
    np.testing.assert_allclose(bent.moment, [6 * UP], atol=1e-12)
    assert bent.bending[0] == pytest.approx(6)


def test_four_scalars_by_definition():
    """Tension, shear, bending and twisting of random loads are the parts along and across n."""
    rng = np.random.default_rng(1)
    force, torque = rng.normal(size=(2, 3, 3))
    force -= force.mean(axis=0)
    torque -= (np.cross(TRIANGLE.spheres.centers, force) + torque).mean(axis=0)
    carried = rc.contact_loads(TRIANGLE, rc.SphereLoads(force, torque), rc.Bonds(**ALIKE))
    for c, n in enumerate(TRIANGLE.normals):
        f, m = carried.force[c], carried.moment[c]
        assert carried.tension[c] == pytest.approx(n @ f)
        assert carried.shear[c] == pytest.approx(np.linalg.norm(f - n * (n @ f)))
        assert carried.twisting[c] == pytest.approx(n @ m, abs=1e-14)
        assert carried.bending[c] == pytest.approx(np.linalg.norm(m - n * (n @ m)))


def test_contact_loads_and_bonds_are_frozen():
    """Results cannot be changed by accident, nor bonds through the caller's array."""
    carried = rc.contact_loads(CHAIN, rc.SphereLoads(PULLED, ZEROS))
    with pytest.raises(dataclasses.FrozenInstanceError):
        carried.force = ZEROS
    stiffness = np.array([1.0, 2.0])
    bonds = rc.Bonds(**(ALIKE | {"normal": stiffness}))
    stiffness[0] = 9.0
    assert bonds.normal.tolist() == [1.0, 2.0]
    with pytest.raises(dataclasses.FrozenInstanceError):
        bonds.normal = stiffness
    for array in (carried.force, carried.moment, bonds.normal):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_bonds_do_not_break_unless_told():
    """Every strength is infinite by default."""
    bonds = rc.Bonds(**ALIKE)
    for name in ("tensile_strength", "shear_strength", "bending_strength", "twisting_strength"):
        assert np.isinf(getattr(bonds, name)).all()


@pytest.mark.parametrize(
    ("aggregate", "bonds"), [(CHAIN, None), (TRIANGLE, rc.Bonds(**ALIKE))], ids=["statics", "springs"]
)
def test_loads_out_of_balance_are_refused(aggregate, bonds):
    """A body at rest needs zero total force and torque; the message says how much is left and what to use."""
    pushed = rc.SphereLoads([[2.0, 0, 0], [0, 0, 0], [0, 0, 0]], ZEROS)
    with pytest.raises(ValueError, match=r"^loads: expected a total force of zero, got 2 .*response\.loads\(flow\)"):
        rc.contact_loads(aggregate, pushed, bonds)
    turned = rc.SphereLoads(ZEROS, [[0, 0, 0], [0, 0, 0], [0, 3.0, 0]])
    with pytest.raises(ValueError, match=r"^loads: expected a total torque of zero, got 3 "):
        rc.contact_loads(aggregate, turned, bonds)
    couple = rc.SphereLoads([[0, -1.0, 0], [0, 1.0, 0], [0, 0, 0]], ZEROS)
    with pytest.raises(ValueError, match=r"^loads: expected a total torque of zero, got 2 "):
        rc.contact_loads(aggregate, couple, bonds)
    batch = rc.SphereLoads(np.stack([PULLED, pushed.force]), np.zeros((2, 3, 3)))
    with pytest.raises(ValueError, match=r"^loads.*: expected a total force of zero, got 2 "):
        rc.contact_loads(aggregate, batch, bonds)


def test_small_loads_out_of_balance_are_refused_in_any_unit():
    """Femtonewtons are not rounding when all loads are femtonewtons; 10⁻¹² of the loads is."""
    micro = rc.Aggregate.touching(rc.Spheres(1e-6 * CHAIN.spheres.centers, 1e-6))
    with pytest.raises(ValueError, match=r"^loads: expected a total force of zero, got 1e-15 "):
        rc.contact_loads(micro, rc.SphereLoads(1e-15 * np.array([ALONG, 0 * UP, 0 * UP]), ZEROS))
    with pytest.raises(ValueError, match=r"^loads: expected a total torque of zero, got 1e-21 "):
        rc.contact_loads(micro, rc.SphereLoads(ZEROS, 1e-21 * np.array([UP, 0 * UP, 0 * UP])))
    nearly = rc.SphereLoads(1e-15 * (PULLED + 1e-12), ZEROS)
    assert rc.contact_loads(micro, nearly).tension[0] == pytest.approx(1e-15, rel=1e-10)


def test_refused_structures():
    """No contact, loops without springs, loops by statics, and an unknown method."""
    pulled = rc.SphereLoads(PULLED, ZEROS)
    single = rc.Aggregate.touching(rc.Spheres([[0, 0, 0]], 1.0))
    with pytest.raises(
        ValueError, match=r"^the aggregate is a single sphere and has no contact; expected at least two"
    ):
        rc.contact_loads(single, rc.SphereLoads(np.zeros((1, 3)), np.zeros((1, 3))))
    with pytest.raises(ValueError, match=r"^bonds: .*\(hyperstaticity 6\), got none; give for instance jkr_bonds"):
        rc.contact_loads(TRIANGLE, pulled)
    with pytest.raises(ValueError, match=r"^bonds: .*got none"):
        rc.contact_loads(CHAIN, pulled, method="springs")
    with pytest.raises(ValueError, match=r"^method='statics' needs a tree, .*\(hyperstaticity 6\); use 'springs'$"):
        rc.contact_loads(TRIANGLE, pulled, rc.Bonds(**ALIKE), method="statics")
    with pytest.raises(ValueError, match=r"^method: expected 'auto', 'statics' or 'springs', got 'magic'$"):
        rc.contact_loads(CHAIN, pulled, method="magic")


@pytest.mark.parametrize("count", [1, 2, 4])
def test_wrong_number_of_loads(count):
    """One load per sphere."""
    nothing = np.zeros((count, 3))
    with pytest.raises(ValueError, match=rf"^loads: expected one per sphere \(3\), got {count}$"):
        rc.contact_loads(CHAIN, rc.SphereLoads(nothing, nothing))


@pytest.mark.parametrize("name", ALIKE)
@pytest.mark.parametrize("method", ["auto", "springs"])
@pytest.mark.parametrize("aggregate", [CHAIN, TRIANGLE], ids=["tree", "loop"])
def test_wrong_number_of_bonds(name, method, aggregate):
    """One value or one per contact, also where statics would not need them."""
    bonds = rc.Bonds(**(ALIKE | {name: [1.0] * 4}))
    with pytest.raises(
        ValueError, match=rf"^bonds.*: expected one value or one per contact \({len(aggregate.pairs)}\), got 4"
    ):
        rc.contact_loads(aggregate, rc.SphereLoads(PULLED, ZEROS), bonds, method=method)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("normal", 0, r"^normal: expected a positive number, got 0$"),
        ("tangential", [1.0, -2.0], r"^tangential\[1\]: expected a positive number, got -2$"),
        ("bending", np.nan, r"^bending: expected a finite number, got nan$"),
        ("twisting", [np.inf, 1.0], r"^twisting\[0\]: expected a finite number, got inf$"),
        ("normal", [[1.0]], r"^normal: expected one value or one per contact, got shape \(1, 1\)$"),
        ("normal", "stiff", r"^normal: "),
        ("tensile_strength", -1.0, r"^tensile_strength: expected a positive number, got -1$"),
        ("shear_strength", np.nan, r"^shear_strength: expected a finite number, got nan$"),
        ("bending_strength", [1.0, 0.0], r"^bending_strength\[1\]: expected a positive number, got 0$"),
    ],
)
def test_refused_bonds(name, value, message):
    """Stiffnesses are positive and finite, strengths positive; the entry is named."""
    with pytest.raises(ValueError, match=message):
        rc.Bonds(**(ALIKE | {name: value}))


def test_bonds_of_different_numbers_of_contacts():
    """All arrays of one set of bonds belong to the same contacts."""
    with pytest.raises(
        ValueError, match=r"^bonds: expected the same number of contacts everywhere, got .*'normal': 2.*'tangential': 3"
    ):
        rc.Bonds(normal=[1.0, 1.0], tangential=[1.0, 1.0, 1.0], bending=1.0, twisting=1.0)


def test_response_of_other_spheres_is_refused():
    """The fluid must have been solved for the spheres that carry the loads."""
    response = rc.rigid_response(CHAIN.spheres, rc.FreeDraining(), viscosity=1.0)
    for other in (TRIANGLE, rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [2, 0, 0]], 1.0))):
        with pytest.raises(
            ValueError, match=rf"solved for other spheres \(3\) than those of the aggregate \({len(other)}\)"
        ):
            rc.contact_response(other, response, rc.Bonds(**ALIKE))
    loop = rc.rigid_response(TRIANGLE.spheres, rc.FreeDraining(), viscosity=1.0)
    with pytest.raises(ValueError, match=r"^bonds: .*got none"):
        rc.contact_response(TRIANGLE, loop)
