"""Smooth cuts, compared with areas from formulas."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend_app.picture import Box, Cut, CutStyle, Depth, DepthUnit, Plane, Sphere
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.cutting.cut import remaining_skin, sections
from hexmend_app.scene.cutting.filters import Filters
from hexmend_app.scene.geometry.coloured_polygons import hexes_of, quads
from hexmend_app.scene.geometry.curved_faces import CurvedFaces
from hexmend_app.scene.geometry.edge_flags import edge_flags, normals_of
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.polygons import Polygons
from hexmend_app.scene.geometry.skin import Skin
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid, placed
from tests.core.solid_lattices import honeycomb, mixed, prisms

MESH = grid(4, 3, 2)
COLOURS = np.arange(24 * 3, dtype=np.uint8).reshape(24, 3)


@pytest.mark.parametrize(
    ("normal", "origin", "area", "cells"),
    [((1, 0, 0), (1.5, 0, 0), 6, 6), ((0, 1, 0), (0, 0.25, 0), 8, 8), ((0, 0, -1), (0, 0, 1.5), 12, 12), ((1, 1, 0), (1, 0.5, 0), 3 * 2**0.5, None)],
)  # fmt: skip
def test_the_section_has_the_area_of_the_cut(normal, origin, area, cells):
    got = cut.sections(MESH, None, Cut.at(normal, origin), COLOURS)
    assert got.area == pytest.approx(area, rel=1e-6)
    assert cells is None or got.n_cells == cells


@pytest.mark.parametrize("x", [1, 2, 3, 4])
def test_a_plane_through_nodes_shows_the_remaining_hexes(x):
    got = cut.sections(MESH, None, Cut.at((1, 0, 0), (x, 0, 0)), COLOURS)
    assert got.area == pytest.approx(6)
    hexes = got.cell_data["colours"][:, 0] // 3
    assert sorted(hexes) == [x - 1 + 4 * k for k in range(6)]


@given(st.integers(0, 2**32 - 1), st.integers(1, 3))
def test_the_section_by_a_plane_through_nodes_is_complete_despite_rounding(seed, x):
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)  # a rotation, not a mirror image
    shift = np.random.default_rng(seed).normal(size=3) * 10
    plane = Cut.at(turn[:, 0], turn[:, 0] * x + shift)
    got = cut.sections(MESH.with_points(MESH.points @ turn.T + shift), None, plane, COLOURS)
    assert got.area == pytest.approx(6)


def test_each_polygon_has_the_colour_of_its_hex():
    got = cut.sections(MESH, None, Cut.at((1, 0, 0), (1.5, 0, 0)), COLOURS)
    centres = got.cell_centers().points
    for centre, colour in zip(centres, got.cell_data["colours"], strict=True):
        h = int(centre[0]) + 4 * int(centre[1]) + 12 * int(centre[2])
        assert colour.tolist() == COLOURS[h].tolist()


def test_hidden_hexes_are_not_cut():
    keep = np.zeros(24, dtype=bool)
    keep[1] = True
    got = cut.sections(MESH, keep, Cut.at((1, 0, 0), (1.5, 0, 0)), COLOURS)
    assert got.area == pytest.approx(1)


CORNER = (Plane((1, 0, 0), point=(1.5, 0, 0)), Plane((0, 1, 0), point=(0, 1.25, 0)))
BOX = ((0.5, 0.5, 0.5), (2.5, 1.5, 1.25))


AREAS = [
    (Cut(CORNER, style=CutStyle.SMOOTH), 1.25 * 2 + 1.5 * 2 + 2 * 1.5 * 1.25, (1.25 + 1.5) * 2),
    (Cut(CORNER, style=CutStyle.SMOOTH, notch=True), 52 - 2.5 * 2 - 1.75 * 2 - 2 * 2.5 * 1.75, (2.5 + 1.75) * 2),
    (Cut(box=Box(*BOX), style=CutStyle.SMOOTH), 0, 2 * (2 * 1 + 2 * 0.75 + 1 * 0.75)),
    (Cut(box=Box(*BOX), style=CutStyle.SMOOTH, notch=True), 52, 2 * (2 * 1 + 2 * 0.75 + 1 * 0.75)),
    (Cut(box=Box((2, 0, 0), (4, 3, 2)), style=CutStyle.SMOOTH), 2 * 2 * 3 + 2 * 2 * 2 + 3 * 2, 3 * 2),
    (Cut(box=Box((2, 0, 0), (4, 3, 2)), style=CutStyle.SMOOTH, notch=True), 2 * 2 * 3 + 2 * 2 * 2 + 3 * 2, 3 * 2),
]


@pytest.mark.parametrize(("clip", "skin_area", "section_area"), AREAS)
def test_several_planes_leave_the_expected_areas(clip, skin_area, section_area):
    faces = Skin(MESH).visible()
    skin = quads(MESH.points[faces.nodes], faces.quads, COLOURS[faces.hexes], faces.hexes)
    assert cut.remaining_skin(skin, clip).area == pytest.approx(skin_area)
    assert cut.sections(MESH, None, clip, COLOURS).area == pytest.approx(section_area)


@given(
    st.lists(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1), min_size=1, max_size=4),
    st.booleans(),
)
def test_a_cut_by_whole_hexes_depends_on_their_centres(normals, notch):
    clip = Cut(tuple(Plane(normal, point=(2, 1.5, 1)) for normal in normals), notch=notch)
    kept = Filters(MESH).kept(Frame(MESH, measure(MESH.points, MESH.hexes), look=Look(cut=clip)))
    beyond = np.array([plane.signed_distance(MESH.points[MESH.hexes].mean(axis=1)) for plane in clip.planes])
    clear = (np.abs(beyond) > 1e-12).all(axis=0)
    hidden = (beyond > 0).all(axis=0) if notch else (beyond > 0).any(axis=0)
    np.testing.assert_array_equal(kept[clear], ~hidden[clear])


@given(st.integers(0, 2**32 - 1), st.integers(0, 3))
def test_a_plane_through_centres_keeps_whole_layers_despite_rounding(seed, layer):
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)  # a rotation, not a mirror image
    mesh = MESH.with_points(MESH.points @ turn.T + 10 * turn[:, 1])
    clip = Cut.at(turn[:, 0], turn[:, 0] * (layer + 0.5))
    shown = Filters(mesh).kept(Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(cut=clip)))
    np.testing.assert_array_equal(shown, MESH.points[MESH.hexes].mean(axis=1)[:, 0] <= layer + 0.5)


def test_a_plane_near_an_axis_snaps_to_it():
    assert Plane((0.1, -1, 0.05), point=(1, 2, 3)).snapped() == Plane((0, -1, 0), point=(1, 2, 3))
    oblique = Plane((0.5, -1, 0.05))
    assert oblique.snapped() == oblique


# Clipping of polygons by planes, checked by areas.


HEXAGON = np.array([[np.cos(t), np.sin(t), 0] for t in np.arange(6) * np.pi / 3])


def polygons(shift):
    """Return a triangle, a square and a hexagon, each shifted in its plane."""
    parts = [HEXAGON[::2], HEXAGON[[0, 1, 3, 4]], HEXAGON]
    points = np.concatenate([part + [*move, 0] for part, move in zip(parts, shift, strict=True)])
    return Polygons(points, np.array([0, 3, 7, 13]), np.arange(13), np.array([7, 3, 5]))


def areas(of):
    """Return the area of each polygon by its owner."""
    area_of = {}
    for i, owner in enumerate(of.owner):
        x, y, _ = of.points[of.places[of.start[i] : of.start[i + 1]]].T
        area_of[int(owner)] = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    return area_of


@given(st.integers(0, 2**32 - 1), st.integers(1, 3))
def test_parts_in_front_of_and_beyond_planes_add_up_to_the_whole(seed, planes):
    random = np.random.default_rng(seed)
    whole = polygons(random.uniform(-1, 1, (3, 2)))
    normals, offsets = random.normal(size=(planes, 3)), random.uniform(-1, 1, planes)
    sums = dict.fromkeys((7, 3, 5), 0.0)
    for k in range(planes):  # before the first k planes, and beyond the next
        sign = np.where(np.arange(k + 1) == k, -1.0, 1.0)
        for owner, area in areas(whole.before(normals[: k + 1] * sign[:, None], offsets[: k + 1] * sign)).items():
            sums[owner] += area
    left = whole.before(normals, offsets)
    for owner, area in areas(left).items():
        assert area >= -1e-14
        sums[owner] += area
    expected = areas(whole)
    np.testing.assert_allclose([sums[k] for k in expected], list(expected.values()), atol=1e-12)
    assert (left.points @ normals.T <= offsets + 1e-12).all()
    assert left.start[0] == 0
    assert left.start[-1] == len(left.points) == len(left.places)


def test_a_plane_through_corners_leaves_the_part_in_front():
    square = Polygons(
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([0, 4]), np.arange(4), np.array([2])
    )
    half = square.before(np.array([[1.0, -1, 0]]), np.zeros(1))
    assert areas(half) == {2: 0.5}
    assert {tuple(point) for point in half.points} == {(0, 0, 0), (1, 1, 0), (0, 1, 0)}
    outside = square.before(np.array([[1.0, 0, 0]]), np.array([-2.0]))
    assert len(outside) == len(outside.points) == 0
    assert outside.start.tolist() == [0]


# Cuts by a sphere and by depth hide whole hexes.


BLOCK = grid(7, 6, 5)
CENTRES = BLOCK.points[BLOCK.hexes].mean(axis=1)
#: Distance of each centre from the nearest side of the body.
DISTANCE = np.minimum(CENTRES, [7, 6, 5] - CENTRES).min(axis=1)


def kept(cut, mesh=BLOCK, filters=None):
    frame = Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(cut=cut))
    return (filters or Filters(mesh)).kept(frame)


@pytest.mark.parametrize("notch", [False, True])
def test_hexes_with_their_centre_in_the_sphere_stay(notch):
    inside = np.linalg.norm(CENTRES - (3, 3, 2), axis=1) <= 2.2
    np.testing.assert_array_equal(kept(Cut(sphere=Sphere((3, 3, 2), 2.2), notch=notch)), inside != notch)
    assert 0 < inside.sum() < len(inside)


@pytest.mark.parametrize(("low", "high"), [(1, 1), (2, 2), (2, 3), (0, 99), (4, 5)])
@pytest.mark.parametrize("notch", [False, True])
def test_layers_are_counted_from_the_boundary(low, high, notch):
    layer = np.floor(DISTANCE) + 1
    shown = (layer >= low) & (layer <= high)
    np.testing.assert_array_equal(kept(Cut(depth=Depth(low, high), notch=notch)), shown != notch)


@pytest.mark.parametrize("scale", [1.0, 0.001])
def test_distances_are_in_mean_edge_lengths(scale):
    mesh = BLOCK.with_points(BLOCK.points * scale)
    shown = kept(Cut(depth=Depth(0.9, 1.6, DepthUnit.EDGES)), mesh)
    np.testing.assert_array_equal(shown, (DISTANCE >= 0.9) & (DISTANCE <= 1.6))
    assert 0 < shown.sum() < len(shown)


def test_hexes_stay_while_nodes_move_and_follow_when_the_cut_changes():
    filters = Filters(BLOCK)
    cut = Cut(depth=Depth(0.0, 0.6, DepthUnit.EDGES))
    before = kept(cut, filters=filters)
    inner = BLOCK.free
    moved = placed(BLOCK, inner, 0.5 * (BLOCK.points[inner] + [3.5, 3, 2.5]))
    np.testing.assert_array_equal(kept(cut, moved, filters), before)
    wider = Cut(depth=Depth(0.0, 0.7, DepthUnit.EDGES))
    np.testing.assert_array_equal(kept(wider, moved, filters), kept(wider, moved))


# Sections of second-order hexes: areas of sections of a cylinder, drawn edges, faces in the plane.


def smooth(*planes, **options):
    return Cut(planes=tuple(Plane(n, point=p) for n, p in planes), style=CutStyle.SMOOTH, **options)


def cut_of(mesh, cut, divisions=4, keep=None):
    return sections(mesh, keep, cut, np.zeros((mesh.n_hexes, 3), np.uint8), divisions)


def drawn_length(poly):
    """Return the total length of the drawn edges; those of two polygons count once."""
    if not poly.n_cells:
        return 0.0
    polygons, flags = Polygons.of(poly).separated(), edge_flags(poly)
    following = np.arange(1, len(polygons.points) + 1)
    following[polygons.start[1:] - 1] = polygons.start[:-1]
    drawn = np.ones(len(following), bool) if flags is None else flags
    start, end = polygons.points[drawn], polygons.points[following[drawn]]
    middles = cKDTree((start + end) / 2)
    sharing = [len(near) for near in middles.query_ball_point(middles.data, 1e-6)]
    return (np.linalg.norm(end - start, axis=1) / sharing).sum()


HALF = ((0, 0, 1.0), (0, 0, 0.3))


@pytest.mark.parametrize("nodes", [20, 27])
def test_the_section_across_a_cylinder_is_a_segment_of_a_ring(nodes):
    mesh = curved_shell(nodes, around=2)
    section = cut_of(mesh, smooth(HALF), 6)
    assert section.area == pytest.approx(3 * np.pi / 4, rel=4e-3)  # of flat hexes 0.9 of it
    np.testing.assert_allclose(np.asarray(section.points)[:, 2], 0.3, atol=1e-12)
    assert drawn_length(section) == pytest.approx((1 + 2) * np.pi / 2 + 3 * 1, rel=2e-3)
    centres = section.cell_centers().points
    assert ((np.arctan2(centres[:, 1], centres[:, 0]) > np.pi / 4) == hexes_of(section)).all()
    np.testing.assert_array_equal(normals_of(section), np.broadcast_to([0, 0, 1], (section.n_points, 3)))


def test_a_plane_that_only_the_bulge_of_a_hex_reaches_has_a_section():
    mesh = curved_shell(27, around=1)
    cut = smooth(((1.0, 1, 0), (1.2, 1.2, 0)))  # the flat outer face is at 1 / sqrt(2) * 2 = 1.41 from the axis
    height = 1.2 * np.sqrt(2)
    points = mesh.points[mesh.hexes]
    assert (points @ np.array([1, 1, 0]) / np.sqrt(2)).max() < height
    section = cut_of(mesh, cut, 8)
    assert section.area == pytest.approx(2 * np.sqrt(4 - height**2), rel=0.05)


@pytest.mark.parametrize("height", [0.0, 1 / 3, 0.5, 2 / 3, 1.0])
def test_faces_in_a_plane_are_drawn_once(height):
    mesh = curved_shell(27, around=2, along=3)
    section = cut_of(mesh, smooth(((0, 0, 1.0), (0, 0, height))), 8)
    within = 0 < height < 1
    if within:
        assert section.area == pytest.approx(3 * np.pi / 4, rel=5e-3)
    else:
        assert section.area in (0, pytest.approx(3 * np.pi / 4, rel=5e-3))
    if height == 1 / 3:
        assert set(hexes_of(section)) == {0, 3}


def straight(side=3, noise=0.0):
    """Return a cube of hexes of 20 nodes with straight edges, and the same of 8 nodes."""
    cells = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    at = (cells + UNIT_CUBE.astype(int)).reshape(-1, 3)
    points, index = np.unique(at, axis=0, return_inverse=True)
    linear = Mesh(points.astype(float), index.reshape(-1, 8))
    return linear.replace(mid_nodes=np.full((linear.n_hexes, 19), -1)), linear


CUTS = {
    "plane": smooth(((1, 0.3, 0.2), (1.4, 1, 1))),
    "two planes": smooth(((1, 0.3, 0.2), (1.4, 1, 1)), ((0, 0.2, 1), (1, 1, 1.8))),
    "notch": smooth(((1, 0.3, 0.2), (1.4, 1, 1)), ((0, 0.2, 1), (1, 1, 1.8)), notch=True),
    "box": Cut(box=Box((0.4, 0.4, 0.4), (3.5, 2.3, 2.3)), style=CutStyle.SMOOTH),
}


@pytest.mark.parametrize("cut", CUTS.values(), ids=CUTS)
def test_straight_hexes_have_the_sections_and_the_edges_of_hexes_of_eight_nodes(cut):
    mesh, linear = straight()
    colours = np.zeros((linear.n_hexes, 3), np.uint8)
    section, flat = cut_of(mesh, cut, 3), sections(linear, None, cut, colours)
    assert section.area == pytest.approx(flat.area, rel=1e-6)
    assert drawn_length(section) == pytest.approx(drawn_length(flat), rel=1e-6)
    faces = Skin(linear).visible()
    of_faces = colours[faces.hexes]
    whole = CurvedFaces(mesh, faces, 3).quads(mesh.points, of_faces)
    left = remaining_skin(whole, cut)
    expected = remaining_skin(quads(faces.places(linear.points), faces.quads, of_faces, faces.hexes), cut)
    assert left.area == pytest.approx(expected.area, rel=1e-9)
    # Parts of a notch meet with edges of different length where both planes cross a face.
    assert drawn_length(left) == pytest.approx(drawn_length(expected), rel=5e-3 if cut.notch else 1e-6)


def test_normals_of_a_cut_face_are_those_of_the_cylinder():
    mesh = curved_shell(27, around=3)
    faces = Skin(mesh).visible()
    whole = CurvedFaces(mesh, faces, 6).quads(mesh.points, np.zeros((len(faces.quads), 3), np.uint8))
    left = remaining_skin(whole, smooth(((1, 0.2, 0.7), (0.9, 0.9, 0.45))))
    points, normals = np.asarray(left.points), normals_of(left)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
    radius = np.linalg.norm(points[:, :2], axis=1)
    facing = (normals[:, :2] * points[:, :2]).sum(axis=1) / radius
    wall = (radius > 1.99) & (np.abs(facing) > 0.05)
    assert wall.any()
    assert (facing[wall] > np.cos(np.radians(1))).all()


# Meshes of hexes, wedges, pyramids and tetrahedra.


@pytest.mark.parametrize("kind", [mixed, prisms, honeycomb])
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1), st.floats(0.2, 0.8))
def test_the_section_of_a_mixed_mesh_is_that_of_its_skin(kind, normal, share):
    mesh = kind(3)
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    plane = Plane(normal, point=tuple(low + share * (high - low)))
    owners = np.arange(mesh.n_elements)
    got = sections(mesh, None, Cut((plane,), style=CutStyle.SMOOTH), np.zeros((len(owners), 3), np.uint8))
    faces = Skin(mesh).visible()
    skin = quads(faces.places(mesh.points), faces.quads, np.zeros((len(faces.quads), 3), np.uint8), faces.hexes)
    inside = np.einsum("ij,j->i", got.cell_centers().points - plane.point, plane.normal)
    assert np.abs(inside).max(initial=0) < 1e-6
    left = remaining_skin(skin, Cut((plane,), style=CutStyle.SMOOTH)).merge(got).triangulate().clean()
    a, b, c = np.moveaxis(np.asarray(left.points, float)[left.regular_faces], 1, 0)
    outward = np.cross(b - a, c - a).sum(axis=0)  # of a closed surface the areas, as vectors, add up to zero
    assert np.abs(outward).max() < 1e-4
    assert len(np.unique(hexes_of(got))) == got.n_cells


@pytest.mark.parametrize("height", [0.5, 1.0, 2.2, 2.9])
def test_the_section_of_a_box_of_four_kinds_has_its_area(height):
    mesh, colours = mixed(3), np.zeros((72, 3), np.uint8)
    for normal in np.eye(3):
        got = sections(mesh, None, Cut.at(tuple(normal), tuple(height * normal), CutStyle.SMOOTH), colours)
        assert got.area == pytest.approx(9)
