"""Choices by name: what each name stands for, and that commands and campaigns know the same ones."""

import inspect

import numpy as np
import pytest

import rheoclast as rc
from rheoclast import names

PAIR = rc.generation.straight_chain(2, radius=1e-6)
POLYSTYRENE = rc.MATERIALS["polystyrene"]
PROPERTIES = {"youngs_modulus": 70e9, "poisson_ratio": 0.17, "work_of_adhesion": 0.05}


def final(interface):
    """The public classes behind an interface that can be made."""
    classes = [each for _, each in inspect.getmembers(rc, inspect.isclass) if issubclass(each, interface)]
    return {each for each in classes if not inspect.isabstract(each)}


def assert_same_bonds(one, other):
    np.testing.assert_array_equal(one.bonds(PAIR).stiffness(1), other.bonds(PAIR).stiffness(1))
    np.testing.assert_array_equal(one.bonds(PAIR).strength(1), other.bonds(PAIR).strength(1))


def test_every_model_and_criterion_has_a_name():
    assert {type(names.hydrodynamic_model(name, 2, 0.1)) for name in names.MODELS} == final(rc.HydrodynamicModel)
    assert {type(names.failure_criterion(name, 0.1)) for name in names.CRITERIA} == final(rc.Criterion)


def test_models_take_what_they_know():
    assert names.hydrodynamic_model("stokesian", "auto", 0.1) == rc.StokesianDynamics(order="auto", accuracy=0.1)
    assert names.hydrodynamic_model("stokesian", 3, 0.02) == rc.StokesianDynamics(order=3)
    assert names.hydrodynamic_model("free-draining", 3, 0.02) == rc.FreeDraining()


def test_criteria_take_the_friction_that_they_know():
    assert names.failure_criterion("sliding", 0.3) == rc.Sliding(0.3)
    assert names.failure_criterion("every-limit", 0.3).parts[1] == rc.Sliding(0.3)
    assert names.failure_criterion("every-limit").parts == rc.EVERY_LIMIT.parts
    assert names.failure_criterion("tension", 0.3) == rc.Tension()


class TestContactLaw:
    def test_of_a_known_material(self):
        assert names.contact_law("polystyrene") == rc.JKR(POLYSTYRENE)
        limited = names.contact_law("polystyrene", friction=0.3, rolling_distance=1e-9)
        assert limited == rc.JKR(POLYSTYRENE, friction=0.3, rolling_distance=1e-9)

    def test_of_its_properties(self):
        """All of them make a material of any name, some change a known one."""
        assert names.contact_law("silica", **PROPERTIES) == rc.JKR(rc.Material(**PROPERTIES))
        stickier = rc.Material(POLYSTYRENE.youngs_modulus, POLYSTYRENE.poisson_ratio, 0.1)
        assert names.contact_law("polystyrene", work_of_adhesion=0.1) == rc.JKR(stickier)

    def test_measured(self):
        law = names.contact_law("polystyrene", pull_off=1e-9, friction=0.3)
        assert_same_bonds(law, rc.MeasuredPullOff(1e-9, rc.JKR(POLYSTYRENE, friction=0.3)))

    def test_explicit_of_whatever_name(self):
        bonds = names.contact_law("necks", stiffness=(1.0, 2.0, 3.0, 4.0), pull_off=5.0).bonds(PAIR)
        np.testing.assert_array_equal(bonds.stiffness(1), [[1, 2, 3, 4]])
        np.testing.assert_array_equal(bonds.strength(1), [[5, np.inf, np.inf, np.inf]])

    def test_limits_that_a_law_does_not_know_are_refused(self, monkeypatch):
        monkeypatch.setattr(names, "LAWS", {"plain": lambda material: rc.JKR(material)})
        assert names.contact_law("polystyrene", law="plain") == rc.JKR(POLYSTYRENE)
        with pytest.raises(ValueError, match=r"^friction: law 'plain' does not take this; leave one of them out$"):
            names.contact_law("polystyrene", law="plain", friction=0.3)

    @pytest.mark.parametrize(
        ("values", "message"),
        [
            (
                {"material": "oil"},
                r"material: 'oil' is none of the known ones \(polystyrene\); give its youngs_modulus, ",
            ),
            (
                {"material": "oil", "youngs_modulus": 1.0, "work_of_adhesion": 1.0},
                "material: .*; give its poisson_ratio$",
            ),
            ({"law": "honey"}, "law: expected one of jkr.*, got 'honey'$"),
            ({"pull_off": -1.0}, "pull_off: expected a positive number, got -1$"),
            (
                {"stiffness": (1.0, 1.0, 1.0, 1.0)},
                "stiffness: explicit stiffness needs the strength too; add pull_off$",
            ),
            (
                {"stiffness": (1.0, 1.0, 1.0, 1.0), "pull_off": 1.0, "friction": 1.0, "work_of_adhesion": 1.0},
                "friction, work_of_adhesion: explicit stiffness does not take this; leave one of them out$",
            ),
        ],
    )
    def test_refusals(self, values, message):
        with pytest.raises(ValueError, match=f"^{message}"):
            names.contact_law(**{"material": "polystyrene", **values})


@pytest.mark.parametrize(
    ("criterion", "missing"),
    [("sliding", "friction"), ("twisting", "friction"), ("rolling", "rolling_distance"), ("tension", None)],
)
def test_a_criterion_needs_a_limit(criterion, missing):
    if missing is None:
        names.refuse_unbreakable(criterion, "polystyrene", names.contact_law("polystyrene"))
        return
    with pytest.raises(ValueError, match=rf"^criterion: '{criterion}' never fails 'polystyrene', .*; add {missing}$"):
        names.refuse_unbreakable(criterion, "polystyrene", names.contact_law("polystyrene"))
    names.refuse_unbreakable(criterion, "polystyrene", names.contact_law("polystyrene", **{missing: 0.1}))


@pytest.mark.parametrize(
    ("choose", "message"),
    [
        (lambda: names.hydrodynamic_model("magic", 2, 0.02), "model: expected one of stokesian, .*, got 'magic'"),
        (lambda: names.failure_criterion("taste"), "criterion: expected one of every-limit, .*, got 'taste'"),
        (lambda: names.one_of("colour", ("red", "blue"), "up"), "colour: expected one of red, blue, got 'up'"),
    ],
)
def test_unknown_names_are_refused_with_the_known_ones(choose, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        choose()


def test_commands_offer_every_name(capsys):
    """In their help, whatever is entered in the tables."""
    from rheoclast.cli import main

    with pytest.raises(SystemExit):
        main(["break", "--help"])
    shown = capsys.readouterr().out
    for choices in (names.FLOWS, names.MODELS, names.LAWS, names.CRITERIA, rc.MATERIALS):
        assert all(name in shown for name in choices)


@pytest.mark.parametrize("choices", ["FLOWS", "MODELS", "LAWS", "CRITERIA"])
def test_campaigns_know_every_name(choices):
    pytest.importorskip("msgspec")
    pytest.importorskip("pyarrow")
    from rheoclast.campaigns.conditions import Conditions, ContactMaterial, Hydrodynamics

    def conditions(name):
        contacts = {"law": name} if choices == "LAWS" else {"friction": 0.3, "rolling_distance": 1e-9}
        return Conditions(
            viscosity=1e-3,
            radius=1e-6,
            orientations="worst",
            flows=(name if choices == "FLOWS" else "shear",),
            materials=(ContactMaterial("polystyrene", **contacts),),
            hydrodynamics=Hydrodynamics(name if choices == "MODELS" else "stokesian"),
            criterion=name if choices == "CRITERIA" else "tension",
        )

    for name in getattr(names, choices):
        conditions(name)
    with pytest.raises(ValueError, match=r"expected one of .*, got 'nothing'"):
        conditions("nothing")
