"""Attaching the nodes of a boundary to another surface: to curves, to patches, or not at all."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import NodeClass, PartitionedSurface, SkinSurface, boundary_of
from tests.core.grids import grid


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
