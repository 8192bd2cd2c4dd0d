"""The histories that an aggregate of a campaign is carried along."""

import pickle

import numpy as np
import pytest

import rheoclast as rc

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns.histories import Histories, HistoryFile
from rheoclast.turbulence import TURBULENCE_MODELS


def of_model(**changed):
    given = {"model": "gaussian", "number": 3, "duration": 8.0, "dissipations": (0.1, 0.4), "density": 500.0}
    return Histories(**{**given, **changed})


@pytest.fixture
def file(tmp_path):
    """Five histories, the first of which starts late, in a file."""
    several = rc.gaussian_histories(5, 0.02, 1.0, 1e-6, seed=7)
    late = rc.GradientHistory(several[0].times + 3.0, several[0].gradients)
    rc.write_histories(tmp_path / "paths.npz", (late, *several[1:]))
    return str(tmp_path / "paths.npz")


@pytest.mark.parametrize("model", TURBULENCE_MODELS)
def test_of_a_model_they_are_in_kolmogorov_times(model):
    drawn = of_model(model=model).drawn(seed=4)
    assert list(drawn) == [0, 1, 2]
    for path, slower in zip(drawn.values(), TURBULENCE_MODELS[model](3, 16.0, 0.5, 2.0, seed=4), strict=True):
        np.testing.assert_allclose(path.times, slower.times / 2)
        np.testing.assert_allclose(path.gradients, 2 * slower.gradients, atol=1e-12)


def test_kolmogorov_times():
    """(ν/ε)^½ with ν = 2·10⁻⁶ m²/s, however it is given."""
    expected = {each: (2e-6 / each) ** 0.5 for each in (0.1, 0.4)}
    assert of_model().kolmogorov_times(1e-3) == pytest.approx(expected)
    assert of_model(density=None, kinematic_viscosity=2e-6).kolmogorov_times(7.0) == pytest.approx(expected)


def test_of_files_they_have_the_mean_dissipation_of_all(file):
    histories = Histories(files=(file,), kinematic_viscosity=1e-6)
    (dissipation,) = histories.kolmogorov_times(1e-3)
    paths = rc.read_histories(file)
    assert dissipation == pytest.approx(np.mean([path.dissipation(1e-6) for path in paths]))
    drawn = histories.drawn(seed=1)
    assert list(drawn) == [0, 1, 2, 3, 4]
    assert np.mean([path.dissipation(1.0) for path in drawn.values()]) == pytest.approx(1)
    unit = (1e-6 / dissipation) ** 0.5
    np.testing.assert_allclose(drawn[3].gradients, paths[3].gradients * unit)
    np.testing.assert_allclose(drawn[0].times, paths[0].times / unit)


def test_some_of_the_files_are_drawn_for_each_aggregate(file):
    histories = Histories(files=(file,), number=2, density=1e3)
    drawn = [tuple(histories.drawn(seed)) for seed in range(200)]
    assert all(first < second for first, second in drawn)
    assert len(set(drawn)) == 10
    assert tuple(histories.drawn(3)) == drawn[3]


def test_files_may_say_how_they_are_read(file):
    transposed = Histories(files=(HistoryFile(file, order="column", time_unit="ms"),), density=1e3)
    plain, turned = Histories(files=(file,), density=1e3).drawn(1)[1], transposed.drawn(1)[1]
    np.testing.assert_allclose(turned.gradients, np.swapaxes(plain.gradients, 1, 2))
    assert turned.duration == pytest.approx(plain.duration / 1000)


def test_a_file_that_changes_is_refused(file):
    histories = Histories(files=(file,), density=1e3)
    assert pickle.loads(pickle.dumps(histories)) == histories
    rc.write_histories(file, rc.gaussian_histories(5, 0.02, 1.0, 1e-6, seed=8), overwrite=True)
    assert Histories(files=(file,), density=1e3) != histories
    with pytest.raises(ValueError, match=r"paths\.npz has changed since it was asked for; start anew"):
        histories.drawn(1)


def test_each_of_many_files_is_read_once(tmp_path, monkeypatch):
    """However many aggregates draw from them."""
    count = 70
    for k, history in enumerate(rc.gaussian_histories(count, 1e-3, 1.0, 1e-6, seed=5)):
        rc.write_histories(tmp_path / f"{k}.npz", history)
    read = []

    def remembered(path, **options):
        read.append(path)
        return rc.read_histories(path, **options)

    monkeypatch.setattr("rheoclast.campaigns.histories.read_histories", remembered)
    histories = Histories(files=tuple(str(tmp_path / f"{k}.npz") for k in range(count)), density=1e3)
    for seed in range(3):
        histories.drawn(seed)
        pickle.loads(pickle.dumps(histories)).kolmogorov_times(1e-3)
    assert len(read) == count


def test_files_without_strain_are_refused(tmp_path):
    rotation = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 0]])
    rc.write_histories(tmp_path / "still.npz", rc.GradientHistory(np.arange(2.0), np.array([rotation, rotation])))
    with pytest.raises(ValueError, match="files: expected velocity gradients with strain, got none"):
        Histories(files=(str(tmp_path / "still.npz"),), density=1e3).refuse_unreadable()
