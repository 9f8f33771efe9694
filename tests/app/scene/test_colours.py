"""Colours of elements."""

import numpy as np
import pytest

from hexmend_app.scene.colours import INVERTED, MAPS, colours, table


@pytest.mark.parametrize("name", MAPS)
def test_a_map_has_256_colours_from_dark_to_light_and_none_near_the_inverted(name):
    colour = table(name).astype(int)
    assert colour.shape == (256, 3)
    lightness = colour @ [0.299, 0.587, 0.114]
    assert lightness[-1] > lightness[0] + 50
    assert np.abs(colour - INVERTED).sum(axis=1).min() > 60


def test_ends_beyond_and_between():
    got = colours(np.array([-1, 0.2, 0.8, 2]), np.zeros(4, bool), (0.2, 0.8), "viridis")
    np.testing.assert_array_equal(got, table("viridis")[[0, 0, 255, 255]])


def test_inverted_elements_have_their_own_colour_whatever_their_value():
    got = colours(np.array([0.0, 0.5, 1.0]), np.array([True, True, False]), (0, 1), "viridis")
    assert got.tolist() == [list(INVERTED), list(INVERTED), table("viridis")[255].tolist()]


def test_an_empty_range_is_no_error():
    assert colours(np.array([0.1, 0.9]), np.zeros(2, bool), (0.5, 0.5), "viridis").shape == (2, 3)


def test_an_unknown_map_is_said():
    with pytest.raises(KeyError, match="no colour map"):
        table("jet")
