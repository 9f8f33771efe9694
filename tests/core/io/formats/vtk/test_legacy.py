"""VTK's legacy format: field data, strings, and widths and counts that a reader could take for others.

Structured grids and data sets of several blocks, written by VTK, are read as hexes.
"""

import os
import tracemalloc

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.io.format_lookup import plugin_formats
from tests.core.io.kept import assert_refused, read_content

HEAD = "# vtk DataFile Version {}\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
POINTS = "POINTS 8 {}\n0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1 1 0 1 1 1 1 0 1 1\n"
DOUBLES = POINTS.format("double")


def old(cells="CELLS 1 9\n8 0 1 2 3 4 5 6 7", types="12", points=DOUBLES, more=""):
    """A file of one hex, version 3.0."""
    return HEAD.format("3.0") + points + cells + f"\nCELL_TYPES 1\n{types}\n" + more


def new(ends="0 8", nodes="0 1 2 3 4 5 6 7", kind="vtktypeint64"):
    """The same, version 5.1."""
    size = len(nodes.split())
    cells = f"CELLS 2 {size}\nOFFSETS vtktypeint64\n{ends}\nCONNECTIVITY {kind}\n{nodes}"
    return HEAD.format("5.1") + DOUBLES + cells + "\nCELL_TYPES 1\n12\n"


WRONG_TEXTS = [
    (old("CELLS 1 9\n8 0 1 2 3 4 5 6 4294967303"), "CELLS holds 4294967303 in row 1 of 1, which its type int cannot"),
    (new(nodes="0 1 2 3 4 5 6 4294967303"), "expected numbers from 0 to 7"),
    (new(nodes="0 1 2 3 4 5 6 4294967303", kind="int"), "CONNECTIVITY holds 4294967303 in row 8 of 8"),
    (new(nodes="0 1 2 3 4 5 6 36893488147419103239"), "CONNECTIVITY holds a whole number of more than 64 bits"),
    (old("CELLS 1 9\n8 0 1 2 3 4 5 6 7.9"), "CELLS holds '7.9' in row 1 of 1 (line 9): expected a whole number"),
    (new(nodes="0 1 2 3 4 5 6 7.9", kind="double"), "CONNECTIVITY has the type double: expected whole numbers"),
    (old(types="268"), "cell 0 is of type 268: expected one of VTK's types"),
    (old(types="-12"), "cell 0 is of type -12: expected one of VTK's types"),
    (old("CELLS 1 10\n8 0 1 2 3 4 5 6 7 7"), "CELLS holds 10 numbers: its 1 cells need 9"),
    (old("CELLS 1 9\n8 0 1 2 3 4 5 6 7 7"), "begins with '7'"),
    (new(ends="0 7"), "CELLS has 2 OFFSETS for 1 cells"),
    (new(ends="0 7", nodes="0 1 2 3 4 5 6"), "cell 0 is of type 12 and has 7 nodes: expected 8"),
    (old("CELLS 1 8\n7 0 1 2 3 4 5 6"), "cell 0 is of type 12 and has 7 nodes: expected 8"),
    (old(points=POINTS.format("char").replace("1 1 1", "1 257 1")), "POINTS holds 257 in row 7 of 8, which its type char cannot"),
    (old(points=2 * DOUBLES), "has a second section POINTS before line 9"),
    (old(more="CELLS 1 9\n8 0 1 2 3 4 5 6 7\n"), "has a second section CELLS"),
    (old(more="CELL_TYPES 1\n12\n"), "has a second section CELL_TYPES"),
    (old(more="CELL_DATA 1\nSCALARS a float\nLOOKUP_TABLE default\n1\nCELL_TYPES 2\n12\n12\n"), "has a second section CELL_TYPES"),
    (old(more="SCALARS a float\nLOOKUP_TABLE default\n1\n"), "the array 'a' precedes POINT_DATA and CELL_DATA"),
    (old(f"CELLS {10**15} 9\n8 0 1 2 3 4 5 6 7"), "cells of 9 numbers are declared"),
    (old(points=f"POINTS {10**15} double\n0 0 0\n"), "POINTS ends after 1 of 1000000000000000 rows: line 7 continues with 'CELLS'"),
    (old(more=f"FIELD FieldData 1\na 1 {10**15} string\nx\n"), "1000000000000000 strings are declared"),
    (old(more="POINT_DATA 8\nFIELD FieldData 1\na 1 8 unsigned_long\n0 1 2 3 4 5 6 -1\n"), "array a holds '-1'"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words"), WRONG_TEXTS)
def test_no_number_is_taken_for_another(text, words, tmp_path):
    assert_refused(tmp_path / "a.vtk", words, text)


@pytest.mark.parametrize("start", [b"", b"# vtk DataFile Version 3.0\n"])
def test_a_file_of_zeros_is_refused_without_reading_more_than_it_has(start, tmp_path):
    path = tmp_path / "zeros.vtk"
    path.write_bytes(start)
    size = 1 << 26 if start else 3 << 30
    os.truncate(path, size)  # which takes no place on the disk
    plugin_formats()  # or the memory of their first import would count
    tracemalloc.start()
    try:
        with pytest.raises(FileError):
            io.read(path)
        assert tracemalloc.get_traced_memory()[1] < (1.1 * size if start else 1 << 20)
    finally:
        tracemalloc.stop()


def test_what_is_wrong_far_back_is_found_by_its_line(tmp_path):
    rows = [f"{k} 0 0" for k in range(50_000)]
    rows[40_000] = "0 1.2.3 0"
    (tmp_path / "a.vtk").write_text(HEAD.format("3.0") + f"POINTS {len(rows)} float\n" + "\n".join(rows) + "\n")
    with pytest.raises(FileError, match=r"POINTS holds '1.2.3' in row 40001 of 50000 \(line 40006\)"):
        io.read(tmp_path / "a.vtk")


pyvista = pytest.importorskip("pyvista")

AXES = [np.array([0.0, 1, 3]), np.array([0.0, 1, 2, 5]), np.array([0.0, 2, 3])]


def structured():
    grid = pyvista.StructuredGrid(*np.meshgrid(*AXES, indexing="ij"))
    grid.points += 0.125 * np.sin(grid.points)
    return grid


GRIDS = {
    "a.vts": structured,
    "a.vtk": structured,
    "b.vtr": lambda: pyvista.RectilinearGrid(*AXES),
    "b.vtk": lambda: pyvista.RectilinearGrid(*AXES),
    "c.vti": lambda: pyvista.ImageData(dimensions=(3, 4, 5), spacing=(1, 2, 0.5), origin=(5, 6, 7)),
    "c.vtk": lambda: pyvista.ImageData(dimensions=(3, 4, 5), spacing=(1, 2, 0.5), origin=(5, 6, 7)),
}


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("name", GRIDS)
def test_the_cells_of_a_structured_grid_are_hexes(name, binary, tmp_path):
    grid = GRIDS[name]()
    grid.point_data["t"], grid.cell_data["k"] = np.arange(grid.n_points), np.arange(grid.n_cells)
    grid.save(tmp_path / name, binary=binary)
    mesh, cells = io.read(tmp_path / name), grid.cast_to_unstructured_grid().cell_centers().points
    np.testing.assert_allclose(mesh.points, grid.points, atol=1e-12)
    np.testing.assert_allclose(mesh.points[mesh.hexes].mean(axis=1), cells, atol=1e-12)
    assert mesh.node_data["t"].tolist() == list(range(grid.n_points))
    assert mesh.hex_data["k"].tolist() == list(range(grid.n_cells))


@pytest.mark.parametrize(("old", "new", "words"), [
    ("DIMENSIONS 3", "DIMENSIONS 1", "expected two nodes or more"),
    ("DIMENSIONS 3", "DIMENSIONS 4", "has 36 points: expected 48"),
    ("DIMENSIONS 3", "DIMENSIONS x", "holds other words than numbers"),
    ("DIMENSIONS 3 4 3", "DIMENSIONS 3 4", "holds no three numbers"),
    ("DIMENSIONS 3", "DIMENSIONS 30000000", "too many for a file"),
])  # fmt: skip
def test_what_is_wrong_with_a_structured_grid_is_named(old, new, words, tmp_path):
    structured().save(tmp_path / "a.vtk", binary=False)
    text = (tmp_path / "a.vtk").read_text()
    assert old in text
    with pytest.raises(FileError, match=words):
        read_content(tmp_path / "b.vtk", text.replace(old, new))


def test_blocks_of_volumes_are_joined_and_others_are_noted(tmp_path):
    one, skin = structured(), structured().cast_to_unstructured_grid().extract_surface(algorithm="dataset_surface")
    other = pyvista.ImageData(dimensions=(2, 2, 2), origin=(9, 9, 9))
    pyvista.MultiBlock({"one": one, "in": pyvista.MultiBlock({"two": other, "skin": skin})}).save(tmp_path / "a.vtm")
    mesh = io.read(tmp_path / "a.vtm")
    assert (mesh.n_hexes, mesh.n_nodes) == (one.n_cells + 1, one.n_points + 8)
    assert mesh.hex_data["block"].tolist() == [0] * one.n_cells + [1]
    assert any("blocks that are no volumes (.vtp files)" in note for note in mesh.notes)
    next((tmp_path / "a").rglob("*.vti")).unlink()
    with pytest.raises(FileError, match=r"its piece .*there is no such file"):
        io.read(tmp_path / "a.vtm")
