"""Measurements have distances and an angle."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import ParameterError
from hexmend_app.picture import Scene, from_toml, to_toml
from hexmend_app.picture.appearance import Measurement


def test_distances_and_angle_of_a_right_triangle():
    measurement = Measurement(((3, 0, 0), (0, 0, 0), (0, 4, 0)))
    assert measurement.distances == [3, 4]
    assert measurement.angle == pytest.approx(90)


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


def test_a_scene_file_stores_it():
    scene = Scene(measurement=Measurement(((0.1, 0, 0), (1, 2, 3))))
    text = to_toml(scene)
    assert "[measurement]" in text
    assert from_toml(text) == scene
