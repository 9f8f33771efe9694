"""Immutable arrays of a mesh: they cannot be written to, and meshes share them."""

import pickle
from dataclasses import dataclass

import numpy as np
import pytest

import hexmend as hx
from hexmend.arrays import as_immutable, is_immutable
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from tests.core.grids import grid

TWO = grid(2, 1, 1)


def writable_alias(hexes):
    """Make read-only hexes that own their memory, with an older view that is still writable."""
    mine = np.array(hexes)
    alias = mine[:]
    mine.flags.writeable = False
    return mine, lambda: alias.__setitem__((0, 0), 10**9)


def thawed(hexes):
    """Make read-only hexes that own their memory: NumPy can make them writable again."""
    mine = np.array(hexes)
    mine.flags.writeable = False

    def write():
        mine.flags.writeable = True
        mine[0, 0] = 10**9

    return mine, write


def unpickled(hexes):
    """Make hexes from a pickle: their memory belongs to `bytes`, but is writable."""
    mine = pickle.loads(pickle.dumps(np.array(hexes), protocol=4))
    alias = mine[:]
    mine.flags.writeable = False
    return mine, lambda: alias.__setitem__((0, 0), 10**9)


def buffered(hexes):
    """Make hexes from a read-only memoryview of a writable array."""
    mine = np.array(hexes)
    return np.asarray(memoryview(mine).toreadonly()), lambda: mine.__setitem__((0, 0), 10**9)


@pytest.mark.parametrize("make", [writable_alias, thawed, unpickled, buffered])
def test_a_read_only_array_that_can_still_be_written_to_does_not_change_a_mesh(make):
    hexes, write = make(TWO.hexes)
    mesh, topology = Mesh(TWO.points, hexes), Topology(hexes, TWO.n_nodes)
    write()
    for kept in (mesh.hexes, topology.hexes, mesh.topology.hexes):
        np.testing.assert_array_equal(kept, TWO.hexes)
    np.testing.assert_array_equal(mesh.quality("q"), TWO.quality("q"))


@pytest.mark.parametrize("name", ["points", "hexes", "fixed", "free"])
def test_nobody_can_make_the_arrays_of_a_mesh_writable(name):
    array = getattr(Mesh(TWO.points.copy(), TWO.hexes.copy()), name)
    for view in (array, array[:]):
        with pytest.raises(ValueError, match="cannot set WRITEABLE"):
            view.flags.writeable = True


@pytest.mark.parametrize(
    "values",
    [np.zeros((2, 3)), np.zeros((0, 3)), np.zeros((2, 3), order="F"), np.array(["a", "bc"]), np.array([b"a"]),
     np.array([1 + 2j]), np.array([True]), np.array(["2020-01-01"], "M8[D]"), np.zeros(2, [("a", "i4"), ("b", "f8")])],
    ids=lambda values: f"{values.dtype}-{values.shape}",
)  # fmt: skip
def test_an_immutable_copy_has_the_values_and_is_copied_no_more(values):
    kept = as_immutable(values)
    np.testing.assert_array_equal(kept, values)
    assert kept.dtype == values.dtype
    assert kept.flags.c_contiguous
    assert not np.shares_memory(kept, values)
    assert values.flags.writeable
    assert [is_immutable(values), is_immutable(kept), is_immutable(kept[1:])] == [False, True, True]
    assert as_immutable(kept) is kept


def test_cells_have_arrays_of_their_own():
    nodes, data, chosen = np.array([[0, 1, 2, 3]]), np.zeros(1), np.zeros(1, int)
    mesh = TWO.replace(cells=[hx.Cells("quad", nodes, {"a": data}, {"b": chosen})])
    nodes[...], data[...], chosen[...] = 7, 7, 7
    (cells,) = mesh.cells
    assert cells.nodes.dtype == np.int32
    assert [cells.nodes.tolist(), cells.data["a"].tolist(), cells.sets["b"].tolist()] == [[[0, 1, 2, 3]], [0.0], [0]]
    assert all(is_immutable(array) for array in (cells.nodes, cells.data["a"], cells.sets["b"]))
    assert mesh.rebuilt(name="other").cells[0].nodes is cells.nodes
    assert TWO.replace(cells=(hx.Cells("quad", [[0.0, 1.0, 2.0, 3.0]]),)).cells[0].nodes.dtype == np.int32


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_meshes_come_out_of_a_pickle_immutable_and_of_one_lineage(protocol):
    mesh = TWO.replace(pinned=np.ones(12, bool), node_sets={"a": [1]}, cells=(hx.Cells("line", [[0, 1]]),))
    moved = mesh.with_points(mesh.points + 1)
    assert moved.fixed.all()
    first, second = pickle.loads(pickle.dumps((mesh, moved), protocol=protocol))
    assert first.hexes is second.hexes is first.topology.hexes
    np.testing.assert_array_equal(second.points, moved.points)
    arrays = [second.points, second.hexes, second.pinned, second.fixed, second.node_sets["a"], second.cells[0].nodes]
    assert all(is_immutable(array) for array in arrays)


@dataclass(frozen=True)
class Reuses(hx.Smoother):
    """Method that overwrites the array that it has yielded."""

    name = title = "reuses"
    help = source = "Moves its own array."

    def steps(self, mesh):
        points = mesh.points.copy()
        yield hx.Step(points)
        while True:
            points[mesh.free] += 0.01
            yield hx.Step(points)


def test_a_method_may_go_on_writing_to_the_array_that_it_yields():
    mesh = grid(2)
    seen = [iteration.points for iteration in hx.iterate(mesh, Reuses(), max_iterations=3)]
    for number, points in enumerate(seen, 1):
        np.testing.assert_allclose(points[mesh.free], mesh.points[mesh.free] + 0.01 * number)
