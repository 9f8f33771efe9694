"""Structured grids and data sets of several blocks, written by VTK, are read as hexes."""

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.io.kept import read_content

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
