"""Layers of materials: their interfaces, and hexes coloured by material."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.layers.optional.interfaces import MATERIAL_COLOURS, ColourByMaterial, InterfaceLayer
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import INTERFACE
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


def test_visible_faces_have_the_colour_of_their_material(pane):
    layer = ColourByMaterial(pane)
    for keep, count in ((None, 96), (LOW, 2 * 16 + 4 * 8)):
        layer.draw(frame(TWO), keep)
        assert layer.poly.n_cells == count
        low = layer.poly.cell_centers().points[:, 0] < 2 + 1e-9
        for marks, colour in ((low, MATERIAL_COLOURS[0]), (~low, MATERIAL_COLOURS[1])):
            shown = np.asarray(layer.poly.cell_data["colour"])[marks]
            assert (shown == np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)).all()


def test_legends_name_the_materials_and_are_empty_for_one():
    assert InterfaceLayer.legend(ONE) == ColourByMaterial.legend(ONE) == []
    assert InterfaceLayer.legend(TWO) == [(INTERFACE, True, "9 inside")]
    assert [text for _, _, text in ColourByMaterial.legend(TWO)] == ["low", "high"]
    many = ONE.replace(hex_data={"material": np.arange(64) // 4})
    assert ColourByMaterial.legend(many)[-1] == (None, False, "and 6 more")
