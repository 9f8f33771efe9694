"""Wedges, pyramids and tetrahedra beside hexes: rows, faces and corners of each kind, materials, and what holds nodes."""

import pickle

import numpy as np
import pytest

import hexmend as hx
from hexmend.mesh.solid_cells import (
    SOLID_KINDS,
    TETRAHEDRON,
    WEDGE,
    cell_faces,
    corner_tetrahedra,
    count_cells,
    edges_of,
    has_corner,
    has_node,
    kinds_of,
    padded,
)
from tests.core.grids import grid, scrambled
from tests.core.solid_lattices import HEXES, honeycomb, mixed, prisms, single

every_kind = pytest.mark.parametrize("kind", SOLID_KINDS, ids=lambda kind: kind.name)
others = pytest.mark.parametrize("kind", SOLID_KINDS[1:], ids=lambda kind: kind.name)


@every_kind
def test_faces_of_a_cell_close_it_and_are_directed_outwards(kind):
    mesh = single(kind)
    faces = cell_faces(mesh.elements)[0]
    faces = faces[faces[:, 0] >= 0]
    a, b, c, d = (mesh.points[faces[:, k]] for k in range(4))
    areas = np.cross(c - a, d - b) / 2
    np.testing.assert_allclose(areas.sum(axis=0), 0, atol=1e-14)
    outward = a + b + c + d - 4 * mesh.points.mean(axis=0)
    assert (np.einsum("ij,ij->i", areas, outward) > 0).all()


@every_kind
def test_corners_of_the_ideal_cell_have_its_edges(kind):
    mesh = single(kind)
    x = mesh.points[corner_tetrahedra(mesh.elements)[has_corner(mesh.elements)]]
    edges = np.moveaxis(x[:, 1:] - x[:, :1], 1, 2)
    gram = edges.swapaxes(1, 2) @ edges  # which a rotation does not change
    np.testing.assert_allclose(gram, np.broadcast_to(kind.ideal.T @ kind.ideal, gram.shape), atol=1e-14)
    assert (np.linalg.det(edges) > 0).all()


@every_kind
def test_edges_join_the_sides_of_faces(kind):
    mesh = single(kind)
    faces = cell_faces(mesh.elements)[0]
    sides = {
        frozenset(side)
        for face in faces[faces[:, 0] >= 0].tolist()
        for side in zip(face, face[1:] + face[:1], strict=True)
    }
    assert {frozenset(edge) for edge in edges_of(mesh.elements).tolist()} == {side for side in sides if len(side) == 2}


def test_kinds_follow_from_the_repeated_nodes():
    rows = np.array([
        [0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2, 3, 4, 5, 5, 5], [0, 1, 2, 3, 4, 4, 4, 4], [0, 1, 2, 3, 3, 3, 3, 3],
        [0, 1, 2, 2, 2, 2, 2, 2], [0, 1, 2, 3, 4, 5, 6, 6], [0, 1, 2, 2, 4, 5, 6, 6],
    ])  # fmt: skip
    assert kinds_of(rows).tolist() == [0, 1, 2, 3, 0, 0, 0]
    assert has_node(rows)[:4].sum(axis=1).tolist() == [8, 6, 5, 4]
    assert count_cells(rows) == "4 hexes, 1 wedge, 1 pyramid and 1 tetrahedron"


def test_elements_are_the_hexes_themselves_in_a_mesh_of_hexes():
    mesh = grid(2).replace(cells=(hx.Cells("quad", [[0, 1, 4, 3]]),))
    assert mesh.elements is mesh.hexes is mesh.topology.hexes


def test_elements_are_hexes_then_the_other_cells_block_after_block():
    mesh = mixed(3)
    assert [mesh.n_hexes, mesh.n_elements] == [12, 12 + 18 + 30 + 12]
    np.testing.assert_array_equal(mesh.elements[: mesh.n_hexes], mesh.hexes)
    np.testing.assert_array_equal(mesh.elements[12:30], padded(WEDGE, mesh.cells[0].nodes))
    assert mesh.topology.used.all()
    again = pickle.loads(pickle.dumps((mesh, mesh.with_points(mesh.points + 1))))
    assert again[0].hexes is again[1].hexes is again[0].topology.hexes
    np.testing.assert_array_equal(again[0].elements, mesh.elements)


@others
def test_a_block_that_is_inside_out_is_turned_in_the_elements_alone(kind):
    mesh = single(kind)
    (cells,) = mesh.cells
    turned = hx.Cells(cells.kind, cells.nodes[:, kind.turned])
    other = hx.Mesh(mesh.points, HEXES, cells=(turned,))
    np.testing.assert_array_equal(other.elements, mesh.elements)
    np.testing.assert_array_equal(other.cells[0].nodes, turned.nodes)


def test_other_solid_cells_make_another_mesh_and_other_data_do_not():
    mesh = mixed(2)
    with_data = mesh.replace(cells=tuple(hx.Cells(c.kind, c.nodes, {"a": np.ones(len(c.nodes))}) for c in mesh.cells))
    assert with_data.topology is mesh.topology
    assert mesh.replace(cells=mesh.cells[:1]).n_elements == mesh.n_hexes + len(mesh.cells[0].nodes)


def test_a_mesh_needs_one_solid_cell():
    with pytest.raises(hx.MeshError, match="at least one hex, or cells that are solid"):
        hx.Mesh(np.eye(3), HEXES, cells=(hx.Cells("triangle", [[0, 1, 2]]),))


def test_mid_nodes_of_the_second_order_follow_the_middles_of_their_edges():
    mesh = single(TETRAHEDRON)
    ends = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])
    points = np.concatenate([mesh.points, mesh.points[ends].mean(axis=1) + 0.01])
    mesh = hx.Mesh(points, HEXES, cells=(hx.Cells("tetra10", np.arange(10)[None]),))
    assert mesh.topology.used.tolist() == [True] * 4 + [False] * 6
    moved = np.zeros_like(points)
    moved[:4] = np.random.default_rng(0).normal(size=(4, 3))
    after = mesh.with_points(points + moved).points - points
    np.testing.assert_allclose(after[4:], moved[ends].mean(axis=1), atol=1e-15)
    assert mesh.replace(pinned=np.arange(10) == 4).immovable.tolist() == [True, True, False, False, True] + [False] * 5


def test_blocks_belong_to_the_materials_of_their_data_and_else_to_their_own():
    mesh = mixed(2)
    counts = [len(cells.nodes) for cells in mesh.cells]
    assert mesh.materials is None
    of_hexes = np.arange(mesh.n_hexes) % 2
    data = [{"material": np.full(counts[0], 1)}, {"material": np.full(counts[1], 7)}, {}]
    cells = tuple(hx.Cells(c.kind, c.nodes, own) for c, own in zip(mesh.cells, data, strict=True))
    found = mesh.replace(hex_data={"material": of_hexes}, cells=cells).materials
    assert found.names == ("0", "1", "7", "tetra")
    assert found.of_hex.tolist() == [*of_hexes, *np.repeat([1, 2, 3], counts)]


def test_sets_of_all_kinds_divide_a_mesh_into_materials():
    mesh = mixed(2)
    names = ["steel", "steel", "glue"]
    cells = tuple(
        hx.Cells(c.kind, c.nodes, sets={name: np.arange(len(c.nodes))})
        for c, name in zip(mesh.cells, names, strict=True)
    )
    mesh = mesh.replace(hex_sets={"steel": np.arange(mesh.n_hexes)}, cells=cells)
    assert mesh.materials.names == ("steel", "glue")
    assert np.bincount(mesh.materials.of_hex).tolist() == [mesh.n_elements - len(cells[2].nodes), len(cells[2].nodes)]
    np.testing.assert_array_equal(mesh.region("glue"), mesh.n_elements - len(cells[2].nodes) + np.arange(8 // 2))


@pytest.mark.parametrize("make", [prisms, honeycomb, mixed])
def test_the_boundary_encloses_the_volume_of_the_cells(make):
    mesh = make(4)
    assert mesh.topology.n_nonmanifold_faces == 0
    a, b, c, d = (mesh.points[mesh.topology.boundary_faces[:, k]] for k in range(4))
    flux = np.einsum("ij,ij->", (a + b + c + d) / 4, np.cross(c - a, d - b) / 2) / 3
    counts = {cells.kind: len(cells.nodes) for cells in mesh.cells}
    volumes = {prisms: 4**3 * np.sqrt(3) / 2, mixed: 4**3}
    volumes[honeycomb] = (2 * counts.get("pyramid", 0) + counts.get("tetra", 0)) / 3
    assert flux == pytest.approx(volumes[make])
    np.testing.assert_array_equal(mesh.free, ~np.isin(np.arange(mesh.n_nodes), mesh.topology.boundary_faces))


def test_a_summary_counts_inverted_cells_by_kind():
    mesh = mixed(3)
    apex = int(mesh.cells[1].nodes[0, -1])
    points = mesh.points.copy()
    points[apex, 2] += 0.7  # above the top
    cells = mesh.with_points(points).quality().cells
    assert {kind: one["inverted"] for kind, one in cells.items()} == {
        "hexahedron": 0, "wedge": 0, "pyramid": 0, "tetrahedron": 2,
    }  # fmt: skip


@pytest.mark.parametrize("convert", ["pyvista", "meshio"])
def test_all_kinds_go_to_other_libraries_and_back(convert):
    pytest.importorskip(convert)
    mesh = scrambled(mixed(3), 0.1)
    back = getattr(hx, f"from_{convert}")(getattr(hx, f"to_{convert}")(mesh))
    for kind, figures in mesh.quality().cells.items():
        assert back.quality().cells[kind] == pytest.approx(figures)
    assert sorted(c.kind for c in back.cells) == sorted(c.kind for c in mesh.cells)


def test_hexes_that_meet_tetrahedra_in_two_triangles_have_no_boundary_there():
    cubes = grid(2, 1, 1)
    one, other = cubes.hexes
    # The second cube in five tetrahedra: each of its faces is divided along a diagonal.
    tetrahedra = other[[[0, 1, 2, 5], [0, 2, 3, 7], [0, 5, 7, 4], [2, 7, 5, 6], [0, 2, 7, 5]]]
    mesh = hx.Mesh(cubes.points, one[None], cells=(hx.Cells("tetra", tetrahedra),))
    assert not mesh.quality().inverted
    faces = mesh.topology.boundary_faces
    triangle = faces[:, 2] == faces[:, 3]
    assert [int(triangle.sum()), int((~triangle).sum())] == [10, 5]
    assert not (mesh.points[faces][:, :, 0] == 1).all(axis=1).any()


def test_pyramids_beside_hexes_of_the_second_order_are_measured_and_moved():
    cube = grid(1)
    points = np.concatenate([cube.points, [[0.5, 0.5, 1.7]], [[0.5, 0, 0]]])
    mids = np.full((1, 19), -1)
    mids[0, 0] = 9
    top = cube.hexes[0, [4, 5, 6, 7]]
    mesh = hx.Mesh(points, cube.hexes, mid_nodes=mids, cells=(hx.Cells("pyramid", [[*top, 8]]),))
    assert mesh.quality().invalid == 0
    assert mesh.quality("mid-node-offset").tolist() == [0, 0]
    assert mesh.quality("jacobian-ratio").shape == (2,)
