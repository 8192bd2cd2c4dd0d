"""Every contact law there is keeps the contract of its interface. A law that is not listed here fails."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.mechanics import laws
from rheoclast.names import LAWS

POLYSTYRENE = rc.MATERIALS["polystyrene"]
TESTED = {
    "JKR": rc.JKR(POLYSTYRENE),
    "JKR with all limits": rc.JKR(POLYSTYRENE, friction=0.3, rolling_distance=1e-9),
    "measured pull-off": rc.MeasuredPullOff(6e-9, rc.JKR(POLYSTYRENE), radius=1e-6),
    "measured pull-off of bonds": rc.MeasuredPullOff(6e-9, rc.Bonds(1.0, 2.0, 3.0, 4.0)),
}
RADII = np.array([1.0, 2.0, 4.0]) * 1e-6
CHAIN = rc.Aggregate.touching(rc.Spheres(1e-6 * np.array([[0, 0, 0], [3, 0, 0], [3, 6, 0]]), RADII))

every_law = pytest.mark.parametrize("law", TESTED.values(), ids=TESTED)


def final_laws():
    """All descendants of `ContactLaw` in the folder of laws that can be made."""
    modules = [importlib.import_module(f"{laws.__name__}.{each.name}") for each in pkgutil.iter_modules(laws.__path__)]
    classes = {each for module in modules for _, each in inspect.getmembers(module, inspect.isclass)}
    return {each for each in classes if issubclass(each, rc.ContactLaw) and not inspect.isabstract(each)}


def test_every_law_is_tested_and_public():
    assert final_laws() == {type(law) for law in TESTED.values()}
    assert {each.__name__ for each in final_laws()} <= set(rc.__all__)


def test_every_law_of_a_material_has_a_name():
    """Those that are made from another law have none."""
    of_materials = {each for each in final_laws() if "material" in inspect.signature(each).parameters}
    assert set(LAWS.values()) == of_materials


@every_law
def test_bonds_are_those_of_the_contacts(law):
    """One for every contact, each what it would be between its two spheres alone, in whatever order they come."""
    bonds = law.bonds(CHAIN)
    assert bonds.stiffness(2).shape == bonds.strength(2).shape == (2, 4)
    for contact, (i, j) in enumerate(CHAIN.pairs):
        centers = CHAIN.spheres.centers[[j, i]]
        alone = law.bonds(rc.Aggregate.touching(rc.Spheres(centers, RADII[[j, i]])))
        np.testing.assert_allclose(bonds.stiffness(2)[contact], alone.stiffness(1)[0], rtol=1e-12)
        np.testing.assert_allclose(bonds.strength(2)[contact], alone.strength(1)[0], rtol=1e-12)


@every_law
def test_every_law_has_a_pull_off_force(law):
    assert np.isfinite(law.bonds(CHAIN).strength(2)[:, 0]).all()
