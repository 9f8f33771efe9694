"""Sections of second-order hexes: areas of sections of a cylinder, drawn edges, faces in the plane."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture import Box, Cut, CutStyle, Plane
from hexmend_app.scene.cutting.coarse_section import coarse_section
from hexmend_app.scene.cutting.curved_sections import curved_sections
from hexmend_app.scene.cutting.cut import remaining_skin, sections
from hexmend_app.scene.cutting.moving_planes import MOST_PLANES, MovingPlanes
from hexmend_app.scene.cutting.polygons import Polygons
from hexmend_app.scene.geometry.curved_faces import CurvedFaces
from hexmend_app.scene.geometry.edge_flags import edge_flags, normals_of
from hexmend_app.scene.geometry.plane_sides import centres_kept
from hexmend_app.scene.geometry.skin import Skin
from hexmend_app.scene.layers.surface import hexes_of, quads
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid, scrambled


def smooth(*planes, **options):
    return Cut(planes=tuple(Plane(n, point=p) for n, p in planes), style=CutStyle.SMOOTH, **options)


def cut_of(mesh, cut, divisions=4, keep=None):
    return curved_sections(mesh, keep, cut, np.zeros((mesh.n_hexes, 3), np.uint8), divisions)


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
    section, flat = cut_of(mesh, cut, 3), sections(linear.points, linear.hexes, None, cut, colours)
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


# Planes that move along their normals, compared with cuts computed anew; and the coarse picture of what they open.


MESH = grid(5, 4, 3)


def planes_of(random, count, along_axes):
    normals = np.eye(3)[random.integers(0, 3, count)] if along_axes else random.normal(size=(count, 3))
    return [Plane(tuple(n), point=tuple(random.uniform(0, 4, 3))) for n in normals]


@given(st.integers(0, 2**32 - 1), st.integers(1, MOST_PLANES + 2), st.booleans(), st.booleans())
def test_what_is_kept_is_what_a_cut_computed_anew_keeps(seed, count, notch, along_axes):
    random, moving = np.random.default_rng(seed), MovingPlanes(MESH)
    for points in (MESH.points, scrambled(MESH, 0.3, seed).points, MESH.points):
        planes = planes_of(random, count, along_axes)
        for _ in range(2):
            normals, offsets = zip(*(plane.equation for plane in planes), strict=True)
            expected = centres_kept(points, MESH.hexes, np.array(normals), np.array(offsets), notch)
            np.testing.assert_array_equal(moving.kept(points, planes, notch), expected)
            shift = random.normal(size=3)
            planes = [Plane(plane.normal, point=tuple(plane.point + shift)) for plane in planes]


@given(st.integers(0, 2**32 - 1), st.integers(1, MOST_PLANES), st.booleans())
def test_sections_are_the_faces_inside_the_mesh_that_a_cut_makes_visible(seed, count, along_axes):
    random, moving, skin = np.random.default_rng(seed), MovingPlanes(MESH), Skin(MESH)
    points, planes = scrambled(MESH, 0.3, seed).points, planes_of(random, count, along_axes)
    kept = moving.kept(points, planes, False)
    faces = skin.visible(kept)
    inside = skin.opened(faces, kept)
    expected = {(h, *nodes) for h, nodes in zip(faces.hexes[inside], faces.nodes[faces.quads[inside]], strict=True)}
    quads, hexes = moving.sections(points, planes)
    assert {(h, *nodes) for h, nodes in zip(hexes, quads, strict=True)} == expected


@pytest.mark.parametrize("cells", [0.5, 100])
def test_small_faces_become_squares_in_the_plane_and_large_ones_stay(cells):
    """A cell of 1/128 of the diagonal is larger or smaller than the faces."""
    plane, moving = Plane((0.0, 0.0, 1.0), point=(0.0, 0.0, 1.6)), MovingPlanes(MESH)
    quads, hexes = moving.sections(MESH.points, [plane])
    corners, owners = coarse_section(MESH.points, quads, hexes, [plane], diagonal=128 * 2 / cells)
    assert corners.shape == (4 * len(owners), 3)
    assert set(owners) <= set(hexes)
    if cells > 1:
        np.testing.assert_array_equal(corners, MESH.points[quads.ravel()])
        np.testing.assert_array_equal(owners, hexes)
        return
    np.testing.assert_allclose(corners[:, 2], 1.6)
    sides = np.linalg.norm(np.roll(corners.reshape(-1, 4, 3), -1, axis=1) - corners.reshape(-1, 4, 3), axis=2)
    np.testing.assert_allclose(sides, 4.0)
    assert len({tuple(place) for place in corners.reshape(-1, 4, 3).mean(axis=1).round(9)}) == len(owners)
