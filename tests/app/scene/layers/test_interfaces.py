"""Layer of the interfaces between materials."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.layers.optional.interfaces import InterfaceLayer
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from tests.core.grids import grid

ONE = grid(4)
LOW = ONE.points[ONE.hexes].mean(axis=1)[:, 0] < 2
TWO = ONE.replace(hex_sets={"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)})


@pytest.fixture
def pane():
    stage = Stage((120, 90))
    yield Pane(stage.window)
    stage.close()


def frame(mesh):
    return Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(structure=Structure()), original=None)


def test_interfaces_are_the_faces_between_materials_at_shown_hexes(pane):
    layer = InterfaceLayer(pane)
    layer.draw(frame(TWO), None)
    assert layer.shown
    assert layer.poly.n_cells == 16
    assert (layer.places[:, 0] == 2).all()
    layer.draw(frame(TWO), TWO.points[TWO.hexes].mean(axis=1)[:, 2] < 1)
    assert layer.poly.n_cells == 4
    layer.draw(frame(ONE), None)
    assert not layer.shown


def test_an_unchanged_interface_is_not_built_again_and_moves_with_its_nodes(pane):
    layer = InterfaceLayer(pane)
    layer.draw(frame(TWO), None)
    poly = layer.poly
    layer.draw(frame(TWO), None)
    assert layer.poly is poly
    layer.draw(frame(TWO.with_points(TWO.points + 1)), None)
    assert (layer.places[:, 0] == 3).all()
