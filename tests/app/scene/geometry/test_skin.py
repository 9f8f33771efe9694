"""Skin, compared with brute force, and checked as a closed surface that faces outwards."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells
from hexmend.errors import MeshError
from hexmend.kernels import skin
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.geometry.coloured_polygons import polygons
from hexmend_app.scene.geometry.occlusion import ambient_light, directions
from hexmend_app.scene.geometry.polygons import Polygons
from hexmend_app.scene.geometry.skin import Skin
from tests.core.grids import grid, scrambled
from tests.core.refined_meshes import refined
from tests.core.solid_lattices import mixed
from tests.core.threads import by_threads

SIZES = st.tuples(*[st.integers(1, 4)] * 3)


def visible_faces(mesh, keep):
    faces = Skin(mesh).visible(keep)
    return faces, faces.nodes[faces.quads]


def test_a_face_towards_refined_hexes_is_visible_where_they_are_hidden():
    mesh = refined(grid(2, 1, 1), np.array([False, True]))
    coarse = np.arange(mesh.n_hexes) == 0
    _, quads = visible_faces(mesh, coarse)
    assert {frozenset(quad) for quad in quads.tolist()} == {frozenset(mesh.hexes[0][face].tolist()) for face in FACES}
    assert len(visible_faces(mesh, ~coarse)[1]) == 24


@given(SIZES)
def test_the_skin_of_the_whole_mesh_is_its_boundary(size):
    mesh = grid(*size)
    _, quads = visible_faces(mesh, None)
    boundary = {frozenset(face) for face in mesh.topology.boundary_faces.tolist()}
    assert {frozenset(quad) for quad in quads.tolist()} == boundary
    assert len(quads) == len(boundary)


@given(SIZES, st.integers(0, 2**32 - 1))
def test_any_mask_leaves_a_closed_surface_that_faces_outwards(size, seed):
    mesh = grid(*size)
    keep = np.random.default_rng(seed).random(mesh.n_hexes) < 0.5
    faces, quads = visible_faces(mesh, keep)
    expected = Counter()
    for h in np.flatnonzero(keep):
        expected.update(frozenset(face) for face in mesh.hexes[h][FACES].tolist())
    assert {frozenset(quad) for quad in quads.tolist()} == {face for face, times in expected.items() if times == 1}
    edges = Counter(frozenset((quad[k], quad[k - 1])) for quad in quads.tolist() for k in range(4))
    assert all(times % 2 == 0 for times in edges.values())
    x = mesh.points[quads]
    normals = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    outwards = x.mean(axis=1) - mesh.points[mesh.hexes[faces.hexes]].mean(axis=1)
    assert (np.einsum("ij,ij->i", normals, outwards) > 0).all()
    assert keep[faces.hexes].all()
    assert sorted(faces.nodes.tolist()) == sorted(set(quads.ravel().tolist()))


@given(SIZES, st.integers(0, 2**32 - 1), st.sampled_from([0, 10, 10_000]))
def test_shrunk_hexes_have_separate_nodes_nearer_to_their_mean(size, seed, whole):
    mesh, shrink = grid(*size), 0.3
    keep = np.random.default_rng(seed).random(mesh.n_hexes) < 0.7
    few = keep.sum() <= whole
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hexmend_app.scene.geometry.skin.WHOLE", whole)
        faces = Skin(mesh).shrunk(shrink, keep)
    behind = mesh.topology.face_neighbours
    seen = keep[:, None] & ((behind < 0) | ~keep[behind])
    chosen = keep if few else seen.any(axis=1)
    hexes = np.flatnonzero(chosen)
    np.testing.assert_array_equal(faces.nodes, mesh.hexes[hexes].ravel())
    np.testing.assert_array_equal(faces.hexes, np.repeat(hexes, 6))
    np.testing.assert_array_equal(faces.nodes[faces.quads], mesh.hexes[hexes][:, FACES].reshape(-1, 4))
    assert (hexes[faces.quads // 8] == faces.hexes[:, None]).all()
    x = mesh.points[mesh.hexes[hexes]]
    places = x + shrink * (x.mean(axis=1, keepdims=True) - x)
    np.testing.assert_allclose(faces.places(mesh.points), places.reshape(-1, 3), atol=1e-14)


@given(SIZES, st.integers(0, 2**32 - 1))
def test_edges_of_kept_hexes_are_kept(size, seed):
    mesh = grid(*size)
    keep = np.random.default_rng(seed).random(mesh.n_hexes) < 0.4
    rows, edges = mesh.topology.node_corners, mesh.topology.edges
    kept = np.empty(len(edges), bool)
    skin.edges_kept(mesh.hexes, rows.start, rows.items, edges, keep, kept)
    expected = {frozenset(edge) for edge in mesh.hexes[keep][:, EDGES].reshape(-1, 2).tolist()}
    assert {frozenset(edge) for edge in edges[kept].tolist()} == expected


@given(SIZES, st.integers(0, 2**32 - 1), st.sampled_from([None, "in sight", "all"]))
def test_a_face_is_opened_if_it_is_inside_the_mesh(size, seed, shrunk):
    mesh = grid(*size)
    keep = np.random.default_rng(seed).random(mesh.n_hexes) < 0.6
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hexmend_app.scene.geometry.skin.WHOLE", 10_000 if shrunk == "all" else 0)
        one = Skin(mesh)
        faces = one.visible(keep) if shrunk is None else one.shrunk(0.2, keep)
    boundary = {frozenset(face) for face in mesh.topology.boundary_faces.tolist()}
    nodes = faces.nodes[faces.quads] if shrunk is None else None
    if nodes is None:  # they have nodes of their own, eight by eight
        nodes = mesh.hexes[faces.hexes[:, None], faces.quads % 8]
    expected = [frozenset(face) not in boundary for face in nodes.tolist()]
    np.testing.assert_array_equal(one.opened(faces, keep), np.array(expected, bool))


def test_invalid_arrays_are_rejected_before_the_kernel_is_called():
    mesh = grid(2)
    with pytest.raises(MeshError, match=r"keep has shape \(7,\): expected \(8,\)"):
        Skin(mesh).visible(np.ones(7, bool))
    with pytest.raises(MeshError, match="expected numbers from 0 to 4"):
        Skin(mesh).shrunk(0.5).places(mesh.points[:5])


# Ambient occlusion, compared with analytical results.


def faces(mesh, keep=None):
    """Return the visible faces of a mesh as polygons, and the hex of each."""
    found = Skin(mesh).visible(keep)
    k = len(found.quads)
    places = found.quads.ravel().astype(np.int64)
    return Polygons(found.places(mesh.points), 4 * np.arange(k + 1), places, np.arange(k)), found.hexes


def centres(polygons):
    """Return the centres of quads, (k, 3)."""
    return polygons.points[polygons.places].reshape(-1, 4, 3).mean(axis=1)


def of_faces(answer):
    """Return the mean value of the corners of each quad, (k,)."""
    return answer.reshape(-1, 4).mean(axis=1)


def test_directions_are_distributed_evenly():
    all_around = directions(64)
    np.testing.assert_allclose(np.linalg.norm(all_around, axis=1), 1)
    np.testing.assert_allclose(all_around.mean(axis=0), 0, atol=0.02)
    # The mean of d d^T over a sphere is a third of the identity.
    np.testing.assert_allclose(all_around.T @ all_around / 64, np.eye(3) / 3, atol=0.02)


def test_a_convex_body_is_fully_exposed():
    np.testing.assert_array_equal(ambient_light(faces(grid(4, 3, 2))[0]), 1)


def test_a_floor_has_less_light_near_a_wall():
    """An infinite wall of height h blocks (1 - d / sqrt(d² + h²)) / 2 of the light of a floor at distance d."""
    mesh = grid(12, 60, 7)
    middle = mesh.points[mesh.hexes].mean(axis=1)
    keep = (middle[:, 0] < 1) | (middle[:, 2] < 1)  # a floor of height 1, a wall of height 6 over it
    polygons, _ = faces(mesh, keep)
    at = centres(polygons)
    floor = (at[:, 2] == 1) & (at[:, 0] > 1) & (np.abs(at[:, 1] - 30) < 8)
    away = at[floor, 0] - 1
    expected = 1 - (1 - away / np.hypot(away, 6)) / 2
    got = of_faces(ambient_light(polygons))[floor]
    np.testing.assert_allclose(got, expected, atol=0.05)
    nearest, furthest = got[away == away.min()].mean(), got[away == away.max()].mean()
    assert nearest < 0.6 < 0.8 < furthest


def test_an_enclosed_cavity_has_no_light():
    mesh = grid(3, 3, 3)
    keep = np.ones(27, bool)
    keep[13] = False
    polygons, _ = faces(mesh, keep)
    inside = (np.abs(centres(polygons) - 1.5) <= 0.5).all(axis=1)
    assert inside.sum() == 6
    answer = of_faces(ambient_light(polygons))
    assert (answer[inside] == 0).all()
    assert (answer[~inside] == 1).all()


@pytest.mark.parametrize(("size", "far"), [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e4)])
def test_light_is_invariant_under_scaling_and_translation(size, far):
    mesh = grid(5, 5, 5)
    keep = np.random.default_rng(0).random(mesh.n_hexes) < 0.6
    here, there = faces(mesh, keep)[0], faces(mesh.with_points(size * mesh.points + far), keep)[0]
    # Not to the bit: a pixel at the edge of a face may go to either side.
    difference = ambient_light(here) - ambient_light(there)
    assert np.abs(difference).mean() < 0.01


def test_the_result_does_not_depend_on_the_number_of_threads():
    mesh = grid(6, 6, 6)
    polygons, _ = faces(scrambled(mesh, 0.3, 1), np.random.default_rng(1).random(mesh.n_hexes) < 0.5)
    first, *others = by_threads(lambda: ambient_light(polygons), (1, 2, 5))
    assert all((answer == first).all() for answer in others)


def test_the_computation_can_be_cancelled():
    asked = []
    polygons, _ = faces(grid(2, 2, 2))
    assert ambient_light(polygons, lambda: asked.append(1) or len(asked) < 3) is None
    assert len(asked) == 3


# Meshes of hexes, wedges, pyramids and tetrahedra.


def enclosed(points, faces):
    """Return the volume that faces, quads or triangles that repeat their last node, enclose."""
    a, b, c, d = (points[faces[:, k]] for k in range(4))
    triangles = np.einsum("ij,ij->i", a, np.cross(b, c)) + np.einsum("ij,ij->i", a, np.cross(c, d))
    return triangles.sum() / 6


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.3]))
def test_any_cells_of_a_mixed_mesh_are_enclosed_by_their_skin(seed, shrink):
    mesh = mixed(3)
    keep = np.random.default_rng(seed).random(mesh.n_elements) < 0.6
    skin = Skin(mesh)
    faces = skin.shrunk(shrink, keep) if shrink else skin.visible(keep)
    volume = enclosed(faces.places(mesh.points), faces.quads)
    assert volume == pytest.approx((1 - shrink) ** 3 * mesh.quality("volume")[keep].sum())
    assert keep[faces.hexes].all()
    assert len(skin.opened(faces, keep)) == len(faces.quads)
    drawn = polygons(faces.places(mesh.points), faces.quads)
    assert drawn.n_cells == len(faces.quads)
    assert drawn.area == pytest.approx(drawn.triangulate().area)


def test_a_quad_that_two_triangles_cover_is_seen_when_their_cells_are_hidden():
    cubes = grid(2, 1, 1)
    one, other = cubes.hexes
    tetrahedra = other[[[0, 1, 2, 5], [0, 2, 3, 7], [0, 5, 7, 4], [2, 7, 5, 6], [0, 2, 7, 5]]]
    mesh = Mesh(cubes.points, one[None], cells=(Cells("tetra", tetrahedra),))
    faces, _ = visible_faces(mesh, np.arange(6) == 0)
    assert enclosed(faces.places(mesh.points), faces.quads) == pytest.approx(1)
