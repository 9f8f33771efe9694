"""Layer of the interfaces between materials."""

import numpy as np
import pytest

from hexmend_app.scene.layers.optional.interfaces import InterfaceLayer
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.pane import Pane
from tests.app.scene.showing import frame_of
from tests.core.grids import grid

ONE = grid(4)
LOW = ONE.points[ONE.hexes].mean(axis=1)[:, 0] < 2
TWO = ONE.replace(hex_sets={"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)})


@pytest.fixture
def layer():
    with Stage((120, 90)) as stage:
        yield InterfaceLayer(Pane(stage.window))


def test_interfaces_are_the_faces_between_materials_at_shown_hexes(layer):
    layer.draw(frame_of(TWO), None)
    assert layer.shown
    assert layer.poly.n_cells == 16
    assert (layer.places[:, 0] == 2).all()
    layer.draw(frame_of(TWO), TWO.points[TWO.hexes].mean(axis=1)[:, 2] < 1)
    assert layer.poly.n_cells == 4
    layer.draw(frame_of(ONE), None)
    assert not layer.shown


def test_an_unchanged_interface_is_not_built_again_and_moves_with_its_nodes(layer):
    layer.draw(frame_of(TWO), None)
    poly = layer.poly
    layer.draw(frame_of(TWO), None)
    assert layer.poly is poly
    layer.draw(frame_of(TWO.with_points(TWO.points + 1)), None)
    assert (layer.places[:, 0] == 3).all()
