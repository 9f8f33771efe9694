"""A scene and the look of a view have the same tables."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from hexmend.errors import ParameterError
from hexmend_app.picture import Box, Colours, Cut, Isolate, LineStyle, Page, Plane, Scene, Show
from hexmend_app.picture.appearance import Look, Structure
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
