"""Saved cameras: naming, applying, deleting, and their use in pictures."""

import pytest
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QInputDialog, QMessageBox

from hexmend_app.picture import Camera, Scene, camera_from, write_scene
from hexmend_app.picture.picture_metadata import read_metadata
from tests.app.driving import open_and_wait, write_picture


@pytest.fixture
def saved(window):
    """Save two cameras; return their poses by name."""
    poses = {}
    for name, direction in (("front & side", "-y"), ("top", "+z")):
        window.canvas.look_along(direction)
        window.features["camera"].keep(name)
        poses[name] = window.canvas.pose
    window.canvas.look_along("iso")
    window.refresh()
    return poses


def entries(menu):
    """Fill a menu as when it is shown, and return its entries by name; of submenus too."""
    menu.aboutToShow.emit()
    parts = (menu, *(one.menu() for one in menu.actions() if one.menu() is not None))
    return [{one.text()[4:].replace("&&", "&"): one for one in part.actions() if one.menu() is None} for part in parts]


def test_a_camera_is_saved_under_a_name_and_replaced_after_a_question(window, monkeypatch):
    cameras, proposed = window.session.saved_cameras, []
    monkeypatch.setattr(QInputDialog, "getText", lambda *arguments: proposed.append(arguments[4]) or (" front ", True))
    first = Camera.at(window.canvas.pose)
    window.action("keep_camera").trigger()
    assert cameras.all == {"front": first}
    window.canvas.look_along("+x")
    for answer in (QMessageBox.StandardButton.No, QMessageBox.StandardButton.Yes):
        monkeypatch.setattr(QMessageBox, "exec", lambda self, answer=answer: answer)
        before = cameras.all
        window.action("keep_camera").trigger()
        assert (cameras.all == before) == (answer == QMessageBox.StandardButton.No)
    assert cameras.all == {"front": Camera.at(window.canvas.pose)}
    assert proposed[0] == "camera 1"
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("never", False))
    window.action("keep_camera").trigger()
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: ("x" * 500, True))
    window.action("keep_camera").trigger()
    assert list(cameras.all) == ["front"]
    assert window.messages.messages()[-1][1] == "Camera not saved"


def test_the_menu_applies_and_deletes_cameras(window, saved):
    menu = window.features["camera"].menu
    go, _ = entries(menu)
    assert [name for name in go if name] == list(saved)
    go["top"].trigger()
    assert window.canvas.pose == saved["top"]
    for name in saved:
        entries(menu)[1][name].trigger()
    assert window.session.saved_cameras.all == {}
    assert not menu.menuAction().isEnabled()


@pytest.mark.slow
def test_scenes_and_pictures_contain_the_cameras(window, saved, tmp_path, qtbot, mesh_file):
    export, cameras = window.features["export"], window.session.saved_cameras
    whole = export.dialog("picture")
    qtbot.addWidget(whole)
    dialog = whole.settings
    dialog.camera.setCurrentText("top")
    assert dialog.scene().camera.pose == saved["top"]
    write_scene(tmp_path / "more.toml", Scene(cameras={"top": Camera("-x"), "left": Camera("-y")}))
    dialog.load(str(tmp_path / "more.toml"))
    assert list(dialog.scene().cameras) == [*saved, "top (2)", "left"]
    assert write_picture(window, tmp_path / "p.png", (200, 150))
    before = dict(cameras.all)
    assert read_metadata(tmp_path / "p.png").scene.cameras == before
    for name in before:
        cameras.remove(name)
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert cameras.all == before
    open_and_wait(qtbot, window, mesh_file)
    assert cameras.all == before


# Copying and pasting the camera.


def test_a_copied_camera_is_pasted_unchanged(window):
    canvas = window.canvas
    canvas.roll(20)
    window.action("parallel").trigger()
    pose = canvas.pose
    window.action("copy_camera").trigger()
    assert camera_from(QGuiApplication.clipboard().text()).pose == pose
    canvas.look_along("+x")
    window.action("parallel").trigger()
    assert canvas.pose != pose
    window.action("paste_camera").trigger()
    assert canvas.pose == pose
