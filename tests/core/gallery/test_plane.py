"""The gallery mesh plane: figures, boundary, the inverted hexes and that they can be mended."""

import numpy as np
import pytest

import hexmend as hx
from hexmend import StoppingCriteria, summarise
from hexmend.doctor import examine
from hexmend.gallery import make
from hexmend.gallery.aeroplane import FUSELAGE, TAILPLANE, WINGS
from hexmend.gallery.plane import BOX


@pytest.fixture(scope="module")
def plane():
    return make("plane")


@pytest.mark.slow
def test_counts_and_qualities_are_near_those_of_the_thesis(plane):
    summary = summarise(plane)
    assert examine(plane) == ()
    assert summary.hexes == 31760
    assert summary.free_nodes == pytest.approx(30389, rel=0.005)
    assert summary.nodes == pytest.approx(33411, rel=0.01)
    assert summary.inverted == pytest.approx(163, abs=5)
    assert summary.locked_inverted == 0
    assert (summary.q_min, summary.q_mean, summary.q_std) == pytest.approx((0.0945, 0.8164, 0.1276), abs=0.1)
    assert summary.q_min > 0
    assert summary.q_mean == pytest.approx(0.8164, abs=0.005)


@pytest.mark.slow
def test_the_boundary_is_the_box_and_the_aeroplane(plane):
    on_body, on_box = (np.isin(np.arange(plane.n_nodes), plane.node_sets[name]) for name in ("aeroplane", "box"))
    assert not (on_body & on_box).any()
    np.testing.assert_array_equal(plane.topology.boundary, on_body | on_box)
    faces = plane.topology.boundary_faces
    assert (on_body[faces].all(axis=1) ^ on_box[faces].all(axis=1)).all()
    on_plane = np.isclose(plane.points[:, None, :], BOX).any(axis=(1, 2))
    np.testing.assert_array_equal(on_plane, on_box)


@pytest.mark.parametrize("size", [1000, pytest.param(31760, marks=pytest.mark.slow)])
def test_each_surface_is_closed_and_without_handles(size):
    mesh = make("plane", size=size)
    faces = mesh.topology.boundary_faces
    edges = np.concatenate([faces[:, [i, (i + 1) % 4]] for i in range(4)])
    for name in ("aeroplane", "box"):
        mine = np.isin(edges, mesh.node_sets[name]).all(axis=1)
        _, times = np.unique(np.sort(edges[mine], axis=1), axis=0, return_counts=True)
        assert (times == 2).all()
        assert len(mesh.node_sets[name]) - len(times) + mine.sum() // 4 == 2  # Euler: a sphere


def test_it_is_unstructured_and_its_sizes_range_widely(plane):
    edges = plane.topology.edges
    length = np.linalg.norm(np.diff(plane.points[edges], axis=1)[:, 0], axis=1)
    assert np.percentile(length, 99) > 10 * np.percentile(length, 1)
    inner = ~plane.topology.boundary
    valence = np.bincount(edges.ravel())[inner]
    assert {5, 6, 7} <= set(valence)  # 6 in a structured mesh
    assert np.count_nonzero(valence != 6) > 400


def test_the_aeroplane_has_wings_a_tailplane_and_a_fin(plane):
    x, y, z = plane.points[plane.node_sets["aeroplane"]].T
    assert np.ptp(x) == pytest.approx(1, abs=0.1)
    assert np.ptp(y) == pytest.approx(2 * WINGS.span, abs=0.05)
    tip = np.abs(y) > 0.9 * WINGS.span
    root = np.isclose(np.abs(y), FUSELAGE.radius, rtol=0.1)
    assert x[tip].min() > x[root & (x > WINGS.leading)].min() + 0.05  # swept
    tail = x > TAILPLANE.leading
    assert FUSELAGE.radius < np.abs(y[tail & ~tip]).max() < WINGS.span
    assert z[tail].max() > 2 * FUSELAGE.radius > z[~tail].max()


@pytest.mark.parametrize("size", [3000, pytest.param(8000, marks=pytest.mark.slow)])
def test_local_descent_mends_all(size):
    mesh = make("plane", size=size)
    result = hx.smooth(mesh, "local-sd", StoppingCriteria(max_iterations=60))
    before, after = summarise(mesh), summarise(result.mesh)
    assert before.inverted > 10
    assert after.inverted == 0
    assert after.q_min > max(before.q_min, 0.35)
    assert after.q_mean > before.q_mean + 0.04
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
