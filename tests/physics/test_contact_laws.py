"""JKR contacts against the load–indentation curve and the surface tractions that define them.

With the contact radius c as the parameter, Johnson, Kendall and Roberts (1971) have
P = 4 E* c³/(3 R*) − sqrt(8π W E* c³) and δ = c²/R* − sqrt(2π W c/E*), for 1/R* = 1/a_i + 1/a_j and
1/E* = 2 (1 − ν²)/E between equal materials. Contact radius, pull-off and normal stiffness follow here by numerical
root, minimum and difference quotient; the other stiffnesses by integrals of the traction under a bonded disc.
"""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

import rheoclast as rc

EXAMPLE = rc.Material(youngs_modulus=3.4e9, poisson_ratio=0.33, work_of_adhesion=0.1)
MATERIALS = [
    EXAMPLE,
    rc.Material(youngs_modulus=70e9, poisson_ratio=0.17, work_of_adhesion=0.05),
    rc.Material(youngs_modulus=1e6, poisson_ratio=0.5, work_of_adhesion=0.02),
    rc.Material(youngs_modulus=2e9, poisson_ratio=-0.4, work_of_adhesion=1e-3),
]
RADII = [(0.5e-6, 0.5e-6), (0.2e-6, 1.7e-6)]

each_material = pytest.mark.parametrize("material", MATERIALS, ids=["polystyrene", "silica", "gel", "auxetic"])
each_pair = pytest.mark.parametrize("radii", RADII, ids=["equal", "unequal"])


def doublet(radii):
    return rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [sum(radii), 0, 0]], radii))


def reduced(material, radii):
    """Reduced modulus E* and radius R* of two bodies in contact, from those of each."""
    compliance = (1 - material.poisson_ratio**2) / material.youngs_modulus
    return 1 / (compliance + compliance), 1 / (1 / radii[0] + 1 / radii[1])


def curve(material, radii):
    """Load and indentation as functions of the contact radius."""
    modulus, radius = reduced(material, radii)
    work = material.work_of_adhesion

    def load(c):
        return 4 * modulus * c**3 / (3 * radius) - np.sqrt(8 * np.pi * work * modulus * c**3)

    def indentation(c):
        return c**2 / radius - np.sqrt(2 * np.pi * work * c / modulus)

    return load, indentation


def zero_load_radius(material, radii):
    """The contact radius at which the curve has no load, beyond the pull-off minimum."""
    load, _ = curve(material, radii)
    lowest = pull_off_radius(material, radii)
    return brentq(load, lowest, 100 * lowest, xtol=1e-14 * lowest, rtol=1e-14)


def pull_off_radius(material, radii):
    """Where the load is least; sought in multiples of the length (W R*²/E*)^⅓."""
    load, _ = curve(material, radii)
    modulus, radius = reduced(material, radii)
    unit = np.cbrt(material.work_of_adhesion * radius**2 / modulus)
    size = material.work_of_adhesion * radius
    best = minimize_scalar(
        lambda s: load(s * unit) / size, bounds=(1e-3, 10), method="bounded", options={"xatol": 1e-9}
    )
    return best.x * unit


def under_the_disc(integrand):
    """∫ f(r)/sqrt(1 − r²) dr from the centre to the rim of a unit disc, by r = sin t."""
    return quad(lambda t: integrand(np.sin(t)), 0, np.pi / 2)[0]


@each_material
@each_pair
def test_pull_off_is_the_least_load_of_the_curve(material, radii):
    """The tensile strength is how far one can pull before the curve turns back."""
    load, _ = curve(material, radii)
    bonds = rc.jkr_bonds(doublet(radii), material)
    np.testing.assert_allclose(bonds.tensile_strength, -load(pull_off_radius(material, radii)), rtol=1e-10)
    assert pull_off_radius(material, radii) / zero_load_radius(material, radii) == pytest.approx(0.63, abs=0.005)


@each_material
@each_pair
def test_normal_stiffness_is_the_slope_at_zero_load(material, radii):
    """The normal stiffness is dP/dδ by central differences along the curve; their error is 1e-8 at a step of 1e-4."""
    load, indentation = curve(material, radii)
    c = zero_load_radius(material, radii)
    low, high = c * (1 - 1e-4), c * (1 + 1e-4)
    slope = (load(high) - load(low)) / (indentation(high) - indentation(low))
    bonds = rc.jkr_bonds(doublet(radii), material)
    np.testing.assert_allclose(bonds.normal, slope, rtol=1e-7)
    modulus, _ = reduced(material, radii)
    assert slope == pytest.approx(6 / 5 * modulus * c, rel=1e-7)


@each_material
@each_pair
def test_tangential_stiffness_of_a_bonded_disc(material, radii):
    """The traction T / (2π c² sqrt(1 − r²/c²)) carries T and moves each half-space by what Cerruti's kernel says.

    Displacement at the centre under a tangential point force f at distance r: f [(1 − ν) + ν cos²φ] / (2π G r). The
    two bodies are in series.
    """
    c, nu = zero_load_radius(material, radii), material.poisson_ratio
    shear_modulus = material.youngs_modulus / (2 * (1 + nu))
    carried = 2 * np.pi * under_the_disc(lambda r: r) / (2 * np.pi)
    around = quad(lambda phi: (1 - nu) + nu * np.cos(phi) ** 2, 0, 2 * np.pi)[0]
    displacement = around * under_the_disc(lambda _: 1.0) / (2 * np.pi) / (2 * np.pi * shear_modulus * c)
    bonds = rc.jkr_bonds(doublet(radii), material)
    np.testing.assert_allclose(bonds.tangential, carried / (2 * displacement), rtol=1e-9)


@each_material
@each_pair
def test_bending_stiffness_of_a_bonded_disc(material, radii):
    """The pressure 2 E* θ x / (π sqrt(c² − r²)) is that of a tilt θ, and its moment is the bending stiffness times θ.

    The tilt at the centre is checked by Boussinesq's kernel, 1/(π E* r) for both bodies together, whose slope is
    x/(π E* r³). The same number is four times pull-off force times reduced radius (Dominik and Tielens).
    """
    modulus, radius = reduced(material, radii)
    c = zero_load_radius(material, radii)
    squared_cosine = quad(lambda phi: np.cos(phi) ** 2, 0, 2 * np.pi)[0]
    tilt = squared_cosine * under_the_disc(lambda _: 1.0) * 2 / np.pi**2
    assert tilt == pytest.approx(1.0, rel=1e-12)
    moment = 2 * modulus / np.pi * c**3 * squared_cosine * under_the_disc(lambda r: r**3)
    bonds = rc.jkr_bonds(doublet(radii), material)
    np.testing.assert_allclose(bonds.bending, moment, rtol=1e-9)
    np.testing.assert_allclose(bonds.bending, 4 * bonds.tensile_strength * radius, rtol=1e-9)


@each_material
@each_pair
def test_twisting_stiffness_of_a_bonded_disc(material, radii):
    """The shear 4 G θ r / (π sqrt(c² − r²)) turns a half-space by θ and carries its torque; two are in series.

    A ring of circumferential traction τ at distance r turns the surface at its centre by τ dr/(2 G r) per unit width
    and radius: half the curl of Cerruti's kernel, (1/4πG) τ/r² per area, free of ν.
    """
    c = zero_load_radius(material, radii)
    shear_modulus = material.youngs_modulus / (2 * (1 + material.poisson_ratio))
    turn = 4 / np.pi * 2 * np.pi * under_the_disc(lambda _: 1.0) / (4 * np.pi)
    assert turn == pytest.approx(1.0, rel=1e-12)
    torque = 4 * shear_modulus / np.pi * 2 * np.pi * c**3 * under_the_disc(lambda r: r**3)
    bonds = rc.jkr_bonds(doublet(radii), material)
    np.testing.assert_allclose(bonds.twisting, torque / 2, rtol=1e-9)


def test_worked_example_of_the_theory_notes():
    """Worked by hand: E = 3.4 GPa, ν = 0.33, a = 0.5 µm, W = 0.1 J/m², to three digits."""
    a = 0.5e-6
    bonds = rc.jkr_bonds(doublet((a, a)), EXAMPLE)
    (normal,), (bending,), (twisting,) = (np.ravel(x) for x in (bonds.normal, bonds.bending, bonds.twisting))
    assert zero_load_radius(EXAMPLE, (a, a)) / a == pytest.approx(0.0718, abs=0.00005)
    assert np.ravel(bonds.tensile_strength)[0] == pytest.approx(118e-9, abs=0.5e-9)
    assert normal == pytest.approx(82, abs=0.5)
    assert bending / (normal * a**2) == pytest.approx(5.7e-3, abs=0.05e-3)
    assert twisting / (normal * a**2) == pytest.approx(7.7e-3, abs=0.05e-3)


def test_polydisperse_aggregate_has_the_bond_of_each_pair():
    """Every contact has the law of its own two radii, in the order of the contacts, and only pull-off is a limit."""
    radii = np.array([1.0, 0.4, 2.0, 0.7, 1.3]) * 1e-6
    x = np.concatenate([[0], np.cumsum(radii[1:] + radii[:-1])])
    aggregate = rc.Aggregate.touching(rc.Spheres(np.stack([x, 0 * x, 0 * x], axis=1), radii))
    bonds = rc.jkr_bonds(aggregate, EXAMPLE)
    for c, (i, j) in enumerate(aggregate.pairs):
        single = rc.jkr_bonds(doublet((radii[j], radii[i])), EXAMPLE)
        for name in ("normal", "tangential", "bending", "twisting", "tensile_strength"):
            assert getattr(bonds, name)[c] == pytest.approx(np.ravel(getattr(single, name))[0], rel=1e-12)
    for name in ("shear_strength", "bending_strength", "twisting_strength"):
        assert np.isinf(getattr(bonds, name)).all()


def test_how_the_law_scales():
    """By dimensions: radii λ times as large have contacts λ^⅔ as wide and pull off at λ times the force."""
    small, large = (rc.jkr_bonds(doublet((a, a)), EXAMPLE) for a in (1e-7, 8e-7))
    np.testing.assert_allclose(large.tensile_strength / small.tensile_strength, 8, rtol=1e-12)
    np.testing.assert_allclose(large.normal / small.normal, 4, rtol=1e-12)
    np.testing.assert_allclose(large.tangential / small.tangential, 4, rtol=1e-12)
    np.testing.assert_allclose(large.bending / small.bending, 64, rtol=1e-12)
    np.testing.assert_allclose(large.twisting / small.twisting, 64, rtol=1e-12)


def test_jkr_bonds_carry_load_in_si():
    """Stiffnesses five decades apart in SI (N/m against N m) leave spheres of a loop in equilibrium to rounding."""
    a = 0.5e-6
    square = rc.Aggregate.touching(rc.Spheres(a * np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]), a))
    pull = 1e-9 * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    carried = rc.contact_loads(square, rc.SphereLoads(pull, 0 * pull), rc.jkr_bonds(square, EXAMPLE))
    np.testing.assert_allclose(carried.tension, 1e-9, rtol=1e-10)
    np.testing.assert_allclose(carried.shear, 0, atol=1e-19)
    np.testing.assert_allclose(carried.moment, 0, atol=1e-19 * a)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("poisson_ratio", 0.51, r"^poisson_ratio: expected a number above -1 and at most 0\.5, got 0\.51$"),
        ("poisson_ratio", -1.0, r"^poisson_ratio: expected a number above -1 and at most 0\.5, got -1$"),
        ("poisson_ratio", np.nan, r"^poisson_ratio: expected a finite number, got nan$"),
        ("youngs_modulus", 0.0, r"^youngs_modulus: expected a positive number, got 0$"),
        ("youngs_modulus", -2e9, r"^youngs_modulus: expected a positive number, got -2e\+09$"),
        ("youngs_modulus", np.inf, r"^youngs_modulus: expected a finite number, got inf$"),
        ("work_of_adhesion", -0.1, r"^work_of_adhesion: expected a positive number, got -0\.1$"),
        ("work_of_adhesion", 0.0, r"^work_of_adhesion: expected a positive number, got 0$"),
        ("work_of_adhesion", "strong", r"^work_of_adhesion: expected a number, got 'strong'$"),
    ],
)
def test_refused_materials(name, value, message):
    """Thermodynamics bounds Poisson's ratio; moduli and adhesion are positive."""
    values = {"youngs_modulus": 3.4e9, "poisson_ratio": 0.33, "work_of_adhesion": 0.1}
    with pytest.raises(ValueError, match=message):
        rc.Material(**(values | {name: value}))


def test_limits_of_sliding_twisting_and_rolling():
    """Twisting: the whole of a Hertzian contact slides at the moment ∫ μ p r dA, for the load P with S = μ P.

    With p ∝ sqrt(1 − r²/c²) and ∫ p dA = P; rolling by 4 F ξ; both in proportion to the pull-off force.
    """
    radii, friction, distance = (0.5e-6, 0.8e-6), 0.3, 1e-9
    bonds = rc.jkr_bonds(doublet(radii), EXAMPLE, friction=friction, rolling_distance=distance)
    pull_off = bonds.tensile_strength
    np.testing.assert_allclose(bonds.shear_strength, 2 * friction * pull_off)
    np.testing.assert_allclose(bonds.bending_strength, 4 * distance * pull_off)
    c = zero_load_radius(EXAMPLE, radii)
    load = quad(lambda r: np.sqrt(1 - r**2) * 2 * np.pi * r, 0, 1)[0]
    moment = quad(lambda r: np.sqrt(1 - r**2) * r * 2 * np.pi * r, 0, 1)[0]
    np.testing.assert_allclose(bonds.twisting_strength, bonds.shear_strength * c * moment / load, rtol=1e-9)


def test_measured_pull_off_changes_the_other_limits_in_proportion():
    aggregate = doublet((0.5e-6, 0.5e-6))
    law = rc.JKR(EXAMPLE, friction=0.2, rolling_distance=2e-9)
    own, measured = law.bonds(aggregate), rc.MeasuredPullOff(1e-9, law).bonds(aggregate)
    share = 1e-9 / own.tensile_strength
    np.testing.assert_allclose(measured.strength(1), share[:, None] * own.strength(1))
    assert np.isinf(rc.MeasuredPullOff(1e-9, rc.JKR(EXAMPLE)).bonds(aggregate).shear_strength).all()


@pytest.mark.parametrize("name", ["friction", "rolling_distance"])
def test_refused_limits(name):
    with pytest.raises(ValueError, match=rf"^{name}: expected a positive number, got 0"):
        rc.JKR(EXAMPLE, **{name: 0.0})
