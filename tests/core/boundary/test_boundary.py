"""Classification of boundary nodes: on solids with known corners, curves and patches, and invariants."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, Cells, Mesh, StoppingCriteria, read, smooth, write
from hexmend.boundary import NodeClass, SlidingBoundary, boundary_of, classify
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.corner_detection import bend_corners
from hexmend.boundary.feature_edges.features import surrounding_angles
from hexmend.boundary.sliding.curved_faces import surface_of_boundary
from hexmend.gallery import GALLERY, make
from hexmend.mesh.second_order import MID_EDGES
from tests.core.boundary.solids import ball, cylinder, slid, wavy
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


# Nodes at bends of curves that keep a hex's corner open do not slide.


def test_bends_that_alone_keep_a_corner_open_do_not_slide():
    mesh = cylinder(16, 3)
    bends = bend_corners(mesh, boundary_of(mesh))
    assert len(bends) == 8  # four on each rim: there a square's corner has been made a bend of a circle
    assert (SlidingBoundary(mesh).boundary.node_class[bends] == NodeClass.CORNER).all()
    assert not bend_corners(grid(3), boundary_of(grid(3))).size
    assert not bend_corners(ball(3), boundary_of(ball(3))).size


def test_bends_of_inverted_corners_slide():
    mesh = cylinder(16, 3)
    (bend, *_) = bend_corners(mesh, boundary_of(mesh))
    points = mesh.points.copy()
    points[bend, :2] *= 0.5  # behind the line between its neighbours
    pushed = mesh.with_points(points)
    assert bend not in bend_corners(pushed, boundary_of(pushed, turn=180.0))


@pytest.mark.parametrize("name", ["local-nr", "mend"])
def test_no_corner_is_flattened_on_a_straight_piece_of_its_curve(name):
    result = smooth(slid(cylinder(16, 3), 0.3), METHODS[name](boundary="slide"), StoppingCriteria(max_iterations=200))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.1


@pytest.mark.parametrize("which", [0, 5])
def test_only_the_bend_of_the_inverted_corner_slides(which):
    mesh = cylinder(16, 3)
    boundary = boundary_of(mesh)
    bends = bend_corners(mesh, boundary)
    points = mesh.points.copy()
    points[bends[which], :2] *= 0.5
    assert bend_corners(mesh.with_points(points), boundary).tolist() == np.delete(bends, which).tolist()


# Boundaries of second-order hexes slide on their curved faces.


def with_mid_nodes(mesh, on_sphere):
    """Give all edges a mid-node, those of the boundary on the unit sphere if asked for."""
    edges, place = np.unique(np.sort(mesh.hexes[:, MID_EDGES].reshape(-1, 2)), axis=0, return_inverse=True)
    mids = np.full((mesh.n_hexes, 19), -1)
    mids[:, :12] = mesh.n_nodes + place.reshape(-1, 12)
    middles = mesh.points[edges].mean(axis=1)
    if on_sphere:
        outer = mesh.topology.boundary[edges].all(axis=1)
        middles[outer] /= np.linalg.norm(middles[outer], axis=1, keepdims=True)
    return Mesh(np.vstack([mesh.points, middles]), mesh.hexes, mid_nodes=mids)


@pytest.mark.parametrize("method", [pytest.param("mend", marks=pytest.mark.slow), "local-sd"])
def test_corners_of_a_second_order_ball_slide_on_the_sphere_and_not_on_its_chords(method):
    """Other goals of mend let them leave it within a tolerance."""
    mesh = with_mid_nodes(ball(6), True)
    goal = {"goal": "shape"} if method == "mend" else {}
    result = smooth(mesh, method, boundary="slide", keep_last=True, **goal).mesh
    corners = mesh.topology.boundary & mesh.topology.used
    assert np.linalg.norm(result.points - mesh.points, axis=1)[corners].max() > 0.01
    np.testing.assert_allclose(np.linalg.norm(result.points[corners], axis=1), 1, atol=1e-3)


def test_points_of_curved_edges_and_faces_lie_on_their_curves_and_patches():
    mesh = with_mid_nodes(grid(2), False)
    bulge = 0.2 * mesh.points[:, :1] * (2 - mesh.points[:, :1])  # a parabola over both hexes, quadratic on each
    mesh = Mesh(mesh.points + bulge * [0, 0, 1], mesh.hexes, mid_nodes=mesh.mid_nodes)
    boundary = boundary_of(mesh)
    surface = surface_of_boundary(mesh, mesh.points, boundary)
    assert (surface.n_patches, surface.n_curves) == (boundary.n_patches, boundary.n_curves) == (6, 12)
    np.testing.assert_array_equal(surface.node_class, boundary.node_class)
    x = np.linspace(0, 2, 33)
    for y, close in (0.0, (2, 1)), (0.7, (1, 0)):  # on an edge, and within the top
        places = np.column_stack([x, np.full(33, y), 2 + 0.2 * x * (2 - x)])
        found = [surface.trees.closest(places, np.full(33, k)).points for k in range(18)]
        near = np.array([np.linalg.norm(one - places, axis=1).max() for one in found]) < 1e-3
        assert (np.count_nonzero(near[:6]), np.count_nonzero(near[6:])) == close


# Unique edges of faces, whatever their direction.


@given(st.integers(0, 2**31), st.integers(3, 12), st.integers(3, 5))
def test_neighbours_of_an_edge_are_its_first_two_faces_and_opposed_where_they_run_against_each_other(seed, n, width):
    random = np.random.default_rng(seed)
    faces = random.integers(0, n, (15, width)).astype(np.int32)  # successive nodes may be equal
    sides = {}
    for number, face in enumerate(faces.tolist()):
        for one, other in zip(face, face[1:] + face[:1], strict=True):
            if one != other:
                sides.setdefault((min(one, other), max(one, other)), []).append((number, one))
    edges = SurfaceEdges(faces, n)
    assert list(map(tuple, edges.nodes.tolist())) == sorted(sides)
    for row, edge in enumerate(sorted(sides)):
        (one, start), (other, end) = sides[edge][0], sides[edge][:2][-1]
        assert (edges.count[row], *edges.neighbours[row]) == (len(sides[edge]), one, other)
        assert edges.opposed[row] == (start != end)


def test_there_are_no_edges_without_faces_and_a_node_that_does_not_exist_is_rejected():
    edges = SurfaceEdges(np.empty((0, 3), dtype=np.int32), 4)
    assert edges.nodes.shape == edges.neighbours.shape == (0, 2)
    assert edges.count.size == edges.key.size == edges.opposed.size == 0
    assert edges.fans.tolist() == [0, 0, 0, 0]
    for node in -1, 3:
        with pytest.raises(ValueError, match="out of range"):
            SurfaceEdges(np.array([[0, 1, node]], dtype=np.int32), 3)


@pytest.mark.parametrize("around", [12, 16, 32])
def test_a_cylinder_has_two_rims_and_no_edges_along_it_however_coarse_it_is(around):
    mesh = cylinder(around, 6)
    boundary = boundary_of(mesh)
    rim = np.isin(mesh.points[:, 2], [0, 1]) & np.isclose(np.linalg.norm(mesh.points[:, :2], axis=1), 1)
    assert (boundary.n_curves, boundary.n_patches) == (2, 3)
    np.testing.assert_array_equal(boundary.node_class == NodeClass.CURVE, rim)


def test_a_coarse_ball_has_no_feature_where_a_bare_angle_finds_them():
    mesh = wavy(ball(4), 0.12, 1)
    assert counts(boundary_of(mesh, 40, whisker=0))[0] > 0
    assert counts(boundary_of(mesh)) == [0, 0, 98]


def test_a_turn_is_a_corner_where_it_is_sharper_than_those_beside_it():
    """A prism over a hexagon has 60 degrees at each node of its rims; over a square they are corners."""

    def prism(n):
        angle = 2 * np.pi * np.arange(n) / n
        ring = np.column_stack([np.cos(angle), np.sin(angle)])
        points = np.concatenate([np.column_stack([ring, np.full(n, z)]) for z in (0.0, 1.0)] + [[[0, 0, 1]]])
        at = np.arange(n)
        sides = np.column_stack([at, (at + 1) % n, (at + 1) % n + n])
        sides = np.concatenate([sides, np.column_stack([at, (at + 1) % n + n, at + n])])
        return points, np.concatenate([sides, np.column_stack([at + n, (at + 1) % n + n, np.full(n, 2 * n)])])

    for n, corners in (4, 4), (6, 0), (12, 0):
        points, faces = prism(n)
        rim = np.column_stack([np.arange(n), (np.arange(n) + 1) % n]) + n
        boundary = classify(points, faces, 170, turn="auto", sharp=rim)
        assert np.count_nonzero(boundary.node_class[n : 2 * n] == NodeClass.CORNER) == corners


@pytest.mark.parametrize("n", [4, 60])
def test_the_bend_around_an_edge_is_a_quantile_over_the_edges_at_its_nodes_and_their_neighbours(n):
    random = np.random.default_rng(n)
    edges = SurfaceEdges(random.integers(n, size=(40, 3), dtype=np.int32), n)
    angle = 120 * random.random(len(edges.nodes))
    found = surrounding_angles(edges, angle, np.arange(angle.size))
    sets = [set(pair) for pair in edges.nodes.tolist()]
    for i, pair in enumerate(sets):
        near = set().union(*(other for other in sets if other & pair))
        around = sorted(angle[k] for k, other in enumerate(sets) if k != i and other & near and angle[k] <= 75)
        assert found[i] == (around[int(0.6 * len(around))] if around else 0)


def test_marked_edges_are_features_whatever_is_around_them():
    mesh = wavy(ball(4), 0.05, 1)
    edge = mesh.topology.boundary_faces[0][:2]
    boundary = boundary_of(mesh, sharp=edge[None])
    assert (boundary.node_class[edge] == NodeClass.CORNER).all()


@pytest.mark.parametrize(
    ("name", "least", "most"),
    [("kitten_2.mesh", 0, 0), ("CAD4.vtk", 600, 620), ("mid2FemPer.vtk", 400, 430), ("fertility_1.mesh", 0, 60)],
)
def test_parts_keep_their_edges_and_smooth_bodies_have_few(real_mesh, name, least, most):
    assert least <= len(boundary_of(read(real_mesh(name))).segments) <= most
