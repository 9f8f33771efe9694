"""`mesh.plot`: the viewer's colours in PyVista, drawn off screen and compared with a table of colours by pixels."""

import importlib.metadata
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import hexmend as hx
from hexmend.errors import HexmendError, MeshError, ParameterError
from hexmend_app.notebook import view
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.scene.colour.colouring import INVALID_INSIDE, INVERTED
from hexmend_app.scene.render.graphics import GraphicsError, prepare_off_screen
from tests.app.invalid_hexes import THREE

MESH = hx.gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1)


@pytest.fixture(autouse=True)
def installed(monkeypatch):
    """Let the entry points be those of this tree, whatever is installed."""
    prepare_off_screen()
    entries = {name: SimpleNamespace(load=lambda name=name: getattr(view, name)) for name in ("plot", "view")}
    real = importlib.metadata.entry_points

    def entry_points(**chosen):
        if chosen.get("group") == "hexmend.pictures":
            return [entries[chosen["name"]]] if chosen["name"] in entries else []
        return real(**chosen)

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)


def table_of(plotter):
    """Return the lookup table and the surface of the mesh in a plotter."""
    mapper = plotter.actors["mesh"].mapper
    return mapper.lookup_table, mapper.dataset


@pytest.mark.parametrize(("metric", "ends"), [("q", (0, 1)), ("scaled_jacobian", (0, 1)), ("skew", (0, 1))])
def test_hexes_have_the_colours_of_the_viewer(metric, ends):
    plotter = MESH.plot(metric, show=False, off_screen=True)
    table, skin = table_of(plotter)
    assert table.scalar_range == ends
    worst = ends[0] if hx.METRICS[metric.replace("_", "-")].better > 0 else ends[1]
    expected = COLOUR_MAPS["viridis"].table[[0, -1]]
    ends_of_map = [255 * np.array(table.map_value(value)[:3]) for value in (worst, sum(ends) - worst)]
    np.testing.assert_allclose(ends_of_map, expected, atol=1)
    values = skin.active_scalars
    assert tuple(round(255 * part) for part in table.map_value(np.nan)[:3]) == INVERTED
    assert 0 < np.count_nonzero(np.isnan(values)) < len(values)
    plotter.close()


def test_hexes_that_are_invalid_inside_have_a_colour_and_a_name_of_their_own():
    plotter = THREE.plot(show=False, off_screen=True)
    table, skin = table_of(plotter)
    (bar,) = plotter.scalar_bars.values()
    colours = [tuple(round(255 * part) for part in table.map_value(value)[:3]) for value in skin.active_scalars]
    assert (colours.count(INVERTED), colours.count(INVALID_INSIDE), len(colours)) == (6, 6, 18)
    assert (bar.GetNanAnnotation(), bar.GetBelowRangeAnnotation()) == ("inverted", "invalid inside")
    assert bar.GetDrawBelowRangeSwatch()
    plotter.close()


def test_a_region_is_drawn_alone_and_saved(tmp_path):
    file = tmp_path / "mesh.png"
    MESH.plot(hexes=MESH.region("inverted"), off_screen=True, screenshot=file, window_size=[300, 200])
    with Image.open(file) as image:
        pixels = np.asarray(image.convert("RGB")).reshape(-1, 3).astype(int)
    assert len(pixels) == 300 * 200
    red, green, blue = pixels.T
    magenta = (red > 2 * green) & (blue > 1.5 * green) & (red > 80)
    coloured = np.ptp(pixels, axis=1) > 60
    assert magenta.sum() > 1000
    left = coloured.reshape(200, 300)[:, :240]  # the bar is to the right
    assert (magenta.reshape(200, 300)[:, :240] & left).sum() > 0.9 * left.sum()


def test_what_cannot_be_shown_is_refused(monkeypatch):
    with pytest.raises(ParameterError, match="there is no metric 'skw': did you mean skew"):
        MESH.plot("skw", show=False, off_screen=True)
    with pytest.raises(MeshError, match="there are no hexes to show"):
        MESH.plot(hexes=[], show=False, off_screen=True)
    monkeypatch.setattr(view, "_has_display", lambda: False)
    with pytest.raises(GraphicsError, match="there is no display to open a window on: save a picture"):
        MESH.plot()


def test_without_a_display_a_picture_is_saved_nevertheless(monkeypatch, tmp_path):
    monkeypatch.setattr(view, "_has_display", lambda: False)
    MESH.plot(screenshot=tmp_path / "mesh.png", window_size=[200, 100])
    with Image.open(tmp_path / "mesh.png") as image:
        assert image.size == (200, 100)


def test_without_the_viewer_the_extra_to_install_is_named(monkeypatch):
    monkeypatch.setattr(importlib.metadata, "entry_points", lambda **chosen: [])
    with pytest.raises(
        HexmendError, match=r"the viewer, which draws meshes, is not installed: run  pip install '\.\[app\]'"
    ):
        MESH.plot()
