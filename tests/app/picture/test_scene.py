"""A scene and the look of a view have the same tables."""

import math
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import ParameterError, measure
from hexmend_app.picture import Colours, Isolate, LineStyle, Page, Scene, Show
from hexmend_app.picture.appearance import Look, Measurement, Structure
from hexmend_app.picture.cut import Cut, CutKind, CutStyle, proposed_cuts
from hexmend_app.picture.cut_shapes import Depth, DepthUnit, Plane, Slab, Sphere
from hexmend_app.picture.displacement import MENDED, NEWLY_INVALID, STILL_INVALID, Displacement, ReferenceState
from tests.core.boundary.solids import slid
from tests.core.grids import grid, scrambled

MESH = grid(4)


def test_a_scene_contains_the_tables_of_its_look():
    look = Look(
        cut=Cut.at((1, 0, 0), (2, 2, 2)).with_hexes(np.arange(64) % 3 > 0),
        show=Show((0.2, 0.9), isolate=Isolate((3,)), hidden=frozenset({4, 7})),
        structure=Structure.of("sharp"),
        colours=Colours(neutral=True),
        lines=LineStyle(edges=0.0),
        page=Page(shading=False),
    )
    scene = Scene.of(look)
    for field in fields(Look):
        assert getattr(scene, field.name) is getattr(look, field.name)
    assert scene.look(MESH) == look


@pytest.mark.parametrize("look", [
    Look(cut=Cut((Plane(),), hexes="3, 60-64")),
    Look(show=Show(isolate=Isolate((64,)))),
    Look(show=Show(hidden=frozenset({1, 64}))),
])  # fmt: skip
def test_listed_hexes_are_in_the_mesh(look):
    with pytest.raises(ParameterError, match="names hex 64: expected one of the mesh, below 64"):
        Scene.of(look).look(MESH)


def test_a_text_of_too_many_remaining_hexes_is_omitted():
    cut = Cut.at((1, 0, 0), (2, 2, 2)).with_hexes(np.arange(600_000) % 2 == 0)
    assert len(cut.hexes) > 2_000_000
    assert Scene.of(Look(), cut=cut).cut == Scene.of(Look(cut=cut)).cut == cut.with_hexes(None)


# Measurements have distances and an angle.


@given(st.floats(1e-7, 180), st.floats(0.1, 10), st.floats(0.1, 10))
def test_angles_are_precise_however_small(degrees, one, other):
    end = (other * math.cos(math.radians(degrees)), other * math.sin(math.radians(degrees)), 0.0)
    assert Measurement(((one, 0, 0), (0, 0, 0), end)).angle == pytest.approx(degrees, rel=1e-6)


def test_a_fourth_point_begins_a_new_measurement():
    measurement = Measurement()
    for x in range(3):
        measurement = measurement.with_point((x, 0, 0))
    assert len(measurement.points) == 3
    assert measurement.with_point((7, 0, 0)) == Measurement(((7, 0, 0),))
    with pytest.raises(ParameterError, match="points"):
        Measurement(((0, 0, 0),) * 4)


# Slabs, spheres and depths of cuts, as values.


POINTS = st.lists(st.tuples(*[st.floats(-4, 4)] * 3), min_size=1, max_size=30).map(np.array)


@given(POINTS, st.floats(0.1, 5))
def test_a_slab_hides_what_is_farther_from_its_middle_than_half_its_thickness(points, thickness):
    slab = Slab((1, 2, 2), point=(0.5, 0, 0), thickness=thickness)
    distance = np.abs((points - (0.5, 0, 0)) @ np.array([1, 2, 2]) / 3)
    clear = np.abs(distance - thickness / 2) > 1e-9
    outside = Cut(slab=slab).hidden(points)
    np.testing.assert_array_equal(outside[clear], (distance > thickness / 2)[clear])
    inside = Cut(slab=slab, notch=True).hidden(points)
    np.testing.assert_array_equal(inside[clear], ~outside[clear])


def test_fractions_become_coordinates_of_the_mesh():
    mesh = grid(4, 2, 8)
    assert Cut(slab=Slab((0, 0, 2), 0.25, thickness=0.5)).on(mesh).slab == Slab((0, 0, 1), point=(0, 0, 2), thickness=4)
    sphere = Cut(sphere=Sphere((0.5, 0.5, 0.25), 0.5, shares=True)).on(mesh).sphere
    assert (sphere.centre, sphere.radius) == ((2, 1, 2), pytest.approx(0.5 * np.sqrt(4**2 + 2**2 + 8**2)))
    for cut in (Cut(slab=Slab()), Cut(sphere=Sphere(shares=True))):
        assert not cut.absolute
        assert cut.on(mesh).absolute


CONTRADICTIONS = [
    ({"slab": Slab(), "sphere": Sphere()}, "a slab and a sphere: expected one of them"),
    ({"planes": (Plane(),), "depth": Depth()}, "planes and a depth"),
    ({"sphere": Sphere(), "style": CutStyle.SMOOTH}, "a cut by sphere has whole hexes"),
    ({"depth": Depth(), "style": CutStyle.SMOOTH}, "a cut by depth has whole hexes"),
]


@pytest.mark.parametrize(("keys", "message"), CONTRADICTIONS)
def test_contradicting_shapes_are_rejected(keys, message):
    with pytest.raises(ParameterError, match=message):
        Cut(**keys)


INVALID_SHAPES = [
    (lambda: Slab(position=0.5, point=(0, 0, 0)), "the slab has a position and a point"),
    (lambda: Slab((0, 0, 0)), "no direction"),
    (lambda: Slab(thickness=-1.0), "thickness = -1"),
    (lambda: Sphere((0.0, 2.0, 0.0), shares=True), "fractions from 0 to 1"),
    (lambda: Sphere(radius=-1.0), "radius = -1"),
    (lambda: Depth(3, 2), "from 3 to 2: expected the lower number first"),
]


@pytest.mark.parametrize(("make", "message"), INVALID_SHAPES)
def test_invalid_shapes_are_rejected(make, message):
    with pytest.raises(ParameterError, match=message):
        make()


def test_proposed_cuts_lie_in_the_middle_and_keep_normals():
    bounds = np.array([[0.0, 0, 0], [4, 2, 8]])
    before = proposed_cuts(bounds) | {CutKind.SLAB: Cut(slab=Slab((0, 0, 1), point=(0, 0, 0), thickness=5))}
    cuts = proposed_cuts(bounds, before, layers=6)
    assert cuts[CutKind.SLAB].slab == Slab((0, 0, 1), point=(2, 1, 4), thickness=0.1 * 8)
    assert cuts[CutKind.SPHERE].sphere.centre == (2, 1, 4)
    assert cuts[CutKind.DEPTH].depth == Depth(2, 6, DepthUnit.LAYERS)
    assert [cut.kind for cut in cuts.values()] == list(CutKind)


# Cuts list the hexes that they leave, and their planes are normalised.


CUT = Cut.at((1, 0, 0), (2, 2, 2))


@given(st.lists(st.booleans(), min_size=1, max_size=40))
def test_listed_hexes_are_those_of_the_mask(left):
    mask = np.array(left)
    cut = CUT.with_hexes(mask)
    if mask.any():
        np.testing.assert_array_equal(cut.listed(len(mask)), mask)
        assert cut.largest_hex == np.flatnonzero(mask)[-1]
    assert cut.with_hexes(None) == CUT


@pytest.mark.parametrize("hexes", ["3-1", "1, 1", "5, 2", "a", "1-", "0-3, 3"])
def test_invalid_lists_are_rejected(hexes):
    with pytest.raises(ParameterError, match="hexes"):
        Cut(CUT.planes, hexes=hexes)


def test_only_cuts_by_whole_hexes_list_hexes():
    for cut in ({}, {"planes": CUT.planes, "style": CutStyle.SMOOTH}):
        with pytest.raises(ParameterError, match="require a cut by whole hexes"):
            Cut(**cut, hexes="3")


def test_a_moved_plane_lists_no_hexes():
    cut = CUT.with_hexes(np.array([True, False]))
    assert cut.with_plane(0, Plane((0, 1, 0), point=(0, 0, 0))).hexes == ""


# Displacements and changes since a reference state.


BLOCK = grid(5)


def moved(points, before=None):
    then = BLOCK.points if before is None else before
    was = ReferenceState(then, measure(then, BLOCK.hexes), "then")
    return Displacement(BLOCK, was, points, measure(points, BLOCK.hexes))


def test_displacement_of_an_element_is_that_of_its_nodes_in_mean_edge_lengths():
    points = scrambled(BLOCK, 0.7).points
    movement = moved(points)
    lengths = np.linalg.norm(points - BLOCK.points, axis=1)[BLOCK.hexes] / BLOCK.mean_edge_length
    np.testing.assert_allclose(movement.values("moved-most"), lengths.max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(movement.values("moved-mean"), lengths.mean(axis=1), rtol=1e-12)
    assert movement.counts.largest == pytest.approx(lengths.max())


def test_hexes_are_newly_invalid_still_invalid_or_mended_also_those_invalid_inside():
    good, bad = BLOCK.points, scrambled(BLOCK, 0.6).points
    figures = measure(bad, BLOCK.hexes)
    invalid = figures.invalid
    assert figures.n_inverted < invalid.sum() < invalid.size
    assert np.array_equal(moved(bad).validity_changes == NEWLY_INVALID, invalid)
    assert np.array_equal(moved(good, bad).validity_changes == MENDED, invalid)
    assert np.array_equal(moved(bad, bad).validity_changes == STILL_INVALID, invalid)
    assert moved(bad).counts.newly_invalid == moved(good, bad).counts.mended == invalid.sum()
    assert moved(bad).counts.worse == moved(good, bad).counts.better > 0


def test_what_slides_within_a_face_stays_on_the_surface():
    movement = moved(slid(BLOCK, 0.3, seed=1).points)
    assert movement.distances[BLOCK.topology.boundary].max() > 0.2
    assert movement.values("surface-distance").max() < 1e-12
    assert 0 < movement.counts.slid == movement.counts.moved - 64
    assert moved(scrambled(BLOCK, 0.3).points).counts.slid == 0


def test_distance_from_the_surface_is_that_of_boundary_nodes_alone():
    points = BLOCK.points.copy()
    on_face = (points[:, 0] == 0) & ((points[:, 1:] > 0) & (points[:, 1:] < 5)).all(axis=1)
    points[np.flatnonzero(on_face)[0]] += (-0.25, 0.1, 0)  # across the face, and along it
    points[np.flatnonzero(BLOCK.free)[-1]] += 0.3
    movement = moved(points)
    values = movement.values("surface-distance")
    beside = (BLOCK.hexes == np.flatnonzero(on_face)[0]).any(axis=1)
    np.testing.assert_allclose(values[beside], 0.25, rtol=1e-12)
    assert not values[~beside].any()
    assert movement.updated(points, movement.quality).before.skin(BLOCK) is movement.before.skin(BLOCK)
