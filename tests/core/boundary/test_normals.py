"""Directions of triangles and curves."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, SkinSurface, SlidingBoundary, boundary_of
from hexmend.boundary.normals import curve_tangents, directions_of_means, segment_tangents, unit_vectors, vertex_normals
from hexmend.energy.quads.surface_quads import QuadNormals
from hexmend.gallery import make
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.grids import grid
from tests.core.smoothers.test_sliding_smoother import skin_of


@pytest.fixture(scope="module")
def rims():
    """A cylinder, whose two rims are curves without corners."""
    mesh = cylinder()
    return mesh, boundary_of(mesh)


def test_tangents_of_curves_are_unit_vectors_in_the_sense_of_their_segments(rims):
    mesh, boundary = rims
    tangents, own = curve_tangents(mesh.points, boundary), segment_tangents(mesh.points, boundary.segments)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=2), 1)
    assert (np.einsum("sei,si->se", tangents, own) > 0.9).all()


def test_the_tangents_of_a_circle_stand_at_right_angles_to_its_radius(rims):
    mesh, boundary = rims
    assert (boundary.node_class[boundary.segments] == NodeClass.CURVE).all()
    out = mesh.points[boundary.segments] * [1, 1, 0]
    np.testing.assert_allclose(np.einsum("sei,sei->se", curve_tangents(mesh.points, boundary), out), 0, atol=1e-12)


def weighted_by_angles(vertices, triangles, patch):
    """The definition: at each corner the mean of the normals of the triangles of its patch, weighted by their angles."""
    normals = np.zeros((len(triangles), 3, 3))
    for own, corner in np.ndindex(len(triangles), 3):
        for other, triangle in enumerate(triangles):
            for at in np.flatnonzero(triangle == triangles[own, corner]):
                one, two = (vertices[triangle[(at + k) % 3]] - vertices[triangle[at]] for k in (1, 2))
                across = np.cross(one, two)
                size = np.linalg.norm(across)
                if patch[other] == patch[own] and size > 0:
                    normals[own, corner] += np.arctan2(size, one @ two) * across / size
    return unit_vectors(normals)


@pytest.mark.parametrize("patches", [1, 2, 20])
def test_normals_of_vertices_are_means_weighted_by_angles_over_their_own_patch(patches):
    random = np.random.default_rng(patches)
    vertices, triangles = random.normal(size=(12, 3)), random.integers(0, 12, (40, 3)).astype(np.int32)
    patch = random.integers(0, patches, 40)
    expected = weighted_by_angles(vertices, triangles, patch)
    np.testing.assert_allclose(vertex_normals(vertices, triangles, patch), expected, atol=1e-9)
    assert (np.diff(np.sort(triangles), axis=1) == 0).any()  # some have no area


def test_means_of_opposed_vectors_have_the_direction_that_is_given_for_them():
    means, otherwise = np.array([[0, 0, 0.5], [0, 0, 1e-16]]), np.array([[1.0, 0, 0], [0, 1.0, 0]])
    np.testing.assert_array_equal(directions_of_means(means, otherwise), [[0, 0, 1], [0, 1, 0]])


# Normals of the surface at the quads of a sliding boundary.


def centres(mesh, sliding):
    return mesh.points[sliding.boundary.faces].mean(axis=1)


def test_on_a_ball_they_are_radial_wherever_nodes_slide():
    mesh = ball(6)
    sliding = SlidingBoundary(mesh)
    normals = QuadNormals(sliding)
    for there in mesh, slid(mesh, 0.4, 1):
        radial = centres(there, sliding)
        radial /= np.linalg.norm(radial, axis=1, keepdims=True)
        found = normals(there.points)
        np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1)
        assert np.einsum("fi,fi->f", found, radial).min() > 0.99


def test_quads_at_an_edge_have_the_normal_of_their_own_patch():
    mesh = cylinder(32, 4)
    sliding = SlidingBoundary(mesh)
    found, middle = QuadNormals(sliding)(mesh.points), centres(mesh, sliding)
    top = middle[:, 2] > 1 - 1e-9
    np.testing.assert_allclose(found[top], [[0, 0, 1]] * top.sum(), atol=1e-12)
    side = (middle[:, 2] > 1e-9) & ~top
    assert np.abs(found[side, 2]).max() < 1e-12


@pytest.mark.parametrize("reversed_", [False, True])
def test_the_triangles_of_a_target_may_face_either_way(reversed_):
    skin = skin_of(ball(10))
    if reversed_:
        skin = SkinSurface(skin.points, np.ascontiguousarray(skin.faces[:, ::-1]), "part.stl")
    mesh = ball(4).sliding_on(skin)
    sliding = SlidingBoundary(mesh)
    found = QuadNormals(sliding)(sliding.mesh.points)
    assert np.einsum("fi,fi->f", found, centres(mesh, sliding)).min() > 0.8


# Moves that flip quads are undone.


def folded():
    """Make a box with a step that takes a node of its top beyond its neighbour."""
    mesh = grid(4)
    node = int(np.flatnonzero((mesh.points == [2, 2, 4]).all(axis=1))[0])
    after = mesh.points.copy()
    after[node, 0] += 2.5
    return mesh, SlidingBoundary(mesh), node, after


def test_nodes_of_turned_quads_stay_where_they_are():
    mesh, sliding, node, after = folded()
    turned = sliding.flipped_quads(mesh.points, after)
    assert turned.size
    assert (sliding.boundary.faces[turned] == node).any(axis=1).all()
    after[0] += 0.01  # of another quad, which is sound
    back = sliding.reject_moves(mesh.points, after)
    np.testing.assert_array_equal(back[node], mesh.points[node])
    np.testing.assert_array_equal(back[0], after[0])


# Directions in which nodes of curves and patches may move: at right angles to the normal, along the tangent.


@pytest.fixture(scope="module", params=["five-side", "bridge-sharp"])
def sliding(request):
    return SlidingBoundary(make(request.param))


def places(sliding, seed):
    """Places on the surface of all sliding nodes: a third of them as they were, on vertices of the surface."""
    random = np.random.default_rng(seed)
    x = sliding.points[sliding.nodes]
    shift = 0.3 * sliding.mesh.mean_edge_length * random.normal(size=x.shape)
    return sliding.project(x + shift * (random.uniform(size=len(x)) < 0.67)[:, None])


def expected_basis(direction, of_curve):
    """One node's directions, by the formula: the first is at right angles to the axis most across the normal."""
    if of_curve:
        return np.column_stack([direction, np.zeros((3, 2))])
    first = np.cross(direction, np.eye(3)[np.abs(direction).argmin()])
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(direction, first), np.zeros(3)])


@pytest.mark.slow
def test_directions_are_those_of_the_normals_and_tangents(sliding):
    x, of_curve = places(sliding, 0), sliding.node_class[sliding.nodes] == NodeClass.CURVE
    found = sliding.surface.trees.closest(x, sliding.surface.group_of(sliding.nodes))
    flat, smooth = (sliding.surface.directions(found, smooth=smooth) for smooth in (False, True))
    used = np.where(of_curve[:, None], found.weights[:, :2].min(axis=1)[:, None], found.weights.min(axis=1)[:, None])
    inside = used > 1e-3
    assert inside.any()
    assert not inside.all()
    bases = sliding.tangent_bases(x)
    for row, direction in enumerate(np.where(inside, flat, smooth)):
        np.testing.assert_allclose(bases[row], expected_basis(direction, of_curve[row]), atol=1e-12)
    gram = bases.transpose(0, 2, 1) @ bases
    assert of_curve.any()
    np.testing.assert_allclose(gram[of_curve], np.broadcast_to(np.diag([1.0, 0, 0]), gram[of_curve].shape), atol=1e-12)
    np.testing.assert_allclose(
        gram[~of_curve], np.broadcast_to(np.diag([1.0, 1, 0]), gram[~of_curve].shape), atol=1e-12
    )
    some = np.arange(0, len(x), 3)
    np.testing.assert_array_equal(sliding.tangent_bases(x[some], sliding.nodes[some]), bases[some])
