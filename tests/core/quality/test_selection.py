"""Regions of a mesh: hexes by names, numbers, a box and rings, each against a count of its own."""

import numpy as np
import pytest

from hexmend.errors import MeshError, ParameterError
from tests.core.grids import grid, scrambled

#: Hex k of 64 is at (k % 4, k // 4 % 4, k // 16), and its centre half an edge from there.
MESH = grid(4).replace(
    hex_sets={"core": np.array([21, 22, 25]), "far": np.array([63, 62])},
    node_sets={"corner": np.array([0])},
    side_sets={"wall": np.array([[3, 2], [7, 2], [7, 0]])},
    hex_data={"material": np.arange(64) // 32 + 7},
)
CENTRES = np.column_stack([np.arange(64) % 4, np.arange(64) // 4 % 4, np.arange(64) // 16]) + 0.5


@pytest.mark.parametrize(("names", "hexes"), [
    (["core"], [21, 22, 25]),
    (["far", "core"], [21, 22, 25, 62, 63]),
    (["corner"], [0]),
    (["wall"], [3, 7]),
    (["8"], range(32, 64)),
    ([], range(64)),
    (["inverted"], []),
])  # fmt: skip
def test_names_of_sets_and_materials(names, hexes):
    assert MESH.region(*names).tolist() == list(hexes)


def test_a_box_holds_the_hexes_with_their_centre_in_it():
    box = np.array([[3.0, 1.0, 0.5], [0.0, 2.5, 2.4]])  # corners in any order; bounds belong to it
    inside = ((box.min(axis=0) <= CENTRES) & (box.max(axis=0) >= CENTRES)).all(axis=1)
    assert 0 < inside.sum() < 64
    np.testing.assert_array_equal(MESH.region(box=box), np.flatnonzero(inside))


def test_what_is_given_together_is_the_intersection_and_rings_come_last():
    marks = np.zeros(64, dtype=bool)
    marks[[0, 21, 25]] = True
    assert MESH.region("core", hexes=marks).tolist() == MESH.region("core", hexes=[25, 0, 21]).tolist() == [21, 25]
    assert MESH.region("core", box=[(0, 0, 0), (2, 2, 2)]).tolist() == [21]
    near = (np.abs(CENTRES - CENTRES[21]) <= 1).all(axis=1)
    np.testing.assert_array_equal(MESH.region(hexes=21, rings=1), np.flatnonzero(near))
    assert MESH.region(hexes=[]).size == MESH.region(hexes=[], rings=3).size == 0


def test_inverted_hexes_are_those_that_are_measured():
    tangled = scrambled(MESH, 1.2)
    assert 0 < tangled.quality().inverted == tangled.region("inverted").size
    assert set(tangled.region("inverted")) <= set(np.flatnonzero(tangled.quality("scaled_jacobian") <= 0))


@pytest.mark.parametrize(("given", "error", "words"), [
    ({"names": ["faar"]}, MeshError, "there is no set or material 'faar': did you mean far\\? there are"),
    ({"names": ["zzz"]}, MeshError, "'zzz': there are 'corner', 'core', 'far', 'wall', '7', '8', 'inverted'"),
    ({"hexes": [64]}, MeshError, "hexes"),
    ({"hexes": np.ones(63, bool)}, MeshError, "hexes"),
    ({"box": [0, 1]}, MeshError, "expected two opposite corners"),
    ({"box": [(0, 0, 0), (1, 1, np.nan)]}, MeshError, "expected two opposite corners"),
    ({"rings": -1}, ParameterError, "rings = -1 is out of range"),
    ({"rings": 2**31}, ParameterError, "rings = 2147483648 is out of range"),
])  # fmt: skip
def test_what_is_no_region_is_refused(given, error, words):
    with pytest.raises(error, match=words):
        MESH.region(*given.pop("names", ()), **given)
