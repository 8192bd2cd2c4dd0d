"""VTP files, read with VTK itself."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from rheoclast import Aggregate, Spheres
from rheoclast.io import write


def read_vtp(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def arrays(attributes):
    names = [attributes.GetArrayName(index) for index in range(attributes.GetNumberOfArrays())]
    return {name: vtk_to_numpy(attributes.GetArray(name)) for name in names}


def test_geometry_and_columns_are_exact(aggregate, sphere_columns, tmp_path):
    tension = np.array([1 / 3, -np.inf, np.nan, 1e-300])
    force = np.arange(12.0).reshape(4, 3) / 7
    contact_columns = {"tension_N": tension, "force_N": force}
    write(tmp_path / "floc.vtp", aggregate, sphere_columns=sphere_columns, contact_columns=contact_columns)
    drawn = read_vtp(tmp_path / "floc.vtp")

    np.testing.assert_array_equal(vtk_to_numpy(drawn.GetPoints().GetData()), aggregate.spheres.centers)
    assert drawn.GetNumberOfVerts() == 5
    assert drawn.GetNumberOfLines() == 4
    assert drawn.GetNumberOfCells() == 9
    np.testing.assert_array_equal(vtk_to_numpy(drawn.GetVerts().GetConnectivityArray()), np.arange(5))
    lines = vtk_to_numpy(drawn.GetLines().GetConnectivityArray()).reshape(-1, 2)
    np.testing.assert_array_equal(lines, aggregate.pairs)

    points = arrays(drawn.GetPointData())
    assert list(points) == ["radius", "force_N", "depth"]
    np.testing.assert_array_equal(points["radius"], aggregate.spheres.radii)
    np.testing.assert_array_equal(points["force_N"], sphere_columns["force_N"])
    np.testing.assert_array_equal(points["depth"], sphere_columns["depth"])

    cells = arrays(drawn.GetCellData())
    np.testing.assert_array_equal(cells["tension_N"], [*[np.nan] * 5, *tension])
    np.testing.assert_array_equal(cells["force_N"], [*[[np.nan] * 3] * 5, *force])


def test_geometry_alone_in_nanometres(aggregate, tmp_path):
    write(tmp_path / "floc.vtp", aggregate, unit="nm")
    drawn = read_vtp(tmp_path / "floc.vtp")
    np.testing.assert_allclose(vtk_to_numpy(drawn.GetPoints().GetData()), aggregate.spheres.centers * 1e9, rtol=1e-15)
    assert drawn.GetCellData().GetNumberOfArrays() == 0


@pytest.mark.parametrize("columns", [None, {"tension_N": np.empty(0)}])
def test_single_sphere_without_contacts(columns, tmp_path):
    single = Aggregate.touching(Spheres([[0, 0, 0]], 1e-6))
    write(tmp_path / "one.vtp", single, contact_columns=columns)
    drawn = read_vtp(tmp_path / "one.vtp")
    assert (drawn.GetNumberOfVerts(), drawn.GetNumberOfLines()) == (1, 0)
