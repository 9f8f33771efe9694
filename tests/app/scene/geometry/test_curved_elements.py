"""Curved faces and hexes of second order: polynomials, areas, normals and missing nodes."""

import numpy as np
import pytest

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.second_order import NODE_POSITIONS
from hexmend.mesh.second_order.curved_geometry import QUAD_POSITIONS, evaluate_quads, grid, hex_nodes, quad_nodes
from hexmend.mesh.second_order.mid_node_lookup import face_mid_nodes
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.camera import CameraPose
from hexmend_app.scene.camera.vtk_pose import apply_pose
from hexmend_app.scene.geometry.coloured_polygons import hexes_of
from hexmend_app.scene.geometry.curved_elements import edge_mid_nodes, evaluate_hexes, quad_normals
from hexmend_app.scene.geometry.curved_faces import CurvedFaces
from hexmend_app.scene.geometry.edge_flags import edge_flags, normals_of
from hexmend_app.scene.geometry.skin import Skin
from hexmend_app.scene.layers.invalid_outline import outlines
from tests.app.scene.showing import frame_of
from tests.core.curved_shell import curved_shell


def polynomial(at, powers, seed=0):
    """Return a random vector polynomial with these powers of u, v (and w) at points, (..., 3)."""
    coefficients = np.random.default_rng(seed).normal(size=(len(powers), 3))
    return sum(c * np.prod(at ** np.array(p), axis=-1)[..., None] for c, p in zip(coefficients, powers, strict=True))


Q2 = [(i, j) for i in range(3) for j in range(3)]
SERENDIPITY = [p for p in Q2 if p != (2, 2)]


@pytest.mark.parametrize(("width", "powers"), [(8, SERENDIPITY), (9, Q2)])
def test_quads_reproduce_their_polynomials_and_the_normals_of_these(width, powers):
    nodes = polynomial(QUAD_POSITIONS[:width], powers)[None] + [0, 0, 0]
    at = np.random.default_rng(1).random((50, 2))
    np.testing.assert_allclose(evaluate_quads(nodes, at)[0], polynomial(at, powers), atol=1e-13)
    step = 1e-6
    du, dv = (
        (polynomial(at + step * axis, powers) - polynomial(at - step * axis, powers)) / (2 * step) for axis in np.eye(2)
    )
    normal = np.cross(du, dv)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    np.testing.assert_allclose(quad_normals(nodes, at)[0], normal, atol=1e-6)


def test_hexes_reproduce_triquadratic_polynomials():
    powers = [(i, j, k) for i in range(3) for j in range(3) for k in range(3)]
    at = np.random.default_rng(2).random((40, 3))
    nodes = polynomial(NODE_POSITIONS, powers)[None]
    np.testing.assert_allclose(evaluate_hexes(nodes, at)[0], polynomial(at, powers), atol=1e-12)


@pytest.mark.parametrize("nodes", [20, 27])
def test_area_and_normals_of_a_cylinder_are_those_of_the_circle(nodes):
    mesh = curved_shell(nodes, around=8)
    outer = outer_faces(mesh)
    at = grid(64)
    points, normals = evaluate_quads(outer, at), quad_normals(outer, at)
    radii = np.linalg.norm(points[..., :2], axis=2)
    assert np.abs(radii - 2).max() < 2e-4  # third order: a chord of this angle is 2e-2 from the circle
    radial = points.copy()
    radial[..., 2] = 0
    radial /= np.linalg.norm(radial, axis=2)[..., None]
    assert (normals * radial).sum(axis=2).min() > np.cos(np.radians(0.2))
    assert area(points.reshape(len(outer), 65, 65, 3)) == pytest.approx(2 * np.pi / 2 * 1.0, rel=1e-4)


def area(points):
    """Return the area of grids of points, (k, n, n, 3), by triangles."""
    a, b, c, d = points[:, :-1, :-1], points[:, :-1, 1:], points[:, 1:, 1:], points[:, 1:, :-1]
    return sum(np.linalg.norm(np.cross(q - p, r - p), axis=-1).sum() / 2 for p, q, r in ((a, b, c), (a, c, d)))


def outer_faces(mesh):
    """Return the positions of all nodes of the faces x+ (the outer ones) of a shell, (k, 9, 3)."""
    owners = np.flatnonzero(np.isclose(np.linalg.norm(mesh.points[mesh.hexes[:, 1], :2], axis=1), 2))
    corners = mesh.hexes[owners][:, FACES[1]]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, owners, corners)
    return quad_nodes(mesh.points, corners, mids)


def test_mid_nodes_of_rotated_and_reversed_faces_are_those_of_their_edges():
    mesh = curved_shell(27)
    corners = mesh.hexes[:, FACES[4]]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), corners)
    turned = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), np.roll(corners, 1, axis=1))
    np.testing.assert_array_equal(turned[:, :4], np.roll(mids[:, :4], 1, axis=1))
    np.testing.assert_array_equal(turned[:, 4], mesh.mid_nodes[:, 16])
    found = edge_mid_nodes(mesh.hexes, mesh.mid_nodes, corners[:, [1, 0]])
    np.testing.assert_array_equal(found, mids[:, 0])
    assert edge_mid_nodes(mesh.hexes, mesh.mid_nodes, corners[:1, [0, 2]]) == [-1]


def test_missing_mid_nodes_make_straight_edges_and_serendipity_faces():
    mesh = curved_shell(20)
    nodes = hex_nodes(mesh.points, mesh.hexes, mesh.mid_nodes)
    face = FACES[1]
    corners = mesh.hexes[:, face]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), corners)
    eight = evaluate_quads(quad_nodes(mesh.points, corners, mids)[:, :8], np.array([[0.3, 0.8]]))
    whole = evaluate_hexes(nodes, np.array([[1.0, 0.3, 0.8]]))
    np.testing.assert_allclose(whole, eight, atol=1e-14)
    none = np.full_like(mesh.mid_nodes, -1)
    straight = hex_nodes(mesh.points, mesh.hexes, none)
    np.testing.assert_allclose(straight[:, 26], mesh.points[mesh.hexes].mean(axis=1), atol=1e-14)
    np.testing.assert_allclose(straight[:, 8], mesh.points[mesh.hexes[:, :2]].mean(axis=1), atol=1e-15)


def test_normals_at_a_collapsed_edge_are_those_of_the_triangle():
    quad = QUAD_POSITIONS @ np.array([[1.0, 0, 0], [0, 1, 0]])
    quad[[2, 3, 6]] = [0.5, 1, 0]
    quad[[5, 7]] = [[0.75, 0.5, 0], [0.25, 0.5, 0]]
    normals = quad_normals(quad[None, :8], grid(4))
    np.testing.assert_allclose(normals, np.broadcast_to([0, 0, 1.0], normals.shape), atol=1e-12)


# Curved faces in a view: round outlines, edges of hexes alone, picking, moving, coarse frames.


SIZE, SCALE = 400, 1.2  # pixels of the picture, and half of its height in the unit of the mesh
CURVED, FLAT = Look(), Look(structure=Structure().without("curved"))


@pytest.fixture
def seen(off_screen):
    """A view along -z of a quarter of a ring between radii 1 and 2, and a function that returns its pixels."""
    viewport = off_screen(SIZE, SIZE, axes=False)

    def draw(mesh, look=CURVED):
        viewport.draw(frame_of(mesh, look))
        apply_pose(viewport.camera, CameraPose((1, 1, 10), (1, 1, 0), (0, 1, 0), True, SCALE, "z"))
        viewport.layers[0].ResetCameraClippingRange()
        viewport.still()
        return viewport.pixels()

    return viewport, draw


def pixel(x, y):
    """Return the position in pixels from the lower left corner of a point of the mesh."""
    return SIZE / 2 * (1 + (x - 1) / SCALE), SIZE / 2 * (1 + (y - 1) / SCALE)


def outer_radii(picture):
    """Return the distances from the axis to the outermost drawn pixels in directions from 3° to 87°."""
    drawn = np.abs(picture - picture[0, -1]).sum(axis=2) > 60
    radii = []
    for angle in np.radians(np.linspace(3, 87, 60)):
        r = np.arange(1.5, 2.3, 0.002)
        x, y = pixel(r * np.cos(angle), r * np.sin(angle))
        inside = (x < SIZE) & (y < SIZE)
        hit = drawn[SIZE - 1 - y[inside].astype(int), x[inside].astype(int)]
        radii.append(r[inside][hit].max())
    return np.array(radii)


@pytest.mark.parametrize("nodes", [20, 27])
def test_the_outline_of_a_cylinder_is_round(seen, nodes):
    _, draw = seen
    mesh = curved_shell(nodes, around=2)
    of_pixel = 2 * SCALE / SIZE
    assert np.abs(outer_radii(draw(mesh)) - 2).max() < 1.5 * of_pixel
    flat = outer_radii(draw(mesh, FLAT))
    sagitta = 2 * (1 - np.cos(np.pi / 8))
    assert 2 - flat.min() == pytest.approx(sagitta, abs=2 * of_pixel)
    assert sagitta > 20 * of_pixel  # so that the first comparison can fail


def test_a_click_on_any_part_of_a_face_finds_its_hex(seen):
    viewport, draw = seen
    draw(curved_shell(27, through=2, around=3))
    rng = np.random.default_rng(4)
    for radius, angle in zip(rng.uniform(1.03, 1.97, 40), rng.uniform(0.01, 0.99, 40), strict=True):
        at = radius * np.cos(angle * np.pi / 2), radius * np.sin(angle * np.pi / 2)
        if min(abs(radius - 1.5), abs(3 * angle - 1), abs(3 * angle - 2)) > 0.05:
            assert viewport.pick(*pixel(*at)).hex == 3 * int(radius > 1.5) + int(3 * angle)
    assert viewport.pick(*pixel(1.99 * np.cos(0.26), 1.99 * np.sin(0.26))).hex == 3  # outside of the flat faces


def faces(mesh, divisions=4, **options):
    visible = Skin(mesh).shrunk(**options) if options else Skin(mesh).visible()
    curved = CurvedFaces(mesh, visible, divisions)
    return curved, curved.quads(mesh.points, np.zeros((len(visible.quads), 3), np.uint8)), visible


def test_quads_lie_on_the_cylinder_with_its_normals_and_belong_to_its_hexes():
    mesh = curved_shell(20, around=6, along=2)
    _, poly, visible = faces(mesh, 4)
    assert poly.n_cells == 16 * len(visible.quads)
    np.testing.assert_array_equal(hexes_of(poly), visible.hexes.repeat(16))
    points, normals = np.asarray(poly.points), normals_of(poly)
    radius = np.linalg.norm(points[:, :2], axis=1)
    outside = (np.abs(radius - 2) < 1e-3) & (np.abs(normals[:, 2]) < 0.5)
    radial = points[:, :2] / radius[:, None]
    facing = (normals[:, :2] * radial).sum(axis=1)
    ends = np.abs(facing) < 0.01  # corners of the faces across the wall
    assert (facing[outside & ~ends] > np.cos(np.radians(0.5))).all()
    assert np.count_nonzero(outside & ~ends) == 12 * 64
    exact = 3 * np.pi / 4 * 2 + (1 + 2) * np.pi / 2 + 2  # both ends, both walls, both sides
    assert poly.area == pytest.approx(exact, rel=2e-3)


def test_edges_of_hexes_are_drawn_and_those_of_the_parts_are_not():
    mesh = curved_shell(27, around=3)
    _, poly, visible = faces(mesh, 5)
    assert np.count_nonzero(edge_flags(poly)) == 4 * 5 * len(visible.quads)
    ends, _ = outlines(poly, np.ones(poly.n_cells, bool))
    lengths = np.linalg.norm(poly.points[ends[:, 1]] - poly.points[ends[:, 0]], axis=1)
    arcs, rays, posts = 2 * (1 + 2) * np.pi / 2, 2 * 4 * 1, 2 * 4 * 1
    assert lengths.sum() == pytest.approx(arcs + rays + posts, rel=2e-3)


def test_moved_faces_are_those_of_the_moved_mesh():
    mesh = curved_shell(20)
    curved, poly, visible = faces(mesh, 3)
    points = mesh.points + np.random.default_rng(0).normal(scale=0.05, size=mesh.points.shape)
    moved = mesh.with_points(points)
    colours = np.random.default_rng(1).integers(0, 255, (len(visible.quads), 3)).astype(np.uint8)
    curved.move(poly, moved.points, colours)
    expected = CurvedFaces(moved, visible, 3).quads(moved.points, colours)
    np.testing.assert_array_equal(poly.points, expected.points)
    np.testing.assert_array_equal(normals_of(poly), normals_of(expected))
    np.testing.assert_array_equal(poly.cell_data["colours"], expected.cell_data["colours"])


def test_a_switch_draws_the_hexes_by_their_corners(seen):
    _, draw = seen
    mesh = curved_shell(27)
    curved = draw(mesh)
    flat = draw(mesh, FLAT)
    assert (curved != flat).any()
    linear = draw(mesh.replace(mid_nodes=None))
    np.testing.assert_array_equal(linear, flat)
    np.testing.assert_array_equal(draw(mesh), curved)
