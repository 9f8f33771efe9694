"""Colours of materials in the mesh, in legends of pages and films, and in the list of the window."""

import numpy as np
import pytest
from PySide6.QtGui import QImage

from hexmend.quality import measure
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.canvas.name_list import NameList
from hexmend_app.picture import ColourBarStyle, Colours, Page, Scene, TextPlace
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.colour.colouring import INVERTED, resolve
from hexmend_app.scene.colour.hex_colours import HexColours
from hexmend_app.scene.colour.material_colours import material_table
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from hexmend_app.scene.views.frame import Frame
from tests.core.grids import grid

ONE = grid(4)
LOW = ONE.points[ONE.hexes].mean(axis=1)[:, 0] < 2
TWO = ONE.replace(hex_sets={"low": np.flatnonzero(LOW), "a name of a material": np.flatnonzero(~LOW)})
NAMED = resolve(Colours("material"), np.zeros(64), np.zeros(64, bool), names=("low", "high"))


def measured(mesh):
    colours = HexColours()
    colours.measure(Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(colours=Colours("material"))))
    return colours


def has(image, colour):
    return (np.asarray(image.convert("RGB")) == np.asarray(colour)).all(axis=2).sum() > 20


def test_hexes_have_the_colour_of_their_material_and_inverted_ones_magenta():
    colours = measured(TWO)
    table = material_table(2)
    got = colours.of(np.arange(64))
    assert (got[LOW] == table[0]).all()
    assert (got[~LOW] == table[1]).all()
    assert colours.colouring.names == ("low", "a name of a mat…")
    inverted = colours.colouring.colours(np.zeros(1), np.ones(1, bool))
    assert tuple(inverted[0]) == INVERTED


def test_thirty_materials_have_different_colours_and_none_is_that_of_inverted_hexes():
    table = material_table(31)
    assert len(np.unique(table[:30], axis=0)) == 30
    assert (table[30] == table[0]).all()
    assert np.abs(table.astype(int) - INVERTED).sum(axis=1).min() > 60


@pytest.mark.parametrize("place", [TextPlace.BELOW, TextPlace.RIGHT])
def test_a_page_has_a_legend_with_the_materials(place):
    scene = Scene(colours=Colours("material"), bar=ColourBarStyle(place), page=Page(pixels=(700, 400)))
    layout, page = Layout.of(scene, [PageMesh.of(TWO)]), draw_page(scene, [PageMesh.of(TWO)]).image()
    legend = layout.bar_place
    image = page.crop((legend.left, legend.top, legend.left + legend.width, legend.top + legend.height))
    for colour in (*material_table(2), INVERTED):
        assert has(image, colour)


def test_the_window_lists_the_materials_in_place_of_the_gradient(shown):
    bar = ColourBar()
    bar.set_table(NAMED.table)
    bar.set_names(NAMED.names)
    shown(bar, 120, 130)
    image = QImage(bar.size(), QImage.Format.Format_RGB32)
    bar.render(image)
    seen = {image.pixelColor(x, y).getRgb()[:3] for x in range(image.width()) for y in range(image.height())}
    assert {tuple(map(int, colour)) for colour in material_table(2)} <= seen
    assert bar.accessibleDescription() == "Materials: low, high"
    assert bar.sizeHint().height() < 200
    bar.set_names(())
    assert bar.sizeHint().height() == 300


def test_names_that_do_not_fit_are_counted(shown):
    bar = ColourBar()
    names = tuple(f"name {k}" for k in range(40))
    bar.set_table(material_table(40))
    bar.set_names(names)
    shown(bar, 120, 200)
    rows = bar.findChild(NameList).rows()
    assert rows[0] == "name 0"
    assert rows[-1] == f"and {40 - len(rows) + 1} more"
