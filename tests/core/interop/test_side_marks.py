"""Side sets as data of hexes, and back."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.interop.conversion import with_side_marks, with_side_sets
from tests.core.grids import grid


def test_every_side_is_a_bit():
    sides = np.array([[hex, face] for hex in (0, 3) for face in range(6)])
    marked = with_side_marks(grid(2).replace(side_sets={"all": sides}))
    assert marked.side_sets == {}
    assert marked.hex_data["sides:all"].tolist() == [63, 0, 0, 63, 0, 0, 0, 0]
    np.testing.assert_array_equal(with_side_sets(marked).side_sets["all"], sides)


@pytest.mark.parametrize(("to", "back", "library"), [
    (hx.to_pyvista, hx.from_pyvista, "pyvista"), (hx.to_meshio, hx.from_meshio, "meshio"),
])  # fmt: skip
@pytest.mark.parametrize(("name", "count"), [("layered", 2), ("jet.exo", 5)])
def test_the_side_sets_of_a_mesh_come_back(sample_mesh, name, count, to, back, library):
    pytest.importorskip(library)
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
