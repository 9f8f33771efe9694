"""Meshes to meshio's and PyVista's and back: what comes with them comes back, and neither side changes the other."""

import pytest
from hypothesis import given

import hexmend as hx
from hexmend.errors import InstallationError
from tests.core.grids import grid
from tests.core.interop.meshes import assert_round_trip, of_gallery, with_all_data, with_sets
from tests.core.io.kept import middles_are_in_the_middle

LIBRARIES = {"meshio": (hx.to_meshio, hx.from_meshio), "pyvista": (hx.to_pyvista, hx.from_pyvista)}
each = pytest.mark.parametrize("library", LIBRARIES)


@pytest.fixture(autouse=True)
def installed(library):
    pytest.importorskip(library)


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
