"""The dialog that asks where a picture goes."""

import pytest
from PySide6.QtCore import QSettings, QSize
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox, QLabel, QLineEdit, QMessageBox

from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.widgets.questions import folder, remember_folder


@pytest.fixture(autouse=True)
def own_settings(tmp_path):
    for kind in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(kind, QSettings.Scope.UserScope, str(tmp_path / "settings"))


@pytest.fixture
def dialog(qtbot):
    dialog = PictureDialog(QSize(640, 480), "bridge.png")
    qtbot.addWidget(dialog)
    dialog.show()
    return dialog


def write(dialog, path):
    line = dialog.findChild(QLineEdit)
    line.selectAll()
    QTest.keyClicks(line, str(path))


def save(dialog):
    dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Save).click()


def said(dialog):
    return [
        one.text() for one in dialog.findChildren(QLabel) if one.accessibleName() == "What is wrong" and one.isVisible()
    ]


@pytest.mark.parametrize("name", ["p.gif", "p.jpg", "p.v2"])
def test_a_suffix_that_cannot_be_written_is_refused_with_what_can(dialog, tmp_path, name):
    write(dialog, tmp_path / name)
    save(dialog)
    assert dialog.isVisible()
    assert len(said(dialog)) == 1
    assert name in said(dialog)[0]
    assert "Use .png," in said(dialog)[0]
    write(dialog, tmp_path / "p.png")
    assert said(dialog) == []
    save(dialog)
    assert dialog.result()
    assert dialog.path() == tmp_path / "p.png"


def test_a_name_without_a_suffix_gets_one(dialog, tmp_path):
    write(dialog, tmp_path / "p")
    save(dialog)
    assert dialog.result()
    assert dialog.path() == tmp_path / "p.png"


def test_no_name_is_no_file(dialog):
    dialog.findChild(QLineEdit).clear()
    save(dialog)
    assert dialog.isVisible()
    assert said(dialog)


@pytest.mark.parametrize("answer", [QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No])
def test_a_file_is_replaced_only_when_that_is_meant(dialog, tmp_path, monkeypatch, answer):
    monkeypatch.setattr(QMessageBox, "exec", lambda self: answer)
    (tmp_path / "p.png").write_text("another")
    write(dialog, tmp_path / "p")
    save(dialog)
    assert bool(dialog.result()) == (answer == QMessageBox.StandardButton.Yes)


def test_it_begins_in_the_folder_of_the_other_dialogs_and_they_go_on_in_its(dialog, qtbot, tmp_path):
    (tmp_path / "pictures").mkdir()
    write(dialog, tmp_path / "pictures" / "p.png")
    save(dialog)
    assert folder() == tmp_path / "pictures"
    remember_folder(tmp_path / "mesh.vtu")
    another = PictureDialog(QSize(640, 480), "bridge.png")
    qtbot.addWidget(another)
    assert another.path() == tmp_path / "bridge.png"
