"""Distances of boundaries against brute force and known values."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import Cells, MeshError
from hexmend.boundary import SkinSurface, boundary_of, mutual_distances, surface_change
from tests.core.boundary.solids import cylinder, wavy
from tests.core.boundary.test_surface import brute
from tests.core.grids import grid


def skin(mesh):
    return SkinSurface(mesh.points, mesh.topology.boundary_faces)


@settings(max_examples=5)
@given(st.integers(0, 999), st.floats(0, 0.4))
def test_distances_are_those_of_brute_force(seed, height):
    before = grid(1)
    after = wavy(before, height, seed)
    old, new = skin(before), skin(after)
    for one, other, found in zip((old, new), (new, old), mutual_distances(old, new), strict=True):
        quads = other.points[other.faces]
        pieces = [[a, b, quad.mean(axis=0)] for quad in quads for a, b in zip(quad, np.roll(quad, -1, 0), strict=True)]
        samples = one.samples()
        assert len(samples) == 8 + 12 + 6
        expected = [min(np.linalg.norm(brute(piece, x) - x) for piece in pieces) for x in samples]
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_nothing_has_changed_where_nothing_moved():
    mesh = wavy(grid(4), 0.2)
    change = surface_change(mesh, mesh)
    assert change.max < 1e-14
    assert change.moved == 0
    assert change.volume_change == 0
    assert change.features == change.features_kept > 0
    inside = surface_change(mesh, mesh.with_points(mesh.points + 0.1 * mesh.free[:, None]))
    assert inside.to_dict() == change.to_dict()
    edges = f"; {change.features} of {change.features} sharp edges are kept."
    assert change.sentence == f"The boundary could slide, but none of its nodes moved: it has kept its shape{edges}"
    smooth = replace(change, features=0, moved=3, max_distance=1e-15, volume_change=-1e-16)
    assert smooth.sentence == "The boundary slid: 3 of its nodes moved; it has kept its shape."
    assert replace(smooth, reference="new.stl").sentence.endswith("moved; it is on new.stl.")
    assert replace(smooth, volume_change=-0.01).sentence.endswith("; its volume changed by -1 %.")


@given(st.floats(0.01, 0.4))
def test_a_box_that_is_shifted_along_an_axis_is_as_far_away(shift):
    mesh = grid(3)
    change = surface_change(mesh, mesh.with_points(mesh.points + [shift, 0, 0]))
    assert change.max_distance == pytest.approx(shift, rel=1e-12)
    assert 0 < change.mean_distance < shift
    assert change.max == pytest.approx(shift / mesh.mean_edge_length)
    assert change.max_percent_of_diagonal == pytest.approx(100 * shift / np.sqrt(27))
    assert change.volume_change == pytest.approx(0, abs=1e-12)
    assert change.moved == 56


def test_features_that_are_gone_are_not_counted_as_kept():
    mesh = cylinder(32, 5)
    change = surface_change(mesh, mesh.with_points(mesh.points * [1, 1, 0.4] + [0, 0, 1]))
    assert change.features == change.features_kept == 64
    dome = mesh.points.copy()
    radius = np.linalg.norm(dome[:, :2], axis=1)
    dome[:, 2] *= np.sqrt(np.maximum(1 - radius**2, 0)) * 0.9 + 0.1
    gone = surface_change(mesh, mesh.with_points(dome))
    assert 32 <= gone.features_kept < gone.features == 64


@pytest.mark.parametrize("name", ["block", "cap", "hanger_stresstest"])
def test_published_pairs_are_as_far_apart_as_published(name, real_mesh):
    from hexmend.io import read

    published = {"block": 0.41, "cap": 1.06, "hanger_stresstest": 0.24}
    change = surface_change(*(read(real_mesh(f"{name}_{which}.mesh")) for which in ("in", "out")))
    assert change.max_percent_of_diagonal == pytest.approx(published[name], rel=0.08)


def test_different_meshes_are_refused():
    with pytest.raises(MeshError, match="8 and 27 hexes"):
        surface_change(grid(2), grid(3))


def test_a_ridge_that_a_file_marks_on_a_flat_face_is_no_feature_that_could_be_lost():
    mesh = grid(3)
    flat = np.flatnonzero((mesh.points[:, 2] == 3) & (mesh.points[:, 1] == 1))
    line = Cells("line", np.stack([flat[:-1], flat[1:]], axis=1), {"medit:ridge": np.ones(3, np.int64)})
    marked = mesh.replace(cells=(line,))
    assert len(boundary_of(marked).segments) == len(boundary_of(mesh).segments) + 3
    assert surface_change(marked, marked).features == surface_change(mesh, mesh).features == 36


def test_an_edge_at_the_very_angle_is_no_feature_though_a_file_marks_it():
    mesh = grid(3)
    edge = np.flatnonzero((mesh.points[:, 2] == 3) & (mesh.points[:, 1] == 0))
    line = Cells("line", np.stack([edge[:-1], edge[1:]], axis=1), {"medit:ridge": np.ones(3, np.int64)})
    marked = mesh.replace(cells=(line,))
    assert len(boundary_of(marked, 90.0).segments) == 3
    assert surface_change(marked, marked, 90.0).features == 0
    assert surface_change(marked, marked, 89.999).features == 36
