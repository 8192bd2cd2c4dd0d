"""Every example runs, draws a figure, and shows what its text says. An example without a test here fails."""

import ast
import importlib.util
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import rheoclast as rc

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py"))


@cache
def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for key, value in vars(module).items():
        if getattr(value, "__module__", None) == name and callable(value) and key != name:
            setattr(module, key, cache(value))  # what one test computes, the figure of another shows
    return module


@pytest.mark.parametrize("name", NAMES)
def test_it_draws(name):
    """A figure that is neither empty nor cut off."""
    figure = getattr(example(name), name)()
    assert isinstance(figure, Figure)
    figure.set_dpi(60)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    ink = np.asarray(canvas.buffer_rgba())[..., :3].min(axis=-1) < 250
    assert 0.01 < ink.mean() < 0.9
    assert not ink[[0, -1]].any()


@pytest.mark.parametrize("name", NAMES)
def test_it_has_a_title_and_a_figure_to_save(name):
    text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
    title, rule, blank, *_ = ast.get_docstring(ast.parse(text)).splitlines()
    assert set(rule) == {"="}
    assert len(rule) == len(title)
    assert not blank
    assert text.endswith(f'if __name__ == "__main__":\n    {name}().savefig("{name}.png")\n')


def test_every_example_is_tested():
    assert {name for name in NAMES if f"test_{name}" not in globals()} == set()


def test_loads_of_a_floc_in_shear():
    module = example("loads_of_a_floc_in_shear")
    floc, carried, first = module.loaded_floc()
    assert first.contact == carried.tension.argmax()
    assert first.rate / module.FLOW.rate > 1  # it holds at this rate
    assert carried.tension.min() < 0 < carried.tension.max()
    assert rc.radial_position(floc, floc.contact_points)[first.contact] < 1


def test_worst_orientation():
    tension, largest = example("worst_orientation").tension_by_orientation()
    assert tension.max() <= largest * (1 + 1e-12)
    assert tension.max() > 0.99 * largest
    assert (tension > 0.9 * largest).mean() < 0.1
    assert abs(tension.mean()) < 5 * tension.std() / np.sqrt(len(tension))


def test_crack_through_a_packed_ball():
    breakup, _ = example("crack_through_a_packed_ball").broken_ball()
    assert breakup.outcome == "crack"
    assert len(breakup.failures) > 20
    rates = [failure.rate for failure in breakup.failures]
    assert any(later < earlier for earlier, later in pairwise(rates))


def test_trees_and_packings():
    module = example("trees_and_packings")
    tree, *_, packing = (module.breakups(coordination) for coordination in module.COORDINATIONS)
    assert all(each.outcome == "bond" and len(each.fragments) == 2 for each in tree)
    assert np.median([len(each.failures) for each in packing]) > 10


def test_error_bars_and_multipole_order():
    module = example("error_bars_and_multipole_order")
    (compact, true_compact), (tree, true_tree) = map(module.errors_by_order, module.CLUSTERS.values())
    assert np.all(true_tree < true_compact)
    assert np.all(np.diff(true_tree) < 0)
    for expected, true in ((compact, true_compact), (tree, true_tree)):
        assert np.all(true < 2 * expected)
        assert np.sum(true < expected) >= 3


def test_tumbling_in_shear():
    history, axis, worst = example("tumbling_in_shear").tumbling()
    np.testing.assert_allclose(np.linalg.norm(axis, axis=1), 1, rtol=1e-9)
    assert 0.9 * worst < history.largest.max() <= worst * (1 + 1e-9)
    assert np.median(history.largest) < 0.6 * worst
    assert len(np.unique(history.contact)) > 3
    along_flow, along_gradient, _ = axis.T**2
    assert along_flow.mean() > 1.5 * along_gradient.mean()  # it lingers along the flow


def test_breakage_rate_in_turbulence():
    module = example("breakage_rate_in_turbulence")
    rates = module.breakage_rates()
    assert all(later.rate > earlier.rate for earlier, later in pairwise(rates))
    rate = np.array([each.rate for each in rates])
    critical = rc.fitted_critical_dissipation(module.DISSIPATIONS, rate, module.KINEMATIC_VISCOSITY).value
    law = rc.turbulent_breakage_rate(module.DISSIPATIONS, module.KINEMATIC_VISCOSITY, critical)
    np.testing.assert_allclose(np.log(law), np.log(rate), atol=0.7)


def test_cascade_of_fragments():
    module = example("cascade_of_fragments")
    event = module.cascade()
    assert event.sizes.sum() == module.SPHERES
    left = module.places(event.pieces)
    for position, piece in enumerate(event.pieces):
        children = event.children(position)
        assert sum(len(event.pieces[k].aggregate) for k in children) == (0 if piece.holds else len(piece.aggregate))
        end = left[position]
        for child in children:
            assert left[child] == end
            end += len(event.pieces[child].aggregate)
