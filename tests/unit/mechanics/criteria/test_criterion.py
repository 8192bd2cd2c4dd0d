"""Every failure criterion there is keeps the contract of its interface. A criterion that is not listed here fails."""

import importlib
import inspect
import pkgutil
from dataclasses import FrozenInstanceError, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import rheoclast
import rheoclast as rc
from rheoclast.mechanics import criteria

from .cases import loads, random_bonds, random_loads, times

STRENGTHS = ("tensile_strength", "shear_strength", "bending_strength", "twisting_strength")
CRITERIA = {
    "tension": rc.Tension(),
    "sliding": rc.Sliding(),
    "sliding with friction": rc.Sliding(friction=0.4),
    "rolling": rc.Rolling(),
    "twisting": rc.Twisting(),
    "sum": rc.Combined(1),
    "sum of squares": rc.Combined(),
    "any of": rc.AnyOf(rc.Tension(), rc.Sliding(0.3), rc.Combined(3)),
    "every limit": rc.EVERY_LIMIT,
}
every_criterion = pytest.mark.parametrize("criterion", CRITERIA.values(), ids=CRITERIA)


def concrete_criteria():
    """All final descendants of `Criterion` that the package defines, in whatever module."""
    for module in pkgutil.walk_packages(rheoclast.__path__, "rheoclast."):
        if module.name != "rheoclast.__main__":
            importlib.import_module(module.name)
    found, queue = set(), [rc.Criterion]
    while queue:
        below = queue.pop().__subclasses__()
        queue.extend(below)
        found.update(c for c in below if c.__module__.startswith("rheoclast.") and not inspect.isabstract(c))
    return found


def assert_same(one, other):
    """To rounding of parts up to 10⁴ times as large that were taken off."""
    np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12 * np.abs(other).max())


def test_every_criterion_is_tested():
    assert concrete_criteria() == {type(criterion) for criterion in CRITERIA.values()}


def test_every_criterion_has_a_file_and_tests_of_its_own():
    files = [criterion.__module__.removeprefix("rheoclast.mechanics.criteria.") for criterion in concrete_criteria()]
    assert len(set(files)) == len(files)
    assert {f"test_{file}.py" for file in files} <= {path.name for path in Path(__file__).parent.iterdir()}


def test_every_criterion_is_public():
    assert {criterion.__name__ for criterion in concrete_criteria()} <= set(rc.__all__)
    assert criteria.__doc__


@every_criterion
@settings(deadline=None)
@given(factor=st.floats(1e-12, 1e12), seed=st.integers(0, 1000))
def test_load_ratio_is_proportional_to_the_loads(criterion, factor, seed):
    carried, bonds = random_loads(seed), random_bonds(seed)
    assert_same(criterion.load_ratio(times(factor, carried), bonds) / factor, criterion.load_ratio(carried, bonds))


@every_criterion
def test_load_ratio_is_inverse_to_the_strengths(criterion):
    carried, bonds = random_loads(1), random_bonds(1)
    stronger = replace(bonds, **{name: 7.0 * getattr(bonds, name) for name in criterion.strengths})
    assert_same(7.0 * criterion.load_ratio(carried, stronger), criterion.load_ratio(carried, bonds))


@every_criterion
def test_only_the_strengths_that_it_names_count(criterion):
    assert set(criterion.strengths) <= set(STRENGTHS)
    assert len(set(criterion.strengths)) == len(criterion.strengths)
    carried, bonds = random_loads(2), random_bonds(2)
    others = {name: 1e-9 for name in STRENGTHS if name not in criterion.strengths}
    np.testing.assert_array_equal(
        criterion.load_ratio(carried, replace(bonds, **others)), criterion.load_ratio(carried, bonds)
    )
    for name in criterion.strengths:
        changed = criterion.load_ratio(carried, replace(bonds, **{name: 1e-9}))
        assert (changed != criterion.load_ratio(carried, bonds)).any()


@every_criterion
def test_off_without_a_strength(criterion):
    bonds = rc.Bonds(1.0, 1.0, 1.0, 1.0)
    np.testing.assert_array_equal(criterion.load_ratio(random_loads(3), bonds), np.zeros(20))


@every_criterion
def test_compression_alone_fails_nothing(criterion):
    compressed = rc.ContactLoads(np.eye(3)[:1], -3.0 * np.eye(3)[:1], np.zeros((1, 3)))
    assert criterion.load_ratio(compressed, rc.Bonds(1, 1, 1, 1, 1, 1, 1, 1)) <= 0


@every_criterion
def test_batches_of_loads_and_one_strength_for_all(criterion):
    """(..., C) for loads (..., C), each case as if it were alone."""
    carried, bonds = random_loads(4, (3, 2, 20)), rc.Bonds(1, 1, 1, 1, 2.0, 3.0, 4.0, 5.0)
    ratio = criterion.load_ratio(carried, bonds)
    assert ratio.shape == (3, 2, 20)
    alone = rc.ContactLoads(carried.normals, carried.force[1, 0], carried.moment[1, 0])
    np.testing.assert_array_equal(ratio[1, 0], criterion.load_ratio(alone, bonds))
    each = rc.Bonds(1, 1, 1, 1, *(np.full(20, value) for value in (2.0, 3.0, 4.0, 5.0)))
    np.testing.assert_array_equal(criterion.load_ratio(carried, each), ratio)


@every_criterion
def test_frame_and_numbering_do_not_matter(criterion):
    """Turned as a whole; and seen from the other sphere, where normal, force and moment are opposite."""
    carried, bonds = random_loads(5), random_bonds(5)
    expected = criterion.load_ratio(carried, bonds)
    turn = Rotation.from_rotvec([0.7, -1.9, 0.4]).as_matrix()
    for matrix in (turn, -np.eye(3)):
        turned = rc.ContactLoads(carried.normals @ matrix.T, carried.force @ matrix.T, carried.moment @ matrix.T)
        assert_same(criterion.load_ratio(turned, bonds), expected)


@every_criterion
def test_is_a_value(criterion):
    """Equal settings make equal criteria, and nothing can be changed afterwards."""
    settings = vars(criterion)
    again = type(criterion)(*settings.get("criteria", settings.values()))
    assert again == criterion
    assert hash(again) == hash(criterion)
    with pytest.raises((FrozenInstanceError, TypeError)):
        setattr(criterion, next(iter(settings), "anything"), 3)


@pytest.mark.parametrize(
    ("criterion", "name"),
    [
        (rc.Tension(), "tension"),
        (rc.Sliding(0.2), "sliding"),
        (rc.Rolling(), "rolling"),
        (rc.Twisting(), "twisting"),
        (rc.Combined(), "combined"),
        (rc.Tension() | rc.Rolling(), "tension or rolling"),
    ],
)
def test_name_is_what_a_failure_is_called(criterion, name):
    assert criterion.name == name


class Inherited(rc.Criterion):
    """As `Tension`, under the name of a class of its own."""

    strengths = ("tensile_strength",)

    def load_ratio(self, loads, bonds):
        return loads.tension / bonds.tensile_strength


class NeckStress(Inherited):
    pass


class JKRPullOff(Inherited):
    pass


@pytest.mark.parametrize(("kind", "name"), [(NeckStress, "neck stress"), (JKRPullOff, "jkr pull off")])
def test_name_of_a_class_of_several_words(kind, name):
    assert kind().name == name
    assert (kind() | rc.Tension()).name == f"{name} or tension"


def test_parts_of_equal_name_are_numbered():
    criterion = rc.Sliding(0.1) | rc.Tension() | rc.Sliding(0.5) | rc.Rolling() | rc.Sliding()
    assert criterion.part_names == ("sliding 1", "tension", "sliding 2", "rolling", "sliding 3")
    assert criterion.name == "sliding 1 or tension or sliding 2 or rolling or sliding 3"
    assert rc.Sliding(0.5).part_names == ("sliding",)


def test_either_of_two():
    either = rc.Tension() | rc.Sliding(0.2)
    assert either == rc.AnyOf(rc.Tension(), rc.Sliding(0.2))
    assert either | rc.Rolling() == rc.AnyOf(rc.Tension(), rc.Sliding(0.2), rc.Rolling())
    assert rc.Rolling() | either == rc.AnyOf(rc.Rolling(), rc.Tension(), rc.Sliding(0.2))


@pytest.mark.parametrize("criterion", [rc.Tension(), rc.Sliding(), rc.Rolling(), rc.Twisting(), rc.Combined()])
def test_a_single_criterion_is_its_only_part(criterion):
    assert criterion.parts == (criterion,)


def test_largest_ratio_of_all():
    """Ratios 1.5 and ½, then −1.5 and ½."""
    carried = loads([3.0, -3.0], 2.0, 9.0, 9.0)
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=2.0, shear_strength=4.0)
    np.testing.assert_allclose(rc.AnyOf(rc.Tension(), rc.Sliding()).load_ratio(carried, bonds), [1.5, 0.5])


def test_order_and_repetition_do_not_matter():
    carried, bonds = random_loads(1), random_bonds(1)
    expected = rc.AnyOf(rc.Tension(), rc.Rolling()).load_ratio(carried, bonds)
    for other in (rc.AnyOf(rc.Rolling(), rc.Tension()), rc.AnyOf(rc.Tension(), rc.Rolling(), rc.Tension())):
        np.testing.assert_array_equal(other.load_ratio(carried, bonds), expected)


def test_alternatives_of_alternatives_are_one_list():
    """With the strengths of all, each named once."""
    nested = rc.AnyOf(rc.AnyOf(rc.Rolling(), rc.Combined()), rc.Sliding(0.1))
    assert nested.parts == nested.criteria == (rc.Rolling(), rc.Combined(), rc.Sliding(0.1))
    assert nested.strengths == ("bending_strength", "tensile_strength", "shear_strength", "twisting_strength")
    assert nested.name == "rolling or combined or sliding"


def test_one_alternative_is_that_criterion():
    carried, bonds = random_loads(2), random_bonds(2)
    np.testing.assert_array_equal(
        rc.AnyOf(rc.Twisting()).load_ratio(carried, bonds), rc.Twisting().load_ratio(carried, bonds)
    )


def test_refused_alternatives():
    with pytest.raises(ValueError, match=r"^AnyOf: expected at least one criterion, got none; give for instance Ten"):
        rc.AnyOf()
    with pytest.raises(TypeError, match=r"^AnyOf: expected Criterion, got the class Tension; for instance Tension\(\)"):
        rc.AnyOf(rc.Tension)
    with pytest.raises(TypeError, match=r"^AnyOf: expected Criterion, got str; for instance Tension\(\)$"):
        rc.AnyOf(rc.Tension(), "sliding")


def test_shown_as_it_is_written():
    """As in the signatures of functions, and to be pasted back."""
    criterion = rc.AnyOf(rc.Tension(), rc.Sliding(0.5))
    assert repr(criterion) == "AnyOf(Tension(), Sliding(friction=0.5))"
    assert eval(repr(criterion), vars(rc)) == criterion
