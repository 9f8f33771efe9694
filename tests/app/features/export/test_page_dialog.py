"""Dialog for the settings and path of an export."""

import pytest
from PIL import Image
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QDialogButtonBox, QLabel, QLineEdit, QMessageBox

from hexmend.errors import ParameterError
from hexmend_app.features.export.page_dialog import PageDialog
from hexmend_app.features.export.picture_settings import PictureSettings
from hexmend_app.picture import Camera, Page, PicturePanel, Scene, read_scene, write_scene
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from tests.app.driving import type_text
from tests.core.grids import grid


@pytest.fixture(autouse=True)
def own_settings(tmp_path):
    for kind in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(kind, QSettings.Scope.UserScope, str(tmp_path / "settings"))


def made(qtbot, scene=None, draw=lambda scene: Image.new("RGB", scene.page.size), views=()):
    scene = Scene(page=Page(pixels=(640, 480))) if scene is None else scene
    dialog = PageDialog([PictureSettings(scene, draw, "bridge.png", views)], "picture")
    qtbot.addWidget(dialog)
    dialog.show()
    return dialog


@pytest.fixture
def dialog(qtbot):
    return made(qtbot)


def write(dialog, path):
    line = next(one for one in dialog.findChildren(QLineEdit) if one.accessibleName() == "File")
    type_text(line, str(path))


def save(dialog):
    dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Save).click()


def said(dialog):
    return [one.text() for one in dialog.findChildren(QLabel) if one.accessibleName() == "Problem" and one.isVisible()]


def type_into(dialog, name, text):
    editor = next(form.editors[name] for _, form in dialog.settings.forms if name in form.editors)
    line = editor if isinstance(editor, QLineEdit) else editor.lineEdit()
    type_text(line, text)


@pytest.mark.parametrize("name", ["p.gif", "p.jpg", "p.v2"])
def test_an_unknown_suffix_is_rejected_with_the_known_ones(dialog, tmp_path, name):
    write(dialog, tmp_path / name)
    save(dialog)
    assert dialog.isVisible()
    assert len(said(dialog)) == 1
    assert name in said(dialog)[0]
    assert "Use .png, .tif, .tiff, .pdf or .svg." in said(dialog)[0]
    write(dialog, tmp_path / "p.png")
    assert said(dialog) == []
    save(dialog)
    assert dialog.result()
    assert dialog.target.path() == tmp_path / "p.png"


@pytest.mark.parametrize("answer", [QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No])
def test_a_file_is_replaced_only_after_confirmation(dialog, tmp_path, monkeypatch, answer):
    monkeypatch.setattr(QMessageBox, "exec", lambda self: answer)
    (tmp_path / "p.png").write_text("another")
    write(dialog, tmp_path / "p")
    save(dialog)
    assert bool(dialog.result()) == (answer == QMessageBox.StandardButton.Yes)


def test_a_size_is_chosen_or_typed_in_millimetres_or_pixels(dialog):
    form = dialog.settings.size_form
    form.size_box.setCurrentIndex(2)
    page = dialog.settings.scene().page
    assert (page.width, page.height, page.dpi) == (170, 106, 300)
    form.dpi.setValue(600)
    assert dialog.settings.scene().page.size == (4016, 2504)
    type_text(form.size_box.lineEdit(), "1920 x 1080 px")
    assert dialog.settings.scene().page.pixels == (1920, 1080)
    assert not form.dpi.isEnabled()
    type_text(form.size_box.lineEdit(), "1920 by 1080")
    assert "expected width × height" in said(dialog)[0]


def test_invalid_values_are_reported_and_not_saved(dialog, tmp_path):
    write(dialog, tmp_path / "p.png")
    type_into(dialog, "ticks", "0, half")
    assert "'0, half' is not a whole number or a list" in said(dialog)[0]
    save(dialog)
    assert dialog.isVisible()
    type_into(dialog, "ticks", "0, 0.5")
    assert said(dialog) == []
    type_into(dialog, "background", "mauve")
    assert "expected white, transparent or #rrggbb" in said(dialog)[0]
    type_into(dialog, "background", "#ff00ff")
    assert dialog.settings.scene().bar.ticks == (0, 0.5)
    assert dialog.settings.scene().page.background == "#ff00ff"


def test_a_scene_is_saved_and_loaded(dialog, tmp_path):
    type_into(dialog, "edges", "0.4")
    dialog.settings.save_scene(str(tmp_path / "scene.toml"))
    assert read_scene(tmp_path / "scene.toml") == dialog.settings.scene()
    other = Scene(camera=Camera("+x"), cameras={"side": Camera("-y")}, page=Page(85, 60, dpi=600))
    write_scene(tmp_path / "other.toml", other)
    dialog.settings.load(str(tmp_path / "other.toml"))
    assert dialog.settings.scene() == other
    dialog.settings.camera.setCurrentText("side")
    assert dialog.settings.scene().camera == Camera("-y")
    (tmp_path / "bad.toml").write_text("[bar]\ntick = 1")
    dialog.settings.load(str(tmp_path / "bad.toml"))
    assert "[bar] has an unknown key 'tick'" in said(dialog)[0]


def test_a_page_too_small_for_its_panels_is_reported(qtbot):
    subject = PageMesh.of(grid(2))
    scene = Scene(panels=(PicturePanel(),) * 12, page=Page(pixels=(64, 30), columns=1))
    with pytest.raises(ParameterError, match="too few for 12 panels"):
        draw_page(scene, [subject])
    dialog = made(qtbot, scene, lambda scene: draw_page(scene, [subject]).image(), [""] * 12)
    qtbot.waitUntil(lambda: bool(said(dialog)))
    assert "too few for 12 panels" in said(dialog)[0]
