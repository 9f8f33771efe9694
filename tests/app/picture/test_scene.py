"""A scene and the look of a view have the same tables."""

import math
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import ParameterError
from hexmend_app.picture import Box, Colours, Cut, Isolate, LineStyle, Page, Plane, Scene, Show, from_toml, to_toml
from hexmend_app.picture.appearance import Look, Measurement, Structure
from tests.core.grids import grid

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


def test_positions_and_shares_become_coordinates_of_the_mesh():
    cut = Cut((Plane((1, 0, 0), 0.25), Plane((0, 2, 0))))
    assert not cut.absolute
    planes = Plane((1, 0, 0), point=(1, 0, 0)), Plane((0, 1, 0), point=(0, 2, 0))
    assert Scene(cut=cut).look(MESH).cut == Cut(planes)
    box = Cut(box=Box((0, 0.25, 0), (1, 1, 0.5), shares=True))
    assert Scene(cut=box).look(MESH).cut == Cut(box=Box((0, 1, 0), (4, 4, 2)))


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
