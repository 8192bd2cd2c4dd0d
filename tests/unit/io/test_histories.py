"""Files of velocity-gradient histories: every layout gives the same derivatives, every fault has its place."""

import sys
from importlib.util import find_spec

import numpy as np
import pytest

from rheoclast import FileFormatError
from rheoclast.histories import GradientHistory, traceless
from rheoclast.io.histories import HISTORY_FORMATS, read_histories, write_histories

needs_h5py = pytest.mark.skipif(find_spec("h5py") is None, reason="h5py is an optional extra")
FORMATS = [pytest.param(name, marks=needs_h5py) if name == "hdf5" else name for name in HISTORY_FORMATS]

# u = (x + 2y + 3z, 4x + 5y + 6z, 7x + 8y − 6z): every derivative is another number
GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
ROW = "1,2,3,4,5,6,7,8,-6"
SUFFIXES = {"csv": ".csv", "npy": ".npy", "npz": ".npz", "hdf5": ".h5"}


def histories(count=3, instants=5, seed=1):
    rng = np.random.default_rng(seed)
    return [
        GradientHistory(np.cumsum(rng.uniform(0.5, 1.0, instants)), 1e3 * traceless(rng.normal(size=(instants, 3, 3))))
        for _ in range(count)
    ]


def assert_same(found, expected):
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one.times, other.times)
        np.testing.assert_allclose(one.gradients, other.gradients, rtol=0, atol=1e-12)


def forget_units(path):
    """Remove what an HDF5 file says of its units."""
    import h5py

    with h5py.File(path, "r+") as opened:
        for dataset in opened.values():
            del dataset.attrs["unit"]


def read_one(path, **more):
    (history,) = read_histories(path, **more)
    return history


@pytest.mark.parametrize("name", FORMATS)
class TestEveryFormat:
    @pytest.mark.parametrize("count", [1, 3])
    def test_restores_what_was_written(self, name, count, tmp_path):
        path = tmp_path / f"paths{SUFFIXES[name]}"
        written = histories(count)
        write_histories(path, written)
        assert_same(read_histories(path), written)

    def test_goes_by_the_argument_before_the_suffix(self, name, tmp_path):
        path = tmp_path / "paths.anything"
        (written,) = histories(1)
        write_histories(path, written, format=name)
        assert_same(read_histories(path, format=name), [written])
        with pytest.raises(ValueError, match="expected a suffix that tells the format"):
            read_histories(path)

    def test_column_order_is_the_transpose(self, name, tmp_path):
        path = tmp_path / f"paths{SUFFIXES[name]}"
        transposed = [GradientHistory(h.times, np.swapaxes(h.gradients, 1, 2)) for h in histories(2)]
        write_histories(path, transposed)
        if name == "csv":
            text = path.read_text().replace("dud", "d1d").replace("dvd", "d2d").replace("dwd", "d3d")
            for old, new in zip(("x", "y", "z"), "123", strict=True):
                text = text.replace(f"d1d{old}", f"A1{new}").replace(f"d2d{old}", f"A2{new}")
                text = text.replace(f"d3d{old}", f"A3{new}")
            path.write_text(text)
        assert_same(read_histories(path, order="column"), histories(2))

    def test_units_multiply(self, name, tmp_path):
        path = tmp_path / f"paths{SUFFIXES[name]}"
        (slow,) = histories(1)
        write_histories(path, slow)
        if name == "hdf5":
            forget_units(path)
        fast = read_one(path, time_unit="dimensionless", gradient_unit="1/ms")
        np.testing.assert_allclose(fast.gradients, 1e3 * slow.gradients)
        np.testing.assert_array_equal(fast.times, slow.times)

    def test_an_existing_file_stays(self, name, tmp_path):
        path = tmp_path / f"paths{SUFFIXES[name]}"
        write_histories(path, histories(1))
        with pytest.raises(FileExistsError, match="exists already"):
            write_histories(path, histories(2))
        write_histories(path, histories(2), overwrite=True)
        assert len(read_histories(path)) == 2

    def test_a_missing_file_is_said_to_be_missing(self, name, tmp_path):
        with pytest.raises(FileNotFoundError, match="there is no such file"):
            read_histories(tmp_path / f"paths{SUFFIXES[name]}")

    def test_a_history_without_a_path_is_refused(self, name, tmp_path):
        path = tmp_path / f"paths{SUFFIXES[name]}"
        with pytest.raises(ValueError, match="histories: expected at least one history, got none"):
            write_histories(path, [])
        with pytest.raises(TypeError, match=r"histories\[1\]: expected GradientHistory, got int"):
            write_histories(path, [*histories(1), 3])
        assert not path.exists()


def test_histories_of_different_lengths_fit_in_a_table_only(tmp_path):
    written = [*histories(1, instants=4), *histories(1, instants=6)]
    write_histories(tmp_path / "paths.csv", written)
    assert_same(read_histories(tmp_path / "paths.csv"), written)
    for suffix in (".npy", ".npz", ".h5"):
        with pytest.raises(ValueError, match=r"histories\[1\]: expected 4 instants as in the first history, got 6"):
            write_histories(tmp_path / f"paths{suffix}", written)
        assert not (tmp_path / f"paths{suffix}").exists()


@pytest.mark.parametrize(
    "header",
    [
        "",
        "# made by hand\n",
        "t,dudx,dudy,dudz,dvdx,dvdy,dvdz,dwdx,dwdy,dwdz\n",
        "Time (s),du/dx,du/dy,du/dz,dv/dx,dv/dy,dv/dz,dw/dx,dw/dy,dw/dz\n",
        "t_s,dux_dx,dux_dy,dux_dz,duy_dx,duy_dy,duy_dz,duz_dx,duz_dy,duz_dz\n",
        "t,du1dx1,du1dx2,du1dx3,du2dx1,du2dx2,du2dx3,du3dx1,du3dx2,du3dx3\n",
        "t,A11,A12,A13,A21,A22,A23,A31,A32,A33\n",
        "t [s],a_11,a_12,a_13,a_21,a_22,a_23,a_31,a_32,a_33\n",
        "# t,Gxx (1/s),Gxy (1/s),Gxz (1/s),Gyx (1/s),Gyy (1/s),Gyz (1/s),Gzx (1/s),Gzy (1/s),Gzz (1/s)\n",
        "t,p,q,r,s,u,v,w,k,l\n",
    ],
)
@pytest.mark.parametrize("mark", [",", ";", "\t", "  "])
def test_ways_to_write_one_path(header, mark, file):
    text = (header + f"0,{ROW}\n0.5,{ROW}\n").replace(",", mark)
    text = text.replace(" (", "(").replace(" [", "[") if mark == "  " else text  # blanks part the columns
    history = read_one(file("path.csv", text))
    np.testing.assert_array_equal(history.times, [0, 0.5])
    np.testing.assert_allclose(history.gradients[1], GRADIENT, rtol=1e-15)


def test_columns_go_by_name_in_any_order(file):
    text = "step,dwdz,dwdy,dwdx,dvdz,dvdy,dvdx,dudz,dudy,dudx,pressure,t\n"
    rows = "".join(f"{k},-6,8,7,6,5,4,3,2,1,99,{t}\n" for k, t in enumerate((0.0, 0.25)))
    history = read_one(file("path.csv", text + rows))
    np.testing.assert_array_equal(history.times, [0, 0.25])
    np.testing.assert_allclose(history.gradients[0], GRADIENT, rtol=1e-15)


def test_order_of_bare_entries_is_the_argument_and_of_derivatives_the_name(file):
    bare = file("bare.csv", f"0,{ROW}\n1,{ROW}\n")
    np.testing.assert_allclose(read_one(bare, order="column").gradients[0], GRADIENT.T)
    named = file("named.csv", f"t,dudx,dudy,dudz,dvdx,dvdy,dvdz,dwdx,dwdy,dwdz\n0,{ROW}\n1,{ROW}\n")
    with pytest.raises(FileFormatError, match="got columns named as derivatives, which say their order themselves"):
        read_histories(named, order="column")
    with pytest.raises(ValueError, match="order: expected 'row' or 'column', got 'fortran'"):
        read_histories(bare, order="fortran")


@pytest.mark.parametrize("name", ["trajectory", "id"])
def test_paths_are_told_apart_by_their_column_and_keep_their_order(name, file):
    text = f"{name},t,a11,a12,a13,a21,a22,a23,a31,a32,a33\n"
    rows = [f"{k},{t},{f},0,0,0,{-f},0,0,0,0\n" for t in (0, 1) for k, f in ((7, 1.0), (3, 2.0))]
    first, second = read_histories(file("paths.csv", text + "".join(rows)))
    np.testing.assert_allclose(first.gradients[:, 0, 0], 1)
    np.testing.assert_allclose(second.gradients[:, 0, 0], 2)
    unnamed = text.replace("a", "c").replace("trcjectory", "trajectory")
    assert len(read_histories(file("unnamed.csv", unnamed + "".join(rows)))) == 2


def test_units_of_time(file):
    path = file("path.csv", f"0,{ROW}\n2,{ROW}\n")
    for unit, seconds in {"s": 2.0, "ms": 2e-3, "us": 2e-6, "min": 120.0, "h": 7200.0, 0.5: 1.0}.items():
        assert read_one(path, time_unit=unit).duration == pytest.approx(seconds, rel=1e-14)
    assert read_one(path, gradient_unit=10.0).gradients[0, 0, 1] == pytest.approx(20.0)
    assert read_one(path, gradient_unit="1/min").gradients[0, 0, 1] == pytest.approx(2 / 60)
    with pytest.raises(ValueError, match="time_unit: expected one of s, ms, us, min, h, dimensionless, or its value"):
        read_histories(path, time_unit="day")
    with pytest.raises(ValueError, match=r"gradient_unit: expected one of 1/s, .* got 's'"):
        read_histories(path, gradient_unit="s")


def test_a_unit_in_the_file_must_agree(file):
    path = file("path.csv", f"t_ms,a11,a12,a13,a21,a22,a23,a31,a32,a33\n0,{ROW}\n1,{ROW}\n")
    assert read_one(path, time_unit="ms").duration == pytest.approx(1e-3)
    with pytest.raises(FileFormatError, match="expected times in s, got a column in ms by its name; pass time_unit="):
        read_histories(path)


@needs_h5py
def test_the_unit_of_a_dataset_must_agree(tmp_path):
    write_histories(tmp_path / "path.h5", histories(1))
    with pytest.raises(FileFormatError, match="expected times in ms, got a column in s"):
        read_histories(tmp_path / "path.h5", time_unit="ms")
    message = "expected gradients in 1/ms, got a column in 1/s by its name; pass gradient_unit='1/s'"
    with pytest.raises(FileFormatError, match=message):
        read_histories(tmp_path / "path.h5", gradient_unit="1/ms")


@needs_h5py
def test_the_unit_of_a_dataset_may_be_bytes_and_unknown_ones_are_passed_over(tmp_path):
    import h5py

    path = tmp_path / "path.h5"
    write_histories(path, histories(1))
    for unit, refused in ((np.bytes_(b"ms^-1"), True), ("per fortnight", False)):
        with h5py.File(path, "r+") as opened:
            opened["gradient"].attrs["unit"] = unit
        if refused:
            with pytest.raises(FileFormatError, match="expected gradients in 1/s, got a column in 1/ms"):
                read_histories(path)
        else:
            assert_same(read_histories(path), histories(1))


NAMES = {
    "derivatives": ["dudx", "dudy", "dudz", "dvdx", "dvdy", "dvdz", "dwdx", "dwdy", "dwdz"],
    "entries": ["a11", "a12", "a13", "a21", "a22", "a23", "a31", "a32", "a33"],
}


@pytest.mark.parametrize("names", NAMES.values(), ids=NAMES)
@pytest.mark.parametrize("behind", [" (1/ms)", " [1/ms]", "_1/ms", "(ms^-1)", " (ms-1)", " [ms⁻¹]"])
def test_a_unit_behind_the_entries_must_agree(names, behind, file):
    path = file("path.csv", ",".join(["t", *(name + behind for name in names)]) + f"\n0,{ROW}\n1,{ROW}\n")
    np.testing.assert_allclose(read_one(path, gradient_unit="1/ms").gradients[0], 1e3 * GRADIENT, rtol=1e-15)
    np.testing.assert_allclose(read_one(path, gradient_unit=1000).gradients[0], 1e3 * GRADIENT, rtol=1e-15)
    np.testing.assert_allclose(read_one(path, gradient_unit="dimensionless").gradients[0], GRADIENT, rtol=1e-15)
    with pytest.raises(FileFormatError, match="expected gradients in 1/s, got a column in 1/ms by its name; pass grad"):
        read_histories(path)


@pytest.mark.parametrize(
    ("units", "message"),
    [
        (["1/day"] * 9, "line 1: expected one of 1/s, .* behind the entries, got '1/day'"),
        (["1/s"] * 8 + ["1/ms"], r"line 1: expected the same unit behind all entries, got 'a11 \(1/s\), a12"),
    ],
)
def test_units_behind_the_entries_that_mean_nothing(units, message, file):
    names = [f"{name} ({unit})" for name, unit in zip(NAMES["entries"], units, strict=True)]
    with pytest.raises(FileFormatError, match=message):
        read_histories(file("path.csv", ",".join(["t", *names]) + f"\n0,{ROW}\n1,{ROW}\n"))


@pytest.mark.parametrize("cell", ["nan", "", "x", " NaN", "-inf"])
@pytest.mark.parametrize("above", ["", f"t,{','.join(NAMES['entries'])}\n", f"t,{','.join(NAMES['entries'])}\n\n"])
@pytest.mark.parametrize("below", ["", "# here it begins\n"])
def test_a_first_row_without_its_time_is_not_taken_for_names(cell, above, below, file):
    path = file("path.csv", f"{above}{cell},{ROW}\n{below}0,{ROW}\n1,{ROW}\n")
    line = above.count("\n") + 1
    with pytest.raises(FileFormatError, match=f"line {line}: expected names of columns or a row of numbers, got .*1,2"):
        read_histories(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,a11\n", "path.csv: expected rows of a time and nine entries of the gradient, got no numbers"),
        ("0,1,2\n1,1,2\n", "line 1: expected a time and nine entries of the gradient, got 3 columns; name the columns"),
        (f"id,t,1\n0,{ROW}\n1,{ROW}\n", "line 1: expected names for 10 columns, got 3: 'id,t,1'; correct this line"),
        (f"0,{ROW}\n1,1,2\n", r"line 2: expected 10 columns, got 3; is the file truncated\?"),
        (f"0,{ROW}\n\n1,{ROW.replace('4', 'four')}\n", "line 3: expected a number, got 'four'"),
        (f"0,{ROW}\n1,{ROW.replace('4', 'nan')}\n", "line 2: expected a finite number, got 'nan'"),
        (f"0,{ROW}\n1,{ROW.replace('4', '')}\n", "line 2: expected a number, got ''"),
        (f"1,{ROW}\n0,{ROW}\n", r"path.csv: times\[1\]: expected a time after 1 s"),
        (f"0,{ROW}\n", "path.csv: times: expected at least two instants, got 1"),
        (f"0,{ROW}\n1,{ROW.replace('-6', '6')}\n", r"path.csv: gradients\[1\]: expected zero trace .* check the order"),
        (
            f"t,dudx,dudy,dudz,dvdx,dvdy,dvdz,dwdx,dwdy,w\n0,{ROW}\n1,{ROW}\n",
            "line 1: expected all nine entries of the gradient once, got 'dudx, dudy,",
        ),
        (
            f"k,dudx,dudy,dudz,dvdx,dvdy,dvdz,dwdx,dwdy,dwdz\n0,{ROW}\n1,{ROW}\n",
            "line 1: expected one column t, got 0 among 'k, dudx,",
        ),
        (
            f"id,t,a11,a12,a13,a21,a22,a23,a31,a32,a33\n1,0,{ROW}\n1,1,{ROW}\n4,0,{ROW}\n4,0,{ROW}\n",
            r"path.csv, trajectory 4: times\[1\]: expected a time after 0 s",
        ),
    ],
)
def test_bad_tables(text, message, file):
    with pytest.raises(FileFormatError, match=message):
        read_histories(file("path.csv", text))


def test_trace_of_noisy_data_is_taken_away_on_request(file):
    path = file("path.csv", f"0,{ROW}\n1,{ROW.replace('-6', '-5.94')}\n")
    with pytest.raises(FileFormatError, match="pass a tolerance above this fraction"):
        read_histories(path)
    np.testing.assert_allclose(np.diag(read_one(path, tolerance=0.02).gradients[1]), [0.98, 4.98, -5.96])


def test_a_gap_in_time_is_warned_of(file):
    text = "".join(f"{t},{ROW}\n" for t in (0, 1, 2, 3, 14, 15))
    with pytest.warns(UserWarning, match="path.csv: the step after 3 s is 11 s, the median 1 s; a straight line"):
        read_histories(file("path.csv", text))


class TestArrays:
    times = np.array([0.0, 0.5])
    gradients = np.stack([GRADIENT, 2 * GRADIENT])

    def assert_read(self, path, **more):
        history = read_histories(path, **more)[-1]
        np.testing.assert_array_equal(history.times, self.times)
        np.testing.assert_allclose(history.gradients, self.gradients, rtol=1e-15)

    @pytest.mark.parametrize("paths", [(), (1,), (4,)])
    def test_npy(self, paths, tmp_path):
        rows = np.column_stack([self.times, self.gradients.reshape(2, 9)])
        np.save(tmp_path / "a.npy", np.broadcast_to(rows, (*paths, 2, 10)))
        assert len(read_histories(tmp_path / "a.npy")) == (paths or (1,))[0]
        self.assert_read(tmp_path / "a.npy")

    @pytest.mark.parametrize("shape", [(2, 3, 3), (2, 9), (4, 2, 3, 3), (4, 2, 9)])
    @pytest.mark.parametrize("own_times", [False, True])
    @pytest.mark.parametrize("suffix", [".npz", pytest.param(".h5", marks=needs_h5py)])
    def test_npz_and_hdf5(self, shape, own_times, suffix, tmp_path):
        several = shape[0] == 4
        gradients = np.broadcast_to(self.gradients.reshape(shape[several:]), shape)
        times = np.broadcast_to(self.times, (4, 2)) if several and own_times else self.times
        path = tmp_path / f"a{suffix}"
        if suffix == ".h5":
            import h5py

            with h5py.File(path, "w") as file:
                file["group/time"], file["group/grad"] = times, gradients
        else:
            np.savez(path, **{"group/time": times, "group/grad": gradients})
        self.assert_read(path, arrays=("group/time", "group/grad"))

    def test_bad_arrays(self, tmp_path):
        np.save(tmp_path / "a.npy", np.zeros((4, 9)))
        with pytest.raises(FileFormatError, match=r"expected an array \(T, 10\) or \(K, T, 10\), .* got \(4, 9\)"):
            read_histories(tmp_path / "a.npy")
        with pytest.raises(FileFormatError, match="expected an array 't', got one array without a name; pass arrays="):
            read_histories(tmp_path / "a.npy", format="npz")
        np.savez(tmp_path / "a.npz", t=self.times, gradient=np.zeros((2, 4)), words=["x"], objects=np.array([{}]))
        with pytest.raises(FileFormatError, match=r"expected instants \(T,\) or .* got \(2,\) and \(2, 4\)"):
            read_histories(tmp_path / "a.npz")
        with pytest.raises(FileFormatError, match="expected an array 'time', got 't, gradient, words, objects'; pass"):
            read_histories(tmp_path / "a.npz", arrays=("time", "gradient"))
        with pytest.raises(FileFormatError, match="expected numbers, got arrays of <U1 and float64"):
            read_histories(tmp_path / "a.npz", arrays=("words", "gradient"))
        with pytest.raises(FileFormatError, match="expected numbers in 'objects', got what cannot be read"):
            read_histories(tmp_path / "a.npz", arrays=("objects", "gradient"))

    @pytest.mark.parametrize("suffix", [".npy", ".npz", pytest.param(".h5", marks=needs_h5py)])
    def test_what_is_no_file_of_arrays(self, suffix, file):
        with pytest.raises(FileFormatError, match="expected a file of arrays as its suffix or format= says"):
            read_histories(file(f"a{suffix}", "t,A11\n"))

    def test_hdf5_without_its_package(self, tmp_path, monkeypatch):
        (tmp_path / "a.h5").touch()
        monkeypatch.setitem(sys.modules, "h5py", None)
        for action in (
            lambda: read_histories(tmp_path / "a.h5"),
            lambda: write_histories(tmp_path / "b.h5", histories(1)),
        ):
            with pytest.raises(ImportError, match=r"HDF5 files need the package h5py: pip install 'rheoclast\[hdf5\]'"):
                action()
        assert not (tmp_path / "b.h5").exists()


def test_unknown_format(tmp_path):
    with pytest.raises(ValueError, match="format: expected one of csv, npy, npz, hdf5, got 'mat'"):
        read_histories(tmp_path / "a.csv", format="mat")
