"""Features that stand out from the surface around them, and corners that stand out from their curve."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, boundary_of, classify
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.prominence import surrounding_angles
from hexmend.io import read
from tests.core.boundary.solids import ball, cylinder, wavy


def counts(boundary):
    return [boundary.count(of) for of in (NodeClass.CORNER, NodeClass.CURVE, NodeClass.PATCH)]


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
