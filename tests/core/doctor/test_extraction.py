"""Some hexes of a mesh, as a mesh with what belongs to them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, Mesh
from hexmend.doctor.removal import extract_hexes
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from tests.core.grids import grid

GRID = grid(3, 2, 2)
M, N = GRID.n_hexes, GRID.n_nodes
LOW_X = int(np.flatnonzero((UNIT_CUBE[np.array(FACES), 0] == 0).all(axis=1))[0])
BOUNDARY = GRID.topology.boundary_faces
MESH = GRID.rebuilt(
    hex_data={"id": np.arange(100, 100 + M)},
    node_data={"id": np.arange(1000, 1000 + N)},
    hex_sets={"even": np.arange(0, M, 2), "first": np.array([0])},
    node_sets={"odd": np.arange(1, N, 2)},
    side_sets={"low x": np.array([[h, LOW_X] for h in range(0, M, 3)])},
    cells=(
        Cells("quad", BOUNDARY.astype(np.int32), {"ref": np.arange(len(BOUNDARY))}, {"some": np.arange(0, len(BOUNDARY), 3)}),
        Cells("tetra", GRID.hexes[:2, [0, 1, 3, 4]]),
    ),
    pinned=np.arange(N) % 5 == 0,
)  # fmt: skip


def places(mesh, nodes):
    return {tuple(point) for point in mesh.points[nodes].tolist()}


@given(st.lists(st.booleans(), min_size=M, max_size=M).map(np.array).filter(np.any))
def test_hexes_keep_their_places_ids_sets_and_faces(kept):
    part, rows = extract_hexes(MESH, kept), np.flatnonzero(kept)
    np.testing.assert_array_equal(part.points[part.hexes], MESH.points[MESH.hexes[rows]])
    assert part.topology.used.all()
    np.testing.assert_array_equal(part.hex_data["id"], MESH.hex_data["id"][rows])
    ids = part.node_data["id"] - 1000
    np.testing.assert_array_equal(part.points, MESH.points[ids])
    for name, members in MESH.hex_sets.items():
        assert part.hex_data["id"][part.hex_sets.get(name, [])].tolist() == [100 + h for h in members if kept[h]]
    assert set(ids[part.node_sets.get("odd", [])]) == set(MESH.node_sets["odd"]) & set(ids)
    np.testing.assert_array_equal(part.pinned, MESH.pinned[ids])
    sides = part.side_sets.get("low x", np.empty((0, 2), int))
    assert places(part, part.hexes[sides[:, 0, None], np.array(FACES)[sides[:, 1]]].ravel()) == {
        (0.0, *yz)
        for h in MESH.side_sets["low x"][:, 0]
        if kept[h]
        for yz in MESH.points[MESH.hexes[h]][MESH.points[MESH.hexes[h]][:, 0] == 0][:, 1:].tolist()
    }


@given(st.lists(st.booleans(), min_size=M, max_size=M).map(np.array).filter(np.any))
def test_quads_on_the_hexes_stay_and_other_solid_cells_do_not(kept):
    part = extract_hexes(MESH, kept)
    assert all(cells.kind == "quad" for cells in part.cells)
    there = set(map(tuple, part.points.tolist()))
    expected = [q for q, quad in enumerate(BOUNDARY) if places(MESH, quad) <= there]
    for cells in part.cells:
        assert cells.data["ref"].tolist() == expected
        assert cells.data["ref"][cells.sets.get("some", [])].tolist() == [q for q in expected if q % 3 == 0]
        np.testing.assert_array_equal(part.points[cells.nodes], MESH.points[BOUNDARY[expected]])
    assert bool(part.cells) == bool(expected)


def test_mid_nodes_stay_with_their_hexes():
    middle = np.arange(M * 19).reshape(M, 19) + N
    points = np.concatenate([GRID.points, np.random.default_rng(1).random((M * 19, 3))])
    mesh = Mesh(points, GRID.hexes, mid_nodes=middle.astype(np.int32))
    part = extract_hexes(mesh, np.arange(M) == 5)
    assert part.n_nodes == 27
    np.testing.assert_array_equal(part.points[part.mid_nodes[0]], mesh.points[middle[5]])
