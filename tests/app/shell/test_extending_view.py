"""Examples of docs/development/extending-window.md: a colour map and a layer in window, sessions and pictures."""

import sys
from importlib import import_module

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QLabel

from hexmend.cli.main import main
from hexmend.errors import ParameterError
from hexmend_app.picture import colour_map, from_toml, layer_switch
from hexmend_app.picture.appearance import Structure
from hexmend_app.scene.layers import optional_layer
from hexmend_app.shell.keys import as_markdown
from hexmend_app.shell.palette.palette_entries import command_entries
from tests.app.driving import named
from tests.app.features.structure.layers import count
from tests.examples import example

BOX = "#cc0066"


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Register both examples from files in additional folders.

    Tests of other modules may run between those of this one, so that the fixture is made more than once a process:
    the modules are imported anew each time, as they register their entries when they are imported.
    """
    folder = tmp_path_factory.mktemp("additions")
    with pytest.MonkeyPatch.context() as patch:
        for package, title, registry, load in (
            ("hexmend_app.picture.colour_maps", "A colour map", colour_map.COLOUR_MAPS, colour_map.load_colour_maps),
            ("hexmend_app.scene.layers.optional", "A layer of the 3D view", layer_switch.LAYERS,
             optional_layer.load_layers),
        ):  # fmt: skip
            own = folder / package
            own.mkdir()
            (own / "made_up.py").write_text(example(title), encoding="utf-8")
            patch.setattr(registry, "_entries", dict(registry))
            sys.modules.pop(f"{package}.made_up", None)
            patch.setattr(import_module(package), "__path__", [*import_module(package).__path__, str(own)])
            load()
        yield


@pytest.fixture
def window(files, fresh_window):
    """A window with both examples and an open mesh."""
    return fresh_window


@pytest.mark.slow
def test_panel_menu_palette_and_map_box_have_them(window):
    row = window.features["structure"].panel.layers["bounding-box"]
    assert row.box.text() == "Bounding box"
    assert next(label.text() for label in row.entries.findChildren(QLabel)).count("×") == 2
    action = window.action("show_bounding-box")
    assert "Bounding box: off" in {entry.name for entry in command_entries(window.window_actions)}
    assert "| Bounding box | `Ctrl+Shift+B` |" in as_markdown(window.menus.declared())
    action.trigger()
    window.refresh()
    assert row.box.isChecked()
    assert action.isChecked()
    assert window.session.view.look.structure == Structure.of("bounding-box")
    maps = named(window, QComboBox, "Colour map")
    assert maps.itemData(maps.findData("slate"), Qt.ItemDataRole.ToolTipRole) == "From dark blue over grey to cream."


@pytest.mark.slow
def test_commands_and_scenes_have_them(files, mesh_file, tmp_path):
    words = ["render", str(mesh_file), "--size", "640x480", "-o"]
    options = ["--structure", "sharp,bounding-box", "--colour-map", "slate"]
    scene = tmp_path / "scene.toml"
    assert main([*words, str(tmp_path / "options.png"), *options, "--save-scene", str(scene)]) == 0
    assert from_toml(scene.read_text()).structure == Structure.of("sharp", "bounding-box")
    assert main([*words, str(tmp_path / "scene.png"), "--scene", str(scene)]) == 0
    images = [np.asarray(Image.open(tmp_path / f"{name}.png").convert("RGB")) for name in ("options", "scene")]
    assert count(images[0], BOX) > 20
    np.testing.assert_array_equal(*images)


def test_an_unknown_layer_or_map_is_named_with_the_known_ones():
    with pytest.raises(ParameterError, match="there is no layer 'bounding-bxo'"):
        Structure.of("bounding-bxo")
    with pytest.raises(ParameterError, match="map = 'jet' is unknown: expected one of viridis"):
        from_toml('format = 1\n[colours]\nmap = "jet"\n')
