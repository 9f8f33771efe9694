"""Classification of boundary nodes: on solids with known corners, curves and patches, and invariants."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, Mesh, read, write
from hexmend.boundary import NodeClass, boundary_of, classify
from hexmend.gallery import GALLERY, make
from tests.core.boundary.solids import ball, wavy
from tests.core.grids import grid

REAL = ("bunny.vtk", "CAD4.vtk", "cap_in.mesh", "block_in.mesh", "bone.vtk")


def counts(boundary):
    return [boundary.count(kind) for kind in (NodeClass.CORNER, NodeClass.CURVE, NodeClass.PATCH)]


def check(mesh, boundary):
    """Check the invariants of a classification."""
    kind, part = boundary.node_class, boundary.component
    assert kind.dtype == np.uint8
    assert part.dtype == np.int32
    between = np.zeros(mesh.n_nodes, bool) if mesh.interfaces is None else mesh.interfaces.interface_nodes
    np.testing.assert_array_equal(kind != NodeClass.INSIDE, mesh.topology.boundary | between)
    np.testing.assert_array_equal(part >= 0, kind >= NodeClass.CURVE)
    ends = boundary.segments.ravel()
    valence = np.bincount(ends, minlength=mesh.n_nodes)
    assert (valence[kind == NodeClass.CURVE] == 2).all()
    assert not valence[kind == NodeClass.PATCH].any()
    on_curve = kind[ends] == NodeClass.CURVE
    np.testing.assert_array_equal(part[ends][on_curve], np.repeat(boundary.curve_of_segment, 2)[on_curve])
    on_patch = kind[boundary.faces] == NodeClass.PATCH
    patches = np.broadcast_to(boundary.patch_of_face[:, None], on_patch.shape)
    np.testing.assert_array_equal(part[boundary.faces][on_patch], patches[on_patch])
    assert set(boundary.patch_of_face) == set(range(boundary.n_patches))
    assert set(boundary.curve_of_segment) == set(range(boundary.n_curves))


@pytest.mark.parametrize(("nx", "ny", "nz"), [(1, 1, 1), (1, 1, 5), (6, 5, 1), (2, 2, 2), (5, 3, 2)])
def test_a_box_has_eight_corners_twelve_curves_and_six_patches(nx, ny, nz):
    mesh = grid(nx, ny, nz)
    boundary = boundary_of(mesh)
    check(mesh, boundary)
    x, y, z = nx - 1, ny - 1, nz - 1
    assert counts(boundary) == [8, 4 * (x + y + z), 2 * (x * y + y * z + z * x)]
    assert (boundary.n_curves, boundary.n_patches) == (12, 6)
    assert len(boundary.segments) == 4 * (nx + ny + nz)


def test_a_ball_is_one_patch():
    boundary = boundary_of(ball(8))
    assert counts(boundary)[:2] == [0, 0]
    assert (boundary.n_curves, boundary.n_patches) == (0, 1)


@pytest.mark.parametrize("name", list(GALLERY))
def test_gallery_meshes(name):
    mesh = make(name, size=600)
    check(mesh, boundary_of(mesh))


@pytest.mark.parametrize("name", REAL)
def test_real_meshes(name, real_mesh):
    mesh = read(real_mesh(name))
    for whisker in (0, 5):
        check(mesh, boundary_of(mesh, whisker=whisker))


@given(st.floats(0, 0.6), st.integers(0, 99), st.sampled_from([0, 5]))
def test_rough_boxes(height, seed, whisker):
    mesh = wavy(grid(4, 3, 3), height, seed)
    check(mesh, boundary_of(mesh, whisker=whisker))


@given(st.randoms(), st.floats(1e-6, 1e6))
def test_kinds_depend_neither_on_the_numbering_nor_on_place_and_unit(random, unit):
    mesh = make("five-side", size=100)
    order = list(range(mesh.n_nodes))
    random.shuffle(order)
    turn, _ = np.linalg.qr(np.random.default_rng(order[0]).normal(size=(3, 3)))
    points = np.empty_like(mesh.points)
    points[order] = unit * (mesh.points @ (turn * np.sign(np.linalg.det(turn))) + 1)
    one, other = boundary_of(mesh), boundary_of(Mesh(points, np.array(order)[mesh.hexes]))
    np.testing.assert_array_equal(one.node_class, other.node_class[order])
    assert (one.n_curves, one.n_patches) == (other.n_curves, other.n_patches)


def touching(shared):
    """Make two cubes that share one or two nodes."""
    cube = grid(1)
    points = np.concatenate([cube.points, cube.points + ([1, 1, 1] if shared == 1 else [1, 1, 0])])
    places, number = np.unique(points, axis=0, return_inverse=True)
    return Mesh(places, number.ravel()[np.concatenate([cube.hexes, cube.hexes + 8])])


def test_cubes_that_touch_in_an_edge_have_a_curve_there_however_large_the_angle():
    mesh = touching(2)
    boundary = classify(mesh.points, mesh.topology.boundary_faces, feature_angle=100)
    edge = np.flatnonzero((mesh.points[:, :2] == 1).all(axis=1))
    assert boundary.segments.tolist() == [sorted(edge.tolist())]
    assert (boundary.node_class[edge] == NodeClass.CORNER).all()


def dented(length):
    """Make a plate of 12 x 10 x 2 with a groove of some edges, of 53 degrees, in its upper side."""
    mesh = grid(12, 10, 2)
    points = mesh.points.copy()
    x, y, z = points.T
    groove = (z == 2) & (y == 5) & (x >= 2) & (x <= 2 + length)
    points[groove, 2] -= 0.5
    return mesh.with_points(points), groove


def test_a_short_groove_in_a_patch_is_a_roughness():
    (flat, _), (short, groove) = dented(-1), dented(3)
    np.testing.assert_array_equal(boundary_of(short, 40).node_class, boundary_of(flat, 40).node_class)
    assert (boundary_of(short, 40, whisker=0).node_class[groove] < NodeClass.PATCH).all()


def test_a_long_groove_ends_in_corners():
    mesh, groove = dented(9)
    boundary = boundary_of(mesh, 40)
    check(mesh, boundary)
    assert boundary.node_class[groove].tolist() == [NodeClass.CORNER, *8 * [NodeClass.CURVE], NodeClass.CORNER]


def test_given_edges_and_corners_are_taken_and_pinned_nodes_are_corners():
    mesh = grid(4)
    side = (mesh.points[:, 2] == 4) & (mesh.points[:, 1] == 2)
    line = np.flatnonzero(side)
    edges = np.column_stack([line[:-1], line[1:]])
    given = boundary_of(mesh, sharp=edges[:, ::-1])
    assert (given.node_class[line] == [1, 2, 2, 2, 1]).all()
    assert given.n_patches == 7
    assert boundary_of(mesh, sharp=edges, corners=line[[2]]).n_curves == 12 + 2 + 2
    pinned = boundary_of(mesh.replace(pinned=side))
    assert (pinned.node_class[line] == NodeClass.CORNER).all()
    assert pinned.n_patches == 6


@pytest.mark.parametrize("suffix", [".mesh", ".meshb"])
def test_ridges_and_corners_of_a_medit_file_are_features(tmp_path, suffix):
    mesh = grid(4)
    line = np.flatnonzero((mesh.points[:, 2] == 4) & (mesh.points[:, 1] == 2))
    edges = np.column_stack([line[:-1], line[1:]]).astype(np.int32)
    ridges = Cells("line", edges, {"medit:ridge": np.array([1, 1, 0, 0], np.uint8)})
    write(tmp_path / f"a{suffix}", mesh.replace(cells=(ridges,), node_sets={"corners": line[[3]]}))
    boundary = boundary_of(read(tmp_path / f"a{suffix}"))
    assert boundary.node_class[line].tolist() == [
        NodeClass.CORNER,
        NodeClass.CURVE,
        NodeClass.CORNER,
        NodeClass.CORNER,
        NodeClass.CURVE,
    ]


def test_where_references_of_a_file_s_sides_change_is_a_feature():
    mesh = grid(4)
    faces = mesh.topology.boundary_faces
    upper = (mesh.points[faces].mean(axis=1)[:, 2] > 2).astype(int)
    boundary = boundary_of(mesh.replace(cells=(Cells("quad", faces, {"medit:ref": upper}),)))
    assert boundary.n_patches == 6 + 4
    ring = mesh.topology.boundary & (mesh.points[:, 2] == 2)
    assert (boundary.node_class[ring] < NodeClass.PATCH).all()


def test_triangles_have_kinds_too():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    boundary = classify(points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.int32))
    assert (counts(boundary), boundary.n_curves, boundary.n_patches) == ([4, 0, 0], 6, 4)


def test_an_open_surface_ends_in_a_curve():
    quads = np.array([[i + 6 * j, i + 1 + 6 * j, i + 7 + 6 * j, i + 6 + 6 * j] for i in range(5) for j in range(5)])
    points = np.array([[i, j, 0.0] for j in range(6) for i in range(6)])
    boundary = classify(points, quads.astype(np.int32))
    assert (counts(boundary), boundary.n_curves, boundary.n_patches) == ([4, 16, 16], 4, 1)
    boundary = classify(points, quads.astype(np.int32), turn=100)
    assert (counts(boundary), boundary.n_curves) == ([0, 20, 16], 1)


def test_an_edge_is_a_feature_beyond_the_angle_and_not_at_it():
    assert boundary_of(grid(2), 90.0).n_curves == 0
    assert boundary_of(grid(2), 89.999).n_curves == 12
