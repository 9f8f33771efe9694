"""Cuts list the hexes that they leave, and their planes are normalised."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import ParameterError
from hexmend_app.picture import Box, Cut, CutStyle, Plane

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
