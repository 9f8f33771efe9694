"""Meshes to and from PyVista's grids: what comes with them comes back, and what is no mesh of hexes is refused.

Meshes to meshio's and PyVista's and back: what comes with them comes back, and neither side changes the other.
"""

import warnings

import numpy as np
import pytest
from hypothesis import given

import hexmend as hx
from hexmend.errors import InstallationError, MeshError
from hexmend.interop.meshio_mesh import with_side_marks, with_side_sets
from tests.core.grids import grid
from tests.core.interop.meshes import assert_round_trip, of_gallery, with_all_data, with_sets
from tests.core.io.kept import middles_are_in_the_middle

pv = pytest.importorskip("pyvista")

CUBE = hx.gallery.make("cube", size=27)


def boxes(n=2):
    """A structured grid of n cubes a side."""
    x = np.arange(n + 1.0)
    return pv.StructuredGrid(*np.meshgrid(x, x, x, indexing="ij"))


@pytest.mark.parametrize(("nodes", "type"), [(8, 12), (20, 25), (27, 29)])
def test_pyvista_measures_the_hexes_as_we_do(nodes, type):
    grid = hx.to_pyvista(with_all_data(nodes))
    assert (grid.celltypes[:12] == type).all()
    volumes = grid.extract_cells(np.arange(12)).compute_cell_sizes()["Volume"]
    assert volumes.sum() == pytest.approx(12, rel=1e-6)


def test_a_side_set_names_faces_as_vtk_numbers_them():
    mesh = CUBE.replace(side_sets={"inlet": np.array([[0, 4], [2, 1]])})
    grid = hx.to_pyvista(mesh)
    assert grid.cell_data["sides:inlet"][:3].tolist() == [16, 0, 2]
    assert set(grid.get_cell(0).faces[4].point_ids) == set(mesh.hexes[0, :4].tolist())


def test_sets_stay_right_in_a_part_of_the_grid():
    mesh = CUBE.replace(side_sets={"inlet": np.array([[5, 4], [20, 1]])}, hex_sets={"two": np.array([4, 20])})
    back = hx.from_pyvista(hx.to_pyvista(mesh).extract_cells([20, 5, 6]))
    ids = [20, 5, 6] if np.allclose(back.points[back.hexes[0]], mesh.points[mesh.hexes[20]]) else [5, 6, 20]
    assert {(ids[hex], face) for hex, face in back.side_sets["inlet"].tolist()} == {(5, 4), (20, 1)}
    assert [ids[hex] for hex in back.hex_sets["two"]] == [20]


@pytest.mark.parametrize("grid", [
    boxes(), pv.ImageData(dimensions=(3, 3, 3)), pv.RectilinearGrid(*[np.arange(3.0)] * 3),
    boxes().cast_to_explicit_structured_grid(), boxes().cast_to_unstructured_grid(),
], ids=lambda grid: type(grid).__name__)  # fmt: skip
def test_every_grid_of_pyvista_with_hexes_is_taken(grid):
    mesh = hx.from_pyvista(grid)
    assert (mesh.n_hexes, mesh.n_nodes) == (8, 27)
    assert mesh.quality("q").min() == pytest.approx(1)


def mixed():
    """Six cells in this order: a quad, a hex, a tetrahedron, a hex, a polygon of five nodes, a voxel."""
    points = hx.gallery.make("cube", size=27).points
    hexes = CUBE.hexes
    voxel = hexes[2][[0, 1, 3, 2, 4, 5, 7, 6]]
    cells = [hexes[0][:4], hexes[0], hexes[5][[0, 1, 3, 4]], hexes[1], range(5), voxel]
    grid = pv.UnstructuredGrid(
        np.concatenate([[len(cell), *cell] for cell in cells]), np.array([9, 12, 10, 12, 7, 11], np.uint8), points
    )
    grid.cell_data["number"] = np.arange(6)
    return grid


def test_cells_of_other_kinds_are_handled_as_in_a_file(tmp_path):
    mixed().save(tmp_path / "mixed.vtu")
    read, mesh = hx.read(tmp_path / "mixed.vtu"), hx.from_pyvista(mixed())
    assert mesh.hex_data["number"].tolist() == [1, 3, 5]
    found = {cells.kind: cells.data["number"].tolist() for cells in mesh.cells}
    assert found == {"quad": [0], "tetra": [2]}
    assert mesh.notes == read.notes
    assert any("VTK_POLYGON" in note for note in mesh.notes)
    assert_round_trip(read.replace(notes=()), mesh)


def test_hidden_ghost_cells_of_a_piece_are_left_out():
    grid = boxes().cast_to_unstructured_grid()
    grid.cell_data["vtkGhostType"] = np.array([1] * 4 + [0] * 4, np.uint8)
    assert hx.from_pyvista(grid).n_hexes == 4


@pytest.mark.parametrize(("grid", "words"), [
    (pv.Sphere(), "PyVista grid: holds no hexahedra, but"),
    (pv.UnstructuredGrid(), "PyVista grid: holds no hexahedra"),
    (pv.MultiBlock([boxes()]), "of type MultiBlock: join its blocks with combine()"),
    (pv.Table({"a": np.arange(2)}), "of type Table; expected a PyVista data set with hexahedra"),
    ([1, 2], "of type list; expected a PyVista data set with hexahedra"),
    (np.zeros((8, 3)), "of type ndarray; expected"),
    (None, "of type NoneType; expected"),
    (CUBE, "of type Mesh; expected"),
])  # fmt: skip
def test_what_holds_no_hexes_is_refused(grid, words):
    with pytest.raises(MeshError) as error:
        hx.from_pyvista(grid)
    assert words in str(error.value)


def test_a_coordinate_that_is_no_number_is_refused():
    grid = hx.to_pyvista(CUBE)
    grid.points[3, 1] = np.nan
    with pytest.raises(MeshError, match="finite"):
        hx.from_pyvista(grid)


def test_arrays_that_pyvista_cannot_hold_are_named():
    times = np.zeros(CUBE.n_nodes, "datetime64[s]")
    mesh = CUBE.replace(node_data={"when": times, "what": times.astype(object), "values": np.arange(CUBE.n_nodes)})
    with pytest.warns(UserWarning, match="cannot hold are left out: when, what") as warned:
        grid = hx.to_pyvista(mesh)
    assert warned[0].filename == __file__
    assert grid.point_data.keys() == ["values"]


def test_small_and_tall_arrays_are_kept_in_the_next_type_and_shape():
    n = CUBE.n_nodes
    tensors = np.arange(9.0 * n).reshape(n, 3, 3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        back = hx.from_pyvista(
            hx.to_pyvista(CUBE.replace(node_data={"half": np.full(n, 0.5, np.float16), "t": tensors}))
        )
    assert back.node_data["half"].dtype == np.float32
    np.testing.assert_array_equal(back.node_data["t"], tensors.reshape(n, 9))


LIBRARIES = {"meshio": (hx.to_meshio, hx.from_meshio), "pyvista": (hx.to_pyvista, hx.from_pyvista)}
each = pytest.mark.parametrize("library", LIBRARIES)


@pytest.fixture(autouse=True)
def installed(request):
    if "library" in request.fixturenames:
        pytest.importorskip(request.getfixturevalue("library"))


@each
@pytest.mark.parametrize("mesh", [*map(with_all_data, (8, 20, 27)), of_gallery("plane", 700)])
def test_everything_that_comes_with_a_mesh_comes_back(library, mesh):
    to, back = LIBRARIES[library]
    found = back(to(mesh), as_is=True)
    assert_round_trip(mesh, found)
    middles_are_in_the_middle(found)


@each
@given(mesh=with_sets())
def test_any_sets_and_fixed_nodes_come_back(library, mesh):
    to, back = LIBRARIES[library]
    assert_round_trip(mesh, back(to(mesh)))


@each
def test_neither_side_changes_the_other(library):
    to, back = LIBRARIES[library]
    mesh = with_all_data()
    other = to(mesh)
    found = back(other, as_is=True)
    other.points += 1
    other.point_data["velocity"][:] = 0
    assert_round_trip(with_all_data(), found)
    assert_round_trip(with_all_data(), mesh)


@each
def test_hexes_wound_the_other_way_are_turned_unless_they_are_wanted_so(library):
    to, back = LIBRARIES[library]
    cube = grid(3)
    other = to(cube.rebuilt(hexes=cube.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]]))
    assert back(other).quality("q").min() > 0
    assert "renumbered" in back(other).notes[-1]
    assert back(other, as_is=True).quality("q").max() == 0


@each
def test_without_the_library_it_is_said_what_to_install(library, absent):
    absent(library)
    to, back = LIBRARIES[library]
    for call in (lambda: to(grid(1)), lambda: back(None)):
        with pytest.raises(InstallationError, match=rf"^{library} is not installed: pip install {library}$"):
            call()


# Side sets as data of hexes, and back.


def test_every_side_is_a_bit():
    sides = np.array([[hex, face] for hex in (0, 3) for face in range(6)])
    marked = with_side_marks(grid(2).replace(side_sets={"all": sides}))
    assert marked.side_sets == {}
    assert marked.hex_data["sides:all"].tolist() == [63, 0, 0, 63, 0, 0, 0, 0]
    np.testing.assert_array_equal(with_side_sets(marked).side_sets["all"], sides)


@each
@pytest.mark.parametrize(("name", "count"), [("layered", 2), ("jet.exo", 5)])
def test_the_side_sets_of_a_mesh_come_back(sample_mesh, name, count, library):
    to, back = LIBRARIES[library]
    mesh = sample_mesh(name)
    found = back(to(mesh)).side_sets
    assert len(mesh.side_sets) == count
    assert {name: set(map(tuple, rows.tolist())) for name, rows in found.items()} == {
        name: set(map(tuple, rows.tolist())) for name, rows in mesh.side_sets.items()
    }


def test_marks_that_became_real_numbers_are_sides_still():
    mesh = grid(1).replace(hex_data={"sides:a": np.array([3.0])})
    assert with_side_sets(mesh).side_sets["a"].tolist() == [[0, 0], [0, 1]]


def test_data_of_such_a_name_with_other_numbers_stay_data():
    for values in (
        np.array([64]),
        np.array([-1]),
        np.array([0.5]),
        np.array([np.nan]),
        np.array([[1]]),
        np.array(["a"]),
    ):
        mesh = with_side_sets(grid(1).replace(hex_data={"sides:a": values}))
        assert (list(mesh.hex_data), mesh.side_sets) == (["sides:a"], {})


def test_a_mesh_without_sides_is_as_it_was():
    mesh = grid(1)
    assert with_side_sets(mesh) is mesh
    assert with_side_marks(mesh).hex_data == {}
