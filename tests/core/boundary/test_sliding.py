"""Sliding nodes of a boundary, their neighbours and their projection."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import Keeping, PartitionedSurface, SkinSurface, SlidingBoundary, departures, freed_by_sliding
from hexmend.boundary.classification import NodeClass, boundary_of
from hexmend.gallery import make
from hexmend.quality import locked_hexes, measure
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid


def test_rings_of_sliding_nodes_are_on_their_own_curves_and_patches():
    mesh = make("bridge-sharp", size=500)
    sliding = SlidingBoundary(mesh)
    kind, part, rings = sliding.boundary.node_class, sliding.boundary.component, sliding.rings
    for node in range(mesh.n_nodes):
        whole, ring = mesh.topology.rings[node], rings[node]
        assert set(ring) <= set(whole)
        if kind[node] < NodeClass.CURVE:
            np.testing.assert_array_equal(ring, whole)
        elif kind[node] == NodeClass.CURVE:
            assert len(ring) == 2
            assert all(part[other] == part[node] or kind[other] == NodeClass.CORNER for other in ring)
        else:
            assert len(ring) >= 3
            assert all(kind[other] != NodeClass.INSIDE for other in ring)


def test_a_mesh_keeps_its_surface_on_request():
    mesh = ball(3)
    moved = mesh.keeping_surface().with_points(1.1 * mesh.points)
    np.testing.assert_array_equal(moved.surface_points, mesh.points)
    np.testing.assert_array_equal(moved.keeping_surface().with_points(mesh.points).surface_points, mesh.points)
    np.testing.assert_array_equal(mesh.with_points(1.1 * mesh.points).surface_points, 1.1 * mesh.points)
    np.testing.assert_array_equal(SlidingBoundary(moved).mesh.points, moved.points)
    places = SlidingBoundary(moved).project(moved.points[SlidingBoundary(moved).nodes])
    np.testing.assert_allclose(np.linalg.norm(places, axis=1), 1, atol=0.2)


# Sliding nodes among those of the boundary alone do as those of the whole mesh do.


def on_itself():
    mesh = make("five-side", size=400, scramble=0.1)
    return SlidingBoundary(mesh, max_deviation=0.01 * mesh.mean_edge_length)


def on_a_target():
    """The boundary of a coarse mesh on that of a finer one."""
    mesh, fine = make("five-side", size=400, scramble=0.1), make("five-side", size=3000)
    skin = SkinSurface(fine.points, fine.topology.boundary_faces)
    return SlidingBoundary(mesh.sliding_on(skin), max_deviation=0.01 * mesh.mean_edge_length)


@pytest.fixture(scope="module", params=[on_itself, on_a_target])
def sliding(request):
    return request.param()


def test_places_directions_and_rejected_nodes_are_the_same(sliding):
    alone, numbers = sliding.on_boundary()
    points = sliding.mesh.points
    np.testing.assert_array_equal(alone.points, points[numbers])
    np.testing.assert_array_equal(numbers[alone.nodes], sliding.nodes)
    rng = np.random.default_rng(1)
    moved = points + 0.4 * sliding.mesh.mean_edge_length * rng.standard_normal(points.shape)
    moved[sliding.nodes] = places = sliding.project(moved[sliding.nodes])
    np.testing.assert_allclose(alone.project(moved[numbers][alone.nodes]), places, atol=1e-14)
    np.testing.assert_allclose(alone.tangent_bases(places), sliding.tangent_bases(places), atol=1e-9)
    rejected = sliding.rejected_nodes(points, moved)
    assert rejected.size
    np.testing.assert_array_equal(numbers[alone.rejected_nodes(points[numbers], moved[numbers])], rejected)


# Locked hexes that sliding can free.


@pytest.mark.parametrize("degrees", [40.0, 180.0])
def test_a_boundary_without_curves_frees_what_it_locks(degrees):
    """At 180 degrees nothing is a feature: one patch, on which all nodes slide."""
    mesh = slid(ball(3), 0.6, seed=0)
    held = locked_hexes(mesh.points, mesh.hexes, mesh.fixed, measure(mesh.points, mesh.hexes).inverted)
    assert held.any()
    freed = freed_by_sliding(mesh, held, degrees)
    assert (freed <= held).all()
    if degrees == 180.0:
        assert boundary_of(mesh, degrees).n_curves == 0
        np.testing.assert_array_equal(freed, held)


# Attaching the nodes of a boundary to another surface: to curves, to patches, or not at all.


@pytest.fixture(scope="module")
def cube():
    mesh = grid(4)
    return mesh, boundary_of(mesh)


@pytest.mark.parametrize(
    ("shift", "reach", "curve"),
    [(0.24, 1.0, NodeClass.CURVE), (0.26, 1.0, NodeClass.PATCH), (0.26, 1.1, NodeClass.CURVE)],
)
def test_nodes_of_a_curve_slide_on_a_curve_within_a_quarter_of_the_reach(cube, shift, reach, curve):
    """The nodes of the edge x = 0, y = 0, moved into the face y = 0: it is still near that face."""
    mesh, boundary = cube
    on = np.flatnonzero((boundary.node_class == NodeClass.CURVE) & (mesh.points[:, 0] == 0) & (mesh.points[:, 1] == 0))
    points = mesh.points.copy()
    points[on, 0] += shift
    attached = PartitionedSurface(mesh.points, boundary).attached(points, boundary, reach)
    assert (attached.node_class[on] == curve).all()
    (part,) = set(attached.component[on].tolist())
    if curve == NodeClass.CURVE:
        assert {part} == set(boundary.component[on].tolist())
    else:
        side = (boundary.node_class == NodeClass.PATCH) & (mesh.points[:, 1] == 0)
        assert {part} == set(boundary.component[side].tolist())


@pytest.mark.parametrize(("shift", "kind"), [(0.99, NodeClass.PATCH), (1.01, NodeClass.CORNER)])
def test_what_is_out_of_reach_of_all_patches_stays(cube, shift, kind):
    mesh, boundary = cube
    top = np.flatnonzero((boundary.node_class == NodeClass.PATCH) & (mesh.points[:, 2] == 4))
    points = mesh.points.copy()
    points[top, 2] += shift
    attached = PartitionedSurface(mesh.points, boundary).attached(points, boundary, 1.0)
    assert (attached.node_class[top] == kind).all()
    assert ((attached.component[top] >= 0) == (kind == NodeClass.PATCH)).all()


def test_on_its_own_surface_each_node_slides_where_it_did(cube):
    mesh, boundary = cube
    attached = PartitionedSurface(mesh.points, boundary).attached(mesh.points, boundary, 1.0)
    np.testing.assert_array_equal(attached.node_class, boundary.node_class)
    on = boundary.node_class == NodeClass.CURVE
    np.testing.assert_array_equal(attached.component[on], boundary.component[on])


@given(st.integers(0, 2**32 - 1))
def test_nodes_slide_on_the_patch_of_the_nearest_face(seed):
    """Nodes displaced at random in a cube whose side is 4: the nearest side is known without a search."""
    mesh = grid(4)
    surface = SkinSurface(mesh.points, mesh.topology.boundary_faces)
    boundary = boundary_of(mesh)
    patch = np.flatnonzero(boundary.node_class == NodeClass.PATCH)
    points = mesh.points.copy()
    points[patch] = np.random.default_rng(seed).uniform(0, 4, (patch.size, 3))
    distances = np.concatenate([points[patch], 4 - points[patch]], axis=1)  # from x, y, z = 0 and 4
    nearest = distances.argmin(axis=1)
    of_side = np.empty(6, dtype=int)
    for side in range(6):
        inside = mesh.points[patch, side % 3] == (0 if side < 3 else 4)
        (of_side[side],) = set(boundary.component[patch[inside]].tolist())
    for whole in (None, surface.trees):
        attached = PartitionedSurface(mesh.points, boundary, whole).attached(points, boundary, 10.0)
        np.testing.assert_array_equal(attached.component[patch], of_side[nearest])


# Nodes that have left their corner, curve or patch.


def test_nodes_that_slide_are_kept_exactly():
    mesh = grid(4)
    left = departures(mesh, slid(mesh, 0.3))
    assert not left.nodes.size
    assert left.sentence == ""
    np.testing.assert_array_equal(left.keeping == Keeping.INSIDE, mesh.interior)
    assert (left.keeping[mesh.topology.boundary] == Keeping.EXACT).all()


def test_nodes_that_leave_are_counted_by_their_class():
    mesh = grid(4)
    node_class = SlidingBoundary(mesh).boundary.node_class
    corner, curve, patch = (np.flatnonzero(node_class == of)[0] for of in list(NodeClass)[1:])
    points = mesh.points.copy()
    points[corner] += 0.2  # away from its place
    points[curve] += 0.1 * (mesh.points.mean(axis=0) - points[curve]) / 2
    points[patch] += [0.05, 0.05, 0.05]
    left = departures(mesh, mesh.with_points(points))
    assert left.nodes.tolist() == sorted([corner, curve, patch])
    assert list(left.counts.values()) == [1, 1, 1]
    assert left.max == pytest.approx(0.2 * np.sqrt(3))
    assert (left.keeping[left.nodes] == Keeping.WITHIN_TOLERANCE).all()
    assert left.to_dict() | {"max": 0} == left.counts | {"max": 0, "nodes": left.nodes.tolist()}
    assert "1 corner has left its place, 1 node has left its curve, 1 node has left its patch" in left.sentence
