"""Input of a mesh: numbers of every type and shape, ownership of arrays, too many hexes."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import hexmend as hx
from hexmend import Mesh, MeshError
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.size_limits import MAX_HEXES, MAX_NODES
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_hexes
from tests.core.grids import grid
from tests.programs import run_python

ONE = np.arange(8)[None]
TWO = grid(2, 1, 1)
QUAD = [[0, 1, 2, 3]]


def changed(hexes, at, value):
    array = np.array(hexes, dtype=type(value) if isinstance(value, complex) else float)
    array[at] = value
    return array


NO_NODE_NUMBERS = [
    (changed(ONE, (0, 2), np.nan), r"hex 0, corner 2 \(counted from 0\) is nan in hexes: expected a whole number"),
    (changed(ONE, (0, 7), 6.5), "hex 0, corner 7 .* is 6.5"),
    (changed(ONE, (0, 7), np.inf), "hex 0, corner 7 .* is inf"),
    (changed(ONE, (0, 7), 1e17), "hex 0, corner 7 .* is 1e.17"),
    (ONE + 0j, "hexes are of type complex128: expected whole numbers"),
    (ONE > 2, "hexes are of type bool"),
    (ONE.astype("U2"), "hexes are of type <U2"),
    (ONE.astype(object), "hexes are of type object"),
    ([[0, 1], [2]], "hexes cannot be made an array"),
    (ONE.astype(np.uint64) + np.uint64(2**63), "hex 0 .* at corner 0 node 9223372036854775808"),
    (ONE + 2**32, "hex 0 .* at corner 0 node 4294967296: expected numbers from 0 to 7"),
]


@pytest.mark.parametrize(("hexes", "words"), NO_NODE_NUMBERS)
def test_corners_that_are_no_node_numbers_are_refused_by_their_place(hexes, words):
    with pytest.raises(MeshError, match=words):
        Mesh(UNIT_CUBE, hexes)


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int64, np.uint64, np.float16, np.float32, np.float64])
def test_whole_numbers_of_any_type_are_node_numbers(dtype):
    mesh = Mesh(UNIT_CUBE.astype(np.float32), ONE.astype(dtype))
    assert mesh.hexes.dtype == np.int32
    assert mesh.points.dtype == np.float64
    np.testing.assert_array_equal(mesh.hexes, ONE)


NO_REAL_NUMBERS = [
    (UNIT_CUBE + 0j, "points are of type complex128: expected real numbers"),
    (UNIT_CUBE > 0, "points are of type bool"),
    (UNIT_CUBE.astype(str), "points are of type <U"),
    (UNIT_CUBE.astype(object), "points are of type object"),
    ("points", r"points have shape \(\)"),
    ([[0, 1, 2], [3]], "points cannot be made an array"),
]


@pytest.mark.parametrize(("points", "words"), NO_REAL_NUMBERS)
def test_points_that_are_no_real_numbers_are_refused(points, words):
    with pytest.raises(MeshError, match=words):
        Mesh(points, ONE)
    with pytest.raises(MeshError, match=words):
        Mesh(UNIT_CUBE, ONE).with_points(points)


WRONG_FIELDS = [
    ("pinned", np.full(12, 2), r"pinned is 2 at row 0 \(counted from 0\): expected true or false"),
    ("pinned", np.full(12, "x"), "pinned is of type <U1"),
    ("mid_nodes", np.full((2, 19), 0.5), r"hex 0, mid-node 0 \(counted from 0\) is 0.5 in mid_nodes"),
    ("mid_nodes", np.full((2, 19), -2), "hex 0 .* at mid-node 0 node -2: expected numbers from -1 to 11"),
    ("mid_nodes", np.zeros((2, 18), int), r"mid_nodes have shape \(2, 18\): expected \(2, 19\)"),
    ("node_sets", {"a": [0, 12]}, "node set 'a' has 12 at member 1 .*: expected numbers from 0 to 11"),
    ("node_sets", {"a": [[0]]}, r"node set 'a' has shape \(1, 1\): expected \(k,\)"),
    ("node_sets", {"a": [True] * 12}, "node set 'a' are of type bool"),
    ("node_sets", [0, 1], "node set: found list, expected a mapping"),
    ("hex_sets", {"a": [-1]}, "hex set 'a' has -1 at member 0 .*: expected numbers from 0 to 1"),
    ("side_sets", {"a": [[0, 6]]}, "side set 'a' has 6 at side 0, column 1 .*: expected numbers from 0 to 5"),
    ("side_sets", {"a": [[2, 0]]}, "side set 'a' has 2 at side 0, column 0 .*: expected numbers from 0 to 1"),
    ("side_sets", {"a": [0, 1]}, r"side set 'a' has shape \(2,\): expected \(k, 2\)"),
    ("node_data", {"id": 3}, "node data 'id' is a single value: expected 12 rows"),
    ("node_data", {"id": np.arange(3)}, "node data 'id' has 3 rows: expected 12"),
    ("hex_data", {"id": [1, 2, 3]}, "hex data 'id' has 3 rows: expected 2"),
    ("cells", (hx.Cells("quad", [[0, 1, 2, 12]]),), "quad 0 .* at corner 3 node 12: expected numbers from 0 to 11"),
    ("cells", (hx.Cells("quad", [[0, 1, 2]]),), r"quad cells have shape \(1, 3\): expected \(k, 4\)"),
    ("cells", (hx.Cells("cube", [[0, 1, 2]]),), "there is no kind of cells 'cube'"),
    ("cells", (hx.Cells(["quad"], QUAD),), r"there is no kind of cells \['quad'\]"),
    ("cells", (hx.Cells("quad", [[0, 1, 2, 0.5]]),), "quad 0, corner 3 .* is 0.5 in quad cells"),
    ("cells", (hx.Cells("quad", QUAD, {"a": [1, 2]}),), "data of quad cells 'a' has 2 rows: expected 1"),
    ("cells", (hx.Cells("quad", QUAD, {}, {"a": [1]}),), "set of quad cells 'a' has 1 at member 0"),
    ("cells", (hx.Cells("quad", QUAD, 5),), "data of quad cells: found int, expected a mapping"),
    ("cells", (3,), "cells hold int: expected hexmend.Cells"),
    ("cells", None, "cells are of type NoneType: expected a tuple of hexmend.Cells"),
    ("cells", 5, "cells are of type int: expected a tuple"),
]


@pytest.mark.parametrize(("field", "value", "words"), WRONG_FIELDS)
def test_fields_of_a_mesh_are_checked_when_it_is_made_and_when_they_are_replaced(field, value, words):
    with pytest.raises(MeshError, match=words):
        Mesh(TWO.points, TWO.hexes, **{field: value})
    with pytest.raises(MeshError, match=words):
        TWO.replace(**{field: value})
    with pytest.raises(MeshError, match=words):
        TWO.rebuilt(**{field: value})


@pytest.mark.slow
def test_wrong_values_end_in_a_sentence_and_never_in_a_crash():
    root = Path(__file__).resolve().parents[3]
    done = run_python("-W", "error", "-m", "tests.core.hostile", paths=[root], cwd=root)
    assert done.returncode == 0, done.stderr[-3000:] or f"the process died of signal {-done.returncode}"


@pytest.mark.parametrize("give", [
    lambda array: Mesh(array, TWO.hexes), TWO.with_points, lambda array: TWO.rebuilt(points=array),
], ids=["Mesh", "with_points", "rebuilt"])  # fmt: skip
@pytest.mark.parametrize(
    "view", [lambda array: array, lambda array: array[:], np.asfortranarray], ids=["own", "view", "F"]
)
def test_the_callers_points_stay_writable_and_later_changes_do_not_reach_the_mesh(give, view):
    mine = TWO.points.copy()
    given = view(mine)
    mesh = give(given)
    given[0] = mine[0] = 99
    np.testing.assert_array_equal(mesh.points, TWO.points)
    with pytest.raises(ValueError, match="read-only"):
        mesh.points[0, 0] = 1


OTHER_FIELDS = [
    ("hexes", TWO.hexes), ("pinned", np.zeros(12, bool)), ("mid_nodes", np.full((2, 19), -1, np.int32)),
    ("node_data", np.zeros(12)), ("hex_data", np.zeros(2)), ("node_sets", np.arange(3)), ("hex_sets", np.arange(2)),
    ("side_sets", np.zeros((1, 2), int)),
]  # fmt: skip


@pytest.mark.parametrize(("field", "value"), OTHER_FIELDS)
def test_everything_else_that_is_given_stays_the_callers_too(field, value):
    mine, table = value.copy(), field.endswith(("data", "sets"))
    mesh = TWO.rebuilt(**{field: {"a": mine} if table else mine})
    mine[...] = 1
    kept = getattr(mesh, field)
    np.testing.assert_array_equal(kept["a"] if table else kept, value)


@dataclass(frozen=True)
class Short(hx.Smoother):
    """Method that omits nodes."""

    name = "short"
    title = "Short"
    help = "Yields the points of some nodes."
    source = "nobody"

    def steps(self, mesh):
        yield hx.Step(mesh.points)
        yield hx.Step(mesh.points[:1])


def test_points_of_a_step_have_to_be_those_of_all_nodes():
    with pytest.raises(MeshError, match=r"short: the points of a step have shape \(1, 3\): expected \(64, 3\)"):
        hx.smooth(grid(3), Short())


def test_more_hexes_than_corners_have_numbers_are_refused_before_anything_is_computed():
    many = np.broadcast_to(np.arange(8), (MAX_HEXES + 1, 8))  # one row in memory
    for make in (lambda: as_hexes(many, 8), lambda: Topology(many, 8), lambda: Mesh(UNIT_CUBE, many)):
        with pytest.raises(MeshError, match=r"there are 268,435,456 hexes: expected 268,435,455 at most, .* divide"):
            make()
    with pytest.raises(MeshError, match="there are 2,147,483,648 nodes: expected 2,147,483,647 at most"):
        Mesh(np.broadcast_to(np.zeros(3), (MAX_NODES + 1, 3)), ONE)
    assert 8 * MAX_HEXES + 7 <= MAX_NODES


def test_masked_values_are_refused_and_not_read_as_what_is_under_the_mask():
    points, hexes = np.ma.array(UNIT_CUBE), np.ma.array(ONE)
    assert Mesh(points, hexes).n_nodes == 8  # nothing is masked
    points[3, 1] = np.ma.masked
    hexes[0, :2] = np.ma.masked
    with pytest.raises(MeshError, match="points: 1 of the values are masked; fill them in"):
        Mesh(points, ONE)
    with pytest.raises(MeshError, match="hexes: 2 of the values are masked"):
        Mesh(UNIT_CUBE, hexes)
    with pytest.raises(MeshError, match="points: 1 of the values are masked"):
        Mesh(UNIT_CUBE, ONE).with_points(points)
