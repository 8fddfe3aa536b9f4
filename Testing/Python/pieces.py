# SPDX-License-Identifier: BSD-3-Clause
"""Particles as files of pieces, which processes share among them."""
import os

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")


def part_of(whole, mask):
    """The points of `whole` where the mask is true, with their arrays."""
    def chosen(array):
        copy = numpy_to_vtk(vtk_to_numpy(array)[mask], deep=True)
        copy.SetName(array.GetName())
        return copy

    points = vtkPoints()
    points.SetData(chosen(whole.GetPoints().GetData()))
    part = vtkPolyData()
    part.SetPoints(points)
    data = whole.GetPointData()
    for i in range(data.GetNumberOfArrays()):
        part.GetPointData().AddArray(chosen(data.GetArray(i)))
    return part


def molecule():
    """The molecule of `Data/`."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(DATA, "molecule.vtp"))
    reader.Update()
    return reader.GetOutput()


def write(folder, name, whole, masks):
    """Writes a piece for each mask and the file that names them; the path of that."""
    for k, mask in enumerate(masks):
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(part_of(whole, mask))
        writer.SetDataModeToBinary()
        writer.SetFileName(os.path.join(folder, f"{name}{k}.vtp"))
        writer.Write()
    arrays = "".join(f'<PDataArray type="Float32" Name="{array}"/>' for array in ("radius", "charge"))
    pieces = "".join(f'<Piece Source="{name}{k}.vtp"/>' for k in range(len(masks)))
    path = os.path.join(folder, name + ".pvtp")
    with open(path, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="PPolyData" version="1.0"><PPolyData GhostLevel="0">'
                   f"<PPointData>{arrays}</PPointData>"
                   '<PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>'
                   f"{pieces}</PPolyData></VTKFile>")
    return path
