# SPDX-License-Identifier: BSD-3-Clause
"""Whatever ParaView reads as points is baked and shown as spheres, and the radii are said to come from where they do."""
import gzip
import os
import shutil
import tempfile

from paraview.simple import *

LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())

ATOMS = [("N", 11.104, 6.134, -6.504), ("C", 11.639, 6.071, -5.147), ("C", 10.6, 6.5, -4.1), ("O", 9.4, 6.3, -4.3)]


def write_pdb(path):
    with open(path, "w", encoding="ascii") as file:
        for i, (symbol, x, y, z) in enumerate(ATOMS):
            file.write(f"ATOM  {i + 1:5d}  {symbol:3s} ALA A   1    {x:8.3f}{y:8.3f}{z:8.3f}"
                       f"  1.00  0.00          {symbol:>2s}\n")
        file.write("END\n")


def write_xyz(path):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(ATOMS)}\nalanine\n")
        file.writelines(f"{symbol} {x} {y} {z}\n" for symbol, x, y, z in ATOMS)


def write_table(path):
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,z,diameter,mass\n")
        file.writelines(f"{x},{y},{z},1.5,{2.0 + i}\n" for i, (_, x, y, z) in enumerate(ATOMS))


def write_dump(path):
    with gzip.open(path, "wt", encoding="ascii") as file:
        for step in (0, 500):
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(ATOMS)}\n"
                       "ITEM: BOX BOUNDS ff ff ff\n-20 20\n-20 20\n-20 20\nITEM: ATOMS id x y z radius\n")
            file.writelines(f"{i + 1} {x + step} {y} {z} 0.7\n" for i, (_, x, y, z) in enumerate(ATOMS))


def check_readers(dump, xyz):
    """OpenDataFile finds the plugin's own reader, also where ParaView has others for the ending."""
    steps = OpenDataFile(dump)
    assert steps.SMProxy.GetXMLName() == "LAMMPSDumpAndXYZReader", steps.SMProxy.GetXMLName()
    assert list(steps.TimestepValues) == [0, 500], list(steps.TimestepValues)
    steps.UpdatePipeline(500)
    assert abs(steps.GetDataInformation().GetBounds()[0] - 509.4) < 1e-9, steps.GetDataInformation().GetBounds()
    check("LAMMPS dump", steps, "point array radius")
    atoms = OpenDataFile(xyz)
    assert atoms.SMProxy.GetXMLName() == "LAMMPSDumpAndXYZReader", atoms.SMProxy.GetXMLName()
    check("XYZ text", atoms, "van der Waals radii in Å of the elements in point array element")


def check(name, source, radius_used, **radii):
    """The filter and the representation, on the same radii."""
    baked = SphereAmbientOcclusion(Input=source, TextureResolution=4, SamplesPerTexel=9, **radii)
    baked.UpdatePipeline()
    baked.UpdatePropertyInformation()
    used = baked.GetPropertyValue("RadiusUsed")
    assert used == radius_used, f"{name}: the filter says {used!r}, not {radius_used!r}"
    means = baked.PointData.GetArray("AmbientOcclusion")
    assert means is not None and means.GetRange()[1] > 0, f"{name}: nothing was baked"
    view = CreateView("RenderView")
    display = Show(source, view)
    for key, value in radii.items():
        setattr(display, key, value)
    display.SetRepresentationType("Ray-Traced Spheres")
    Render(view)
    display.SMProxy.UpdatePropertyInformation()
    used = display.SMProxy.GetProperty("RadiusUsed").GetElement(0)
    assert used == radius_used, f"{name}: the representation says {used!r}, not {radius_used!r}"
    shown = display.SMProxy.GetProperty("NumberOfSpheres").GetElement(0)
    points = source.GetDataInformation().GetNumberOfPoints()
    assert shown == points > 0, f"{name}: {shown} spheres of {points} points"
    Delete(view)


def main():
    folder = tempfile.mkdtemp(prefix="particleocclusion-inputs-")
    data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")
    try:
        path = {name: os.path.join(folder, "atoms." + name) for name in ("pdb", "xyz", "csv", "dump.gz")}
        write_pdb(path["pdb"])
        write_xyz(path["xyz"])
        write_table(path["csv"])

        elements = "van der Waals radii in Å of the elements in point array "
        check("PDB", PDBReader(FileName=path["pdb"]), elements + "atom_type")
        molecule = MoleculeToLines(Input=XYZReader(FileName=path["xyz"]))
        check("XYZ", molecule, elements + "Atomic Numbers")

        write_dump(path["dump.gz"])
        check_readers(path["dump.gz"], path["xyz"])

        table = TableToPoints(Input=CSVReader(FileName=[path["csv"]]), XColumn="x", YColumn="y", ZColumn="z")
        check("table", table, "half of point array diameter")
        check("masses", table, "spheres of density 2 with the masses in point array mass", RadiusFrom="Mass and Density",
              Density=2)

        heap = OpenDataFile(os.path.join(data, "heap.vtp"))
        grid = AppendDatasets(Input=[heap])
        grid.UpdatePipeline()
        assert grid.GetDataInformation().GetDataSetTypeAsString() == "vtkUnstructuredGrid"
        check("unstructured grid", grid, "point array radius")
        check("composite", GroupDatasets(Input=[grid, heap]), "point array radius")
        check("no array", heap, "0.5 for all", RadiusArray="(none)", ConstantRadius=0.5)
    finally:
        shutil.rmtree(folder)


main()
