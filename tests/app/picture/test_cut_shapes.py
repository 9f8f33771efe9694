"""Slabs, spheres and depths of cuts, as values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import ParameterError
from hexmend_app.picture import Box, Cut, CutKind, CutStyle, Depth, DepthUnit, Plane, Slab, Sphere
from hexmend_app.picture.cut import proposed_cuts
from tests.core.grids import grid

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


@given(POINTS, st.floats(0, 5))
def test_a_sphere_hides_what_is_farther_from_its_centre_than_its_radius(points, radius):
    cut = Cut(sphere=Sphere((1, 0, -1), radius))
    distance = np.linalg.norm(points - (1, 0, -1), axis=1)
    clear = np.abs(distance - radius) > 1e-9
    np.testing.assert_array_equal(cut.hidden(points)[clear], (distance > radius)[clear])
    assert (Cut(sphere=cut.sphere, notch=True).hidden(points) != cut.hidden(points)).all()


def test_fractions_become_coordinates_of_the_mesh():
    mesh = grid(4, 2, 8)
    assert Cut(slab=Slab((0, 0, 2), 0.25, thickness=0.5)).on(mesh).slab == Slab((0, 0, 1), point=(0, 0, 2), thickness=4)
    sphere = Cut(sphere=Sphere((0.5, 0.5, 0.25), 0.5, shares=True)).on(mesh).sphere
    assert (sphere.centre, sphere.radius) == ((2, 1, 2), pytest.approx(0.5 * np.sqrt(4**2 + 2**2 + 8**2)))
    for cut in (Cut(slab=Slab()), Cut(sphere=Sphere(shares=True))):
        assert not cut.absolute
        assert cut.on(mesh).absolute


def test_a_moved_slab_keeps_its_thickness():
    slab = Slab((1, 0, 0), point=(1, 2, 3), thickness=0.7)
    assert slab.moved_to(Plane((0, 3, 0), point=(0, 1, 0))) == Slab((0, 1, 0), point=(0, 1, 0), thickness=0.7)
    assert slab.moved_to(slab.middle) == slab


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"slab": Slab(), "sphere": Sphere()}, "a slab and a sphere: expected one of them"),
        ({"planes": (Plane(),), "depth": Depth()}, "planes and a depth"),
        ({"sphere": Sphere(), "style": CutStyle.SMOOTH}, "a cut by sphere has whole hexes"),
        ({"depth": Depth(), "style": CutStyle.SMOOTH}, "a cut by depth has whole hexes"),
    ],
)
def test_contradicting_shapes_are_rejected(keys, message):
    with pytest.raises(ParameterError, match=message):
        Cut(**keys)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Slab(position=0.5, point=(0, 0, 0)), "the slab has a position and a point"),
        (lambda: Slab((0, 0, 0)), "no direction"),
        (lambda: Slab(thickness=-1.0), "thickness = -1"),
        (lambda: Sphere((0.0, 2.0, 0.0), shares=True), "fractions from 0 to 1"),
        (lambda: Sphere(radius=-1.0), "radius = -1"),
        (lambda: Depth(3, 2), "from 3 to 2: expected the lower number first"),
    ],
)
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


def test_the_sides_of_a_box_contain_it():
    box = Box((0, 1, 2), (3, 4, 5))
    corners = np.array(np.meshgrid(*zip(box.low, box.high, strict=True))).reshape(3, -1).T
    for notch, sign in ((False, -1), (True, 1)):
        sides = Cut(box=box, notch=notch).sides
        assert len(sides) == 6
        assert all((sign * side.signed_distance(corners) > 0).all() for side in sides)
