"""Meshes to meshio's and PyVista's and back: what comes with them comes back, and neither side changes the other."""

import numpy as np
import pytest
from hypothesis import given

import hexmend as hx
from hexmend.errors import InstallationError
from hexmend.interop.meshio_mesh import with_side_marks, with_side_sets
from tests.core.grids import grid
from tests.core.interop.meshes import assert_round_trip, of_gallery, with_all_data, with_sets
from tests.core.io.kept import middles_are_in_the_middle

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
