"""Examples of docs/development/extending-window.md: a feature and a metric in menus, palette, page of keys, window and pictures."""

import sys

import numpy as np
import pytest
import pyvista as pv
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QFileDialog, QLabel

import hexmend_app.features
from hexmend import METRICS, ParameterError, gallery, write
from hexmend.cli.main import main
from hexmend_app.picture import colour_map, from_toml, layer_switch
from hexmend_app.picture.appearance import Structure
from hexmend_app.scene.layers import optional_layer
from hexmend_app.shell.command_palette import command_entries, name_of
from hexmend_app.shell.window import Window
from hexmend_app.state.mesh.document import MeasuredMesh
from scripts.write_keys import as_markdown
from tests.app.driving import named, open_and_wait
from tests.app.features.structure.layers import count
from tests.core.test_extending import write_distribution
from tests.examples import example

EXAMPLE = example("A feature of the viewer")


@pytest.fixture
def add_folder(tmp_path, monkeypatch):
    """Add a folder of a feature with a source text; its modules are forgotten afterwards."""
    monkeypatch.setattr(hexmend_app.features, "__path__", [*hexmend_app.features.__path__, str(tmp_path)])
    added = []

    def add(name, source):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").touch()
        (tmp_path / name / "feature.py").write_text(source, encoding="utf-8")
        added.append(f"hexmend_app.features.{name}")

    yield add
    for name in [name for name in sys.modules if name.startswith(tuple(added))]:
        del sys.modules[name]


@pytest.fixture
def with_folder(qtbot, add_folder):
    """A window with the feature of an additional folder."""
    add_folder("volume", EXAMPLE)
    window = Window()
    window.build_features()
    window.show()
    yield window
    window.close()
    window.deleteLater()


def test_a_feature_is_found_by_its_folder(with_folder, cube):
    window = with_folder
    assert "volume" in window.features
    assert window.action("volume").text() == "&Volume of the mesh"
    assert not window.action("volume").isEnabled()
    assert "| Volume of the mesh | `Ctrl+Shift+V` |" in as_markdown(window.menus.declared())
    window.session.document.replace(MeasuredMesh.of(cube), None)
    window.refresh()
    window.action("volume").trigger()
    assert window.is_visible("volume")
    volume = METRICS["volume"].of(cube.points, cube.hexes, window.session.document.now.quality).sum()
    assert np.isclose(float(window.features["volume"].panel.text().split()[0]), volume)


def test_a_feature_of_another_package_is_found_by_its_entry_point(qtbot, tmp_path, monkeypatch):
    metadata = tmp_path / "volumes-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: volumes\nVersion: 1.0\n")
    entries = "[hexmend.features]\nbroken = volumes:Missing\nvolume = volumes:FeatureVolume\n"
    (metadata / "entry_points.txt").write_text(entries)
    (tmp_path / "volumes.py").write_text(EXAMPLE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    reported = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: reported.append(kind))
    window = Window()
    window.build_features()
    assert reported == [AttributeError]
    assert list(window.features)[-1] == "volume"
    assert window.action("volume").text() == "&Volume of the mesh"
    window.close()
    window.deleteLater()
    monkeypatch.delitem(sys.modules, "volumes")


@pytest.fixture
def with_plotter(add_folder):
    """Add the folder of the feature that draws with PyVista."""
    add_folder("cad_surface", example("Drawing with PyVista"))


@pytest.mark.slow
def test_a_feature_draws_with_pyvista(with_plotter, fresh_window, tmp_path, monkeypatch):
    low, high = np.reshape(fresh_window.canvas.viewport.bounds, (3, 2)).T
    pv.Sphere(radius=np.linalg.norm(high - low) / 2, center=(low + high) / 2).save(tmp_path / "part.stl")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(tmp_path / "part.stl"), ""))
    fresh_window.action("cad").trigger()
    plotter = fresh_window.features["cad_surface"].plotter
    assert {"cad", "arrows"} <= plotter.actors.keys()
    plotter.close()


@pytest.fixture
def cube():
    """A mesh."""
    return gallery.make("cube", size=64)


@pytest.fixture
def with_metric(monkeypatch):
    """Register the metric of the page."""
    monkeypatch.setattr(METRICS, "_entries", dict(METRICS))
    exec(compile(example("A metric"), "extending.md", "exec"), {})


@pytest.mark.slow
def test_a_metric_is_in_the_lists_and_colours_pictures(with_metric, with_folder, tmp_path):
    boxes = [box for box in with_folder.findChildren(QComboBox) if box.accessibleName() == "Metric"]
    assert boxes
    assert all(box.findData("oddy") >= 0 for box in boxes)
    write(tmp_path / "mesh.vtu", gallery.make("cube", size=64, scramble=0.3))
    pictures = []
    for name in ("q", "oddy"):
        path = tmp_path / f"{name}.png"
        words = ["render", str(tmp_path / "mesh.vtu"), "-o", str(path), "--metric", name, "--no-bar"]
        assert main([*words, "--size", "300x200", "--colour-range", "0,1"]) == 0
        pictures.append(np.asarray(Image.open(path).convert("RGB"), float))
    assert np.abs(pictures[0] - pictures[1]).mean() > 5


@pytest.fixture
def with_notes(add_folder):
    """Add the folder of the feature with a state."""
    add_folder("notes", example("State and exports of a feature"))


def _choose_and_write(window, hex, text):
    window.session.selection.choose(hex)
    window.refresh()
    panel = window.features["notes"].panel
    window.show_panel("notes")
    panel.setFocus()
    QTest.keyClicks(panel, text)


@pytest.mark.slow
def test_the_state_of_a_feature_is_in_sessions_and_is_exported(
    with_notes, fresh_window, qtbot, tmp_path, mesh_file, monkeypatch
):
    window = fresh_window
    assert window.action("panel_notes").text().replace("&", "") == "Notes"
    assert "Export notes…" in {name_of(entry) for entry in command_entries(window.window_actions)}
    _choose_and_write(window, 3, "thin")
    _choose_and_write(window, 5, "at the weld")
    session = tmp_path / "work.hexmend"
    assert window.features["save"].save_and_wait(session)
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert window.features["notes"].notes == {}
    open_and_wait(qtbot, window, session)
    window.session.selection.choose(5)
    window.refresh()
    assert window.features["notes"].panel.toPlainText() == "at the weld"
    csv = tmp_path / "notes.csv"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(csv), ""))
    window.action("export_notes").trigger()
    assert csv.read_text(encoding="utf-8").splitlines() == ["hex,note", "3,thin", "5,at the weld"]


def test_features_that_raise_are_reported_and_the_others_are_built(qtbot, add_folder, tmp_path, monkeypatch):
    add_folder("not_importable", "raise RuntimeError('at import')")
    add_folder("broken_package", EXAMPLE)
    (tmp_path / "broken_package" / "__init__.py").write_text("raise LookupError('in the package')", encoding="utf-8")
    source = EXAMPLE.replace("class FeatureVolume", "class FeatureTwice(Feature):\n    pass\n\n\nclass FeatureVolume")
    add_folder("two_classes", source)
    add_folder("no_actions", EXAMPLE.replace("        return (\n", "        return 1 / 0, (\n", 1))
    reported = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: reported.append(kind))
    window = Window()
    window.build_features()
    assert set(reported) >= {RuntimeError, LookupError, TypeError, ZeroDivisionError}
    assert {"smooth", "cut", "histogram", "no_actions"} <= window.features.keys()
    assert "not_importable" not in window.features
    assert window.action("run").text() == "&Run or pause"
    assert "volume" not in window.window_actions
    assert "volume" in window.docks.ids()
    window.close()
    window.deleteLater()


# Examples of docs/development/extending-window.md: a colour map and a layer in window, sessions and pictures.


BOX = "#cc0066"


@pytest.fixture(scope="module")
def distribution(tmp_path_factory):
    """Install a distribution with both examples, in a folder of the path.

    Tests of other modules may run between those of this one, so that the fixture is made more than once a process:
    the modules are imported anew each time, as they register their entries when they are imported.
    """
    site = tmp_path_factory.mktemp("site")
    entries = "[hexmend.colour_maps]\nslate = made_up_map\n[hexmend.layers]\nbounding-box = made_up_layer:BoundingBox\n"
    modules = {"made_up_map": example("A colour map"), "made_up_layer": example("A layer of the 3D view")}
    write_distribution(site, f"{entries}none = made_up_map\n", modules)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(site)
        for registry, load in (
            (colour_map.COLOUR_MAPS, colour_map.load_colour_maps),
            (layer_switch.LAYERS, optional_layer.load_layers),
        ):
            patch.setattr(registry, "_entries", dict(registry))
            for module in modules:
                sys.modules.pop(module, None)
            load()
        yield


@pytest.fixture
def window(distribution, fresh_window):
    """A window with both examples and an open mesh."""
    return fresh_window


@pytest.mark.slow
def test_panel_menu_palette_and_map_box_have_them(window):
    row = window.features["structure"].panel.layers["bounding-box"]
    assert row.box.text() == "Bounding box"
    assert next(label.text() for label in row.entries.findChildren(QLabel)).count("×") == 2
    action = window.action("show_bounding-box")
    assert "Bounding box: off" in {name_of(entry) for entry in command_entries(window.window_actions)}
    assert "| Bounding box | `Ctrl+Shift+B` |" in as_markdown(window.menus.declared())
    action.trigger()
    window.refresh()
    assert row.box.isChecked()
    assert action.isChecked()
    assert window.session.view.look.structure == Structure.of("bounding-box")
    maps = named(window, QComboBox, "Colour map")
    assert maps.itemData(maps.findData("slate"), Qt.ItemDataRole.ToolTipRole) == "From dark blue over grey to cream."


@pytest.mark.slow
def test_commands_and_scenes_have_them(distribution, mesh_file, tmp_path):
    words = ["render", str(mesh_file), "--size", "640x480", "-o"]
    options = ["--structure", "sharp,bounding-box", "--colour-map", "slate"]
    scene = tmp_path / "scene.toml"
    assert main([*words, str(tmp_path / "options.png"), *options, "--save-scene", str(scene)]) == 0
    assert from_toml(scene.read_text()).structure == Structure.of("sharp", "bounding-box")
    assert main([*words, str(tmp_path / "scene.png"), "--scene", str(scene)]) == 0
    images = [np.asarray(Image.open(tmp_path / f"{name}.png").convert("RGB")) for name in ("options", "scene")]
    assert count(images[0], BOX) > 20
    np.testing.assert_array_equal(*images)


def test_an_entry_point_that_registers_nothing_is_left_out(distribution):
    assert "none" not in layer_switch.LAYERS
    assert {"bounding-box", "sharp"} <= set(layer_switch.LAYERS)
    assert {"slate", "viridis"} <= set(colour_map.COLOUR_MAPS)


def test_an_unknown_layer_or_map_is_named_with_the_known_ones():
    with pytest.raises(ParameterError, match="there is no layer 'bounding-bxo'"):
        Structure.of("bounding-bxo")
    with pytest.raises(ParameterError, match="map = 'jet' is unknown: expected one of viridis"):
        from_toml('format = 1\n[colours]\nmap = "jet"\n')
