"""Repairs keep data, sets and pins, and leave a valid mesh."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, LinearMotion, Mesh, measure
from hexmend.doctor import examine, repair
from hexmend.doctor.cells import _WEDGES
from hexmend.doctor.removal import extract_hexes, renumber_nodes
from hexmend.mesh.hexahedron import EDGES, FACES, UNIT_CUBE
from hexmend.mesh.materials import CONTACT_CARDS
from tests.core.doctor.faulty_meshes import SOUND, blocks, collapsed, found_in
from tests.core.grids import grid


def test_merged_blocks_are_one_grid():
    after, _ = repair(blocks())
    assert examine(after) == ()
    assert after.n_nodes == 2 * 64 - 16
    assert after.topology.boundary_faces.shape == (9 * 10 - 9 * 2 + 0 + 36 - 0 - 18, 4) or after.topology.parts == 1
    assert measure(after.points, after.hexes).n_inverted == 0


def test_data_sets_and_pins_follow():
    mesh = blocks()
    n, m = mesh.n_nodes, mesh.n_hexes
    rich = mesh.rebuilt(
        node_data={"id": np.arange(n) + 100},
        hex_data={"id": np.arange(m) + 500},
        node_sets={"last": np.array([n - 1])},
        hex_sets={"right": np.arange(27, 54)},
        side_sets={"end": np.array([[53, 1]])},
        pinned=np.arange(n) == n - 1,
        cells=(Cells("quad", mesh.hexes[53][FACES[1]][None]),),
    )
    after, _ = repair(rich)
    (last,) = after.node_sets["last"]
    np.testing.assert_array_equal(after.points[last], mesh.points[-1])
    assert after.node_data["id"][last] == 100 + n - 1
    assert after.pinned[last]
    np.testing.assert_array_equal(after.hex_sets["right"], np.arange(27, 54))
    np.testing.assert_array_equal(after.cells[0].nodes[0], after.hexes[53][FACES[1]])
    fewer, _ = repair(rich.rebuilt(hexes=np.vstack([mesh.hexes[:-1], mesh.hexes[:1]])), ["duplicate-hexes"])
    np.testing.assert_array_equal(fewer.hex_sets["right"], [0, *range(27, 53)])
    assert fewer.side_sets["end"].tolist() == [[0, 1]]


def test_every_collapsed_pair_of_edges_makes_a_wedge_that_stands_upright():
    assert len(_WEDGES) == 12
    edges = {tuple(sorted(edge)) for edge in EDGES.tolist()}
    for pair, corners in _WEDGES.items():
        assert pair <= edges
        x = UNIT_CUBE.copy()
        for a, b in pair:
            x[[a, b]] = x[[a, b]].mean(axis=0)
        a, b, c, d = x[list(corners[:4])]
        assert np.linalg.det([b - a, c - a, d - a]) > 0
        assert len({tuple(place) for place in x[list(corners)]}) == 6


def test_a_collapsed_hex_is_kept_as_a_wedge_whose_nodes_stay():
    mesh = collapsed()
    after, _ = repair(mesh)
    assert after.n_hexes == 26
    assert [cells.kind for cells in after.cells] == ["wedge"]
    assert after.fixed[after.cells[0].nodes].all()


def test_a_duplicate_leaves_its_sets_and_sides_to_the_hex_that_is_kept():
    hexes = np.vstack([SOUND.hexes, SOUND.hexes[:1]])
    sets, sides = {"a": np.array([0]), "b": np.array([27])}, {"s": np.array([[27, 2]])}
    after, _ = repair(Mesh(SOUND.points, hexes, hex_sets=sets, side_sets=sides))
    assert {name: rows.tolist() for name, rows in after.hex_sets.items()} == {"a": [0], "b": [0]}
    assert after.side_sets["s"].tolist() == [[0, 2]]


def test_a_wedge_keeps_what_the_hex_had():
    mesh = collapsed().replace(hex_data={"id": np.arange(27) + 7}, hex_sets={"a": np.array([0, 1])})
    after, _ = repair(mesh, ["degenerate-hexes"])
    (wedges,) = after.cells
    assert wedges.data["id"].tolist() == [7]
    assert wedges.sets["a"].tolist() == [0]
    assert after.hex_sets["a"].tolist() == [0]


def test_what_cannot_be_mended_is_not_said_to_be():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1.0]])
    mesh = Mesh(points, [[0, 1, 2, 2, 3, 4, 5, 5]])
    assert not found_in(mesh)["degenerate-hexes"].mendable
    after, mended = repair(mesh)
    assert mended == ()
    assert after is mesh


def test_a_mesh_written_twice_is_one_mesh_again():
    mesh = Mesh(np.vstack([SOUND.points] * 2), np.vstack([SOUND.hexes, SOUND.hexes + SOUND.n_nodes]))
    after, mended = repair(mesh)
    assert {finding.kind for finding in mended} == {"coincident-nodes", "duplicate-hexes"}
    assert examine(after) == ()
    assert after.n_hexes == SOUND.n_hexes


def test_bodies_of_different_materials_or_in_contact_are_not_glued():
    touching = blocks()
    halves = {"left": np.arange(27), "right": np.arange(27, 54)}
    for mesh in (touching.replace(hex_sets=halves), touching.replace(field_data={CONTACT_CARDS: ["TIE"]})):
        assert "coincident-nodes" not in found_in(mesh)
        assert repair(mesh) == (mesh, ())


def test_nodes_inside_a_material_are_merged_up_to_its_interface():
    mesh = blocks()
    material = (mesh.points[mesh.hexes].mean(axis=1)[:, 1] > np.median(mesh.points[:, 1])).astype(int)
    after, _ = repair(mesh.replace(hex_data={"material": material}))
    assert after.n_nodes == repair(mesh)[0].n_nodes == mesh.n_nodes - 16


def test_nodes_of_faces_are_merged_with_those_of_hexes_but_join_no_materials():
    touching = blocks().replace(hex_sets={"left": np.arange(27), "right": np.arange(27, 54)})
    for side, merged in (0, 16), (3, 0):  # faces at x = 0 of the left block, and at x = 3, where the blocks touch
        faces = SOUND.topology.boundary_faces
        nodes, quads = np.unique(faces[(SOUND.points[faces, 0] == side).all(axis=1)], return_inverse=True)
        points = np.vstack([touching.points, SOUND.points[nodes]])
        quads = Cells("quad", touching.n_nodes + quads.reshape(-1, 4))
        mesh = Mesh(points, touching.hexes, cells=(quads,), hex_sets=touching.hex_sets)
        assert ("coincident-nodes" in found_in(mesh)) is (merged > 0)
        assert repair(mesh)[0].n_nodes == mesh.n_nodes - merged


def test_a_linear_motion_follows_the_numbers_of_its_nodes():
    mesh = grid(2)
    bottom, top = (np.flatnonzero(mesh.points[:, 2] == z) for z in (0, 2))
    motion = LinearMotion.tying(top, bottom).merge(LinearMotion.in_planes(bottom, [0.0, 0, 1]))
    mesh = mesh.with_linear_motion(motion)
    order = np.random.default_rng(0).permutation(mesh.n_nodes)
    other = renumber_nodes(mesh, order)
    np.testing.assert_array_equal(other.fixed[order], mesh.fixed)
    shift = np.random.default_rng(1).normal(0, 0.1, mesh.points.shape)
    moved = np.empty(shift.shape)
    moved[order] = mesh.constrained(mesh.points + shift)
    back = np.argsort(order)
    np.testing.assert_allclose(other.constrained(moved), moved, atol=1e-15)
    assert (other.constrained(other.points + shift[back])[order[top], 2] == 2).all()


# Some hexes of a mesh, as a mesh with what belongs to them.


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
