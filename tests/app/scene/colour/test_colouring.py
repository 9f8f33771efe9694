"""Colours of hexes."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QLabel

from hexmend.quality import METRICS, measure
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.picture import Colours, Page, Range, Scene
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.colour_map import COLOUR_MAPS, value_maps
from hexmend_app.scene.colour.colouring import INVALID_INSIDE, INVERTED, Colouring, are_invalid, range_label, resolve
from hexmend_app.scene.colour.hex_colours import HexColours
from hexmend_app.scene.colour.material_colours import material_table
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from tests.app.invalid_hexes import INSIDE, THREE, VALID
from tests.app.invalid_hexes import INVERTED as TURNED
from tests.core.grids import grid

NONE = np.zeros(4, bool)
VALUES = np.array([0.9, 0.2, np.nan, 0.4])


def colouring(low, high):
    return Colouring("q(H)", low, high, COLOUR_MAPS["viridis"].table)


@pytest.mark.parametrize("name", value_maps())
def test_a_map_has_256_colours_from_dark_to_light_and_none_near_those_of_invalid_hexes(name):
    colour = COLOUR_MAPS[name].table.astype(int)
    assert colour.shape == (256, 3)
    lightness = colour @ [0.299, 0.587, 0.114]
    assert lightness[-1] > lightness[0] + 50
    for invalid in (INVERTED, INVALID_INSIDE):
        assert np.abs(colour - invalid).sum(axis=1).min() > 60


@pytest.mark.parametrize("name", COLOUR_MAPS)
def test_a_map_is_that_of_matplotlib(name):
    colormaps = pytest.importorskip("matplotlib").colormaps
    np.testing.assert_allclose(COLOUR_MAPS[name].table / 255, colormaps[name](np.arange(256))[:, :3], atol=0.501 / 255)


def test_inverted_hexes_have_a_special_colour_independent_of_their_value():
    got = colouring(0, 1).colours(np.array([0.0, np.nan, 1.0]), np.array([True, True, False]))
    assert got.tolist() == [list(INVERTED), list(INVERTED), COLOUR_MAPS["viridis"].table[255].tolist()]


@pytest.mark.parametrize("metric", ["q", "scaled-jacobian", "material"])
def test_hexes_that_are_invalid_inside_have_a_colour_and_a_count_of_their_own(metric):
    mesh = THREE.replace(hex_data={"material": np.zeros(3, np.int32)})
    colours = HexColours()
    colours.measure(Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(colours=Colours(metric=metric))))
    got = colours.of(np.array([VALID, TURNED, INSIDE]))
    assert [tuple(colour) for colour in got[1:].tolist()] == [INVERTED, INVALID_INSIDE]
    assert are_invalid(got).tolist() == [False, True, True]
    assert colours.special_counts == [("inverted", 1, INVERTED), ("invalid inside", 1, INVALID_INSIDE)]


def test_the_colours_of_invalid_hexes_differ_in_lightness():
    """So that they differ for colour-blind viewers, and in print."""
    dark, light = np.array([INVERTED, INVALID_INSIDE]) @ [0.299, 0.587, 0.114]
    assert light > dark + 60


@pytest.mark.parametrize("name", METRICS)
def test_finite_declared_ranges_are_used(name):
    for mode, declared in (
        (Range.FULL, METRICS[name].full_range),
        (Range.ACCEPTABLE, METRICS[name].acceptable),
    ):
        got = resolve(Colours(metric=name, range=mode), VALUES, NONE)
        assert got.title == METRICS[name].title
        if name == "scaled-jacobian" and mode is Range.FULL:  # lower values are inverted, which has its own colour
            declared = 0.0, 1.0
        assert (got.low, got.high) == (declared if np.isfinite(declared).all() else (0.2, 0.9))


def test_a_range_is_fitted_to_finite_values_of_hexes_that_are_not_inverted():
    fitted = Colours(range=Range.FITTED)
    got = resolve(fitted, VALUES, NONE)
    assert (got.low, got.high) == (0.2, 0.9)
    got = resolve(fitted, VALUES, np.array([False, True, False, False]))
    assert (got.low, got.high) == (0.4, 0.9)
    got = resolve(fitted, VALUES, ~NONE)  # all inverted: better than nothing
    assert (got.low, got.high) == (0.2, 0.9)
    got = resolve(fitted, np.full(4, np.nan), NONE)
    assert (got.low, got.high) == (0, 1)


@pytest.mark.parametrize("value", [0.0, 1.0, -3e9, 1e-200])
def test_equal_values_have_a_colour_from_the_middle(value):
    got = resolve(Colours(range=Range.FITTED), np.full(4, value), NONE)
    assert got.low < got.high
    assert got.colours(np.full(4, value), NONE)[0].tolist() in COLOUR_MAPS["viridis"].table[127:129].tolist()


@pytest.mark.parametrize(("better", "reverse", "dark_is_low"), [
    (1, False, True), (1, True, False), (-1, False, False), (-1, True, True), (0, False, True), (0, True, False),
])  # fmt: skip
def test_the_dark_end_is_the_worst_unless_reversed(monkeypatch, better, reverse, dark_is_low):
    monkeypatch.setattr("hexmend_app.scene.colour.colouring.better", lambda metric: better)
    got = resolve(Colours(reverse=reverse), VALUES, NONE).table
    assert (got[0].sum() < got[-1].sum()) == dark_is_low


@given(st.floats(-1e9, 1e9), st.floats(-1e9, 1e9), st.floats(0, 1))
def test_labels_read_back_within_a_hundredth_of_the_range(low, high, share):
    assume(high - low > 1e-5 * max(abs(low), abs(high), 1e-30))
    value = low + share * (high - low)
    assert abs(float(range_label(value, low, high)) - value) <= 0.01 * (high - low)
    assert range_label(low, low, high) != range_label(high, low, high)


def test_a_few_far_values_do_not_stretch_a_fitted_range():
    values = np.concatenate([np.linspace(1, 2, 996), [3.5, 60, 200, 591]])
    got = resolve(Colours(metric="condition", range=Range.FITTED), values, np.zeros(1000, bool))
    assert got.low == 1.0
    assert 2 <= got.high < 10
    assert got.beyond == (False, True)
    assert got.label(got.high).startswith("≥ ")
    assert got.label(got.low) == "1"
    few = resolve(Colours(metric="condition", range=Range.FITTED), values[:996], np.zeros(996, bool))
    assert (few.low, few.high, few.beyond) == (1.0, 2.0, (False, False))
    rounded = resolve(Colours("q"), np.array([0.5, np.nextafter(1, 2)]), np.zeros(2, bool))
    assert rounded.label(rounded.high) == "1"  # q is at most 1


# Colours of materials in the mesh, in legends of pages and films, and in the list of the window.


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


def test_hexes_have_the_colour_of_their_material():
    colours = measured(TWO)
    table = material_table(2)
    got = colours.of(np.arange(64))
    assert (got[LOW] == table[0]).all()
    assert (got[~LOW] == table[1]).all()
    assert colours.colouring.names == ("low", "a name of a mat…")


def test_thirty_materials_have_different_colours_and_none_is_that_of_inverted_hexes():
    table = material_table(31)
    assert len(np.unique(table[:30], axis=0)) == 30
    assert (table[30] == table[0]).all()
    assert np.abs(table.astype(int) - INVERTED).sum(axis=1).min() > 60


def test_a_page_has_a_legend_with_the_materials():
    scene = Scene(colours=Colours("material"), page=Page(pixels=(700, 400)))
    layout, page = Layout.of(scene, [PageMesh.of(TWO)]), draw_page(scene, [PageMesh.of(TWO)]).image()
    legend = layout.bar_place
    image = page.crop((legend.left, legend.top, legend.left + legend.width, legend.top + legend.height))
    for colour in (*material_table(2), INVERTED):
        assert has(image, colour)


def test_the_window_lists_the_materials_in_place_of_the_gradient(shown):
    bar = ColourBar()
    bar.show_colouring(NAMED)
    shown(bar, 120, 130)
    image = QImage(bar.size(), QImage.Format.Format_RGB32)
    bar.render(image)
    seen = {image.pixelColor(x, y).getRgb()[:3] for x in range(image.width()) for y in range(image.height())}
    assert {tuple(map(int, colour)) for colour in material_table(2)} <= seen
    assert bar.accessibleDescription() == "Materials: low, high"
    assert bar.sizeHint().height() < 200
    bar.show_colouring(replace(NAMED, names=()))
    assert bar.sizeHint().height() == 300


def test_names_that_do_not_fit_are_counted(shown):
    bar = ColourBar()
    names = tuple(f"name {k}" for k in range(40))
    bar.show_colouring(Colouring("Material", 0.0, 39.0, material_table(40), names=names))
    shown(bar, 120, 200)
    rows = next(label.text() for label in bar.findChildren(QLabel) if "name 0" in label.text()).split("<br>")
    assert rows[-1] == f"and {40 - len(rows) + 1} more"
