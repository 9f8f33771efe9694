"""Meshes to and from meshio's: what comes with them comes back, and what is no mesh of hexes is refused."""

import numpy as np
import pytest

import hexmend as hx
from hexmend import Cells, MeshError
from tests.core.io.kept import middles_are_in_the_middle, with_everything

meshio = pytest.importorskip("meshio")

CUBE = hx.gallery.make("cube", size=27)


def test_sets_are_those_of_meshio():
    other = hx.to_meshio(with_everything())
    assert set(other.point_sets) == {"wall", "Second wall"}
    kinds = [block.type for block in other.cells]
    assert kinds == ["hexahedron", "quad", "line", "tetra", "pyramid"]
    assert [members.tolist() for members in other.cell_sets["overlapping"]] == [[2, 3], [], [], [0], []]


@pytest.mark.parametrize(
    ("suffix", "format", "nodes"),
    [(".vtu", "vtu", 27), (".vtk", "vtk", 8), (".msh", "gmsh22", 20), (".msh", "gmsh22", 27)],
)
def test_what_meshio_writes_is_the_same_mesh(suffix, format, nodes, tmp_path):
    mesh = with_everything(nodes)
    wedge = Cells("wedge", np.array([[0, 1, 4, 9, 10, 13]]))
    cells = mesh.cells[:2] if suffix == ".msh" else (*mesh.cells[:2], wedge)
    mesh = mesh.replace(cells=cells, node_sets={}, hex_sets={}, side_sets={}, node_data={})
    other = hx.to_meshio(mesh)
    meshio.write(tmp_path / f"a{suffix}", other, file_format=format)
    read = hx.read(tmp_path / f"a{suffix}", as_is=True)
    np.testing.assert_array_equal(read.hexes, mesh.hexes)
    middles_are_in_the_middle(read)
    for cells in mesh.cells:
        (found,) = [one for one in read.cells if one.kind == cells.kind]
        np.testing.assert_array_equal(found.nodes, cells.nodes)


@pytest.mark.parametrize(("suffix", "nodes"), [(".vtu", 20), (".vtk", 27), (".msh", 8), (".msh", 27)])
def test_what_meshio_reads_is_the_mesh_that_we_read(suffix, nodes, tmp_path):
    path = tmp_path / f"a{suffix}"
    mesh = with_everything(nodes)
    hx.write(path, mesh.replace(hex_data={}, hex_sets={}, cells=(Cells("quad", mesh.cells[0].nodes),)))
    ours, theirs = hx.read(path, as_is=True), hx.from_meshio(meshio.read(path), as_is=True)
    np.testing.assert_array_equal(ours.points, theirs.points)
    np.testing.assert_array_equal(ours.hexes, theirs.hexes)
    middles_are_in_the_middle(theirs)
    np.testing.assert_array_equal(ours.cells[0].nodes, theirs.cells[0].nodes)


def blocks(*cells, **more):
    """A meshio mesh of the cube's points and some cells."""
    return meshio.Mesh(CUBE.points, list(cells), **more)


def test_blocks_of_one_kind_are_joined():
    other = blocks(
        ("hexahedron", CUBE.hexes[:2]), ("quad", CUBE.hexes[:3, :4]), ("hexahedron", CUBE.hexes[2:]),
        ("quad", CUBE.hexes[3:4, :4]),
        cell_data={"number": [np.arange(2), np.arange(3), np.arange(2, 27), np.arange(3, 4)]},
        cell_sets={"both": [np.array([1]), None, np.array([0, 1]), np.array([0])]},
    )  # fmt: skip
    mesh = hx.from_meshio(other)
    np.testing.assert_array_equal(mesh.hexes, CUBE.hexes)
    assert mesh.hex_data["number"].tolist() == list(range(27))
    assert mesh.hex_sets["both"].tolist() == [1, 2, 3]
    (quads,) = mesh.cells
    assert (quads.data["number"].tolist(), quads.sets["both"].tolist()) == ([0, 1, 2, 3], [3])


def test_cells_of_other_kinds_are_handled_as_in_a_file():
    mesh = hx.from_meshio(
        blocks(("tetra", CUBE.hexes[:2, [0, 1, 3, 4]]), ("polygon", [[0, 1, 2, 3, 4]]), ("hexahedron", CUBE.hexes[5:]))
    )
    assert mesh.n_hexes == 22
    assert mesh.pinned is None
    assert mesh.n_elements == 24
    assert mesh.notes == ("Not read: 1 cell of another kind (type polygon).",)


def test_a_mesh_without_hexes_is_accepted_if_it_has_other_solid_cells():
    mesh = hx.from_meshio(blocks(("tetra", [[0, 1, 3, 9], [1, 3, 9, 12]])))
    assert [mesh.n_hexes, mesh.n_elements] == [0, 2]
    assert mesh.notes == ("The mesh has no hexes, for which Hexmend is made, but 2 tetra cells.",)
    assert sorted(hx.to_meshio(mesh).cells_dict) == ["tetra"]


def test_physical_groups_of_gmsh_are_sets():
    other = blocks(
        ("hexahedron", CUBE.hexes), ("quad", CUBE.hexes[:2, :4]),
        cell_data={"gmsh:physical": [np.repeat([1, 2, 1], 9), np.array([1, 7])]},
        field_data={"steel": np.array([2, 3]), "wall": np.array([1, 2])},
        cell_sets={"gmsh:bounding_entities": [np.array([5, -900]), np.array([3])]},
    )  # fmt: skip
    mesh = hx.from_meshio(other)
    assert {name: members.tolist() for name, members in mesh.hex_sets.items()} == {"steel": list(range(9, 18))}
    assert {name: members.tolist() for name, members in mesh.cells[0].sets.items()} == {"wall": [0]}


@pytest.mark.parametrize(("other", "words"), [
    (blocks(("triangle", [[0, 1, 2]])), "meshio mesh: holds no hexahedra, but 1 triangle cell."),
    (blocks(("VTK_LAGRANGE_HEXAHEDRON", [range(27)])), "but 1 cell of type VTK_LAGRANGE_HEXAHEDRON."),
    (blocks(), "meshio mesh: holds no hexahedra."),
    (blocks(("hexahedron", [[0, 1, 2, 3, 4, 5, 6, 900]])), "900"),
    (blocks(("hexahedron", CUBE.hexes), point_sets={"a": [900]}), "node set 'a' has 900"),
    ([1, 2], "from_meshio() was given an object of type list; expected a meshio.Mesh"),
    (None, "of type NoneType; expected a meshio.Mesh"),
    (CUBE, "of type Mesh; expected a meshio.Mesh"),
])  # fmt: skip
def test_what_holds_no_hexes_is_refused(other, words):
    with pytest.raises(MeshError) as error:
        hx.from_meshio(other)
    assert words in str(error.value)
