"""Opening meshes in the window: by menu, drag and drop and the welcome page; errors; cancelling."""

from __future__ import annotations

import shutil
import threading

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from hexmend import gallery, io
from hexmend.io.storage.file_progress import FileAction, file_operation, report
from hexmend_app.features.open.recent_menu import RecentMenu
from hexmend_app.resources import demo_mesh
from hexmend_app.state.settings.recent_files import MAX_RECENT_FILES
from hexmend_app.state.tasks import file_watcher, mesh_opener
from hexmend_app.state.tasks.task import running
from tests.app.driving import LEFT, key, named, open_and_wait, press
from tests.patience import PATIENCE


@pytest.fixture
def recent(window, qtbot, mesh_file):
    """Return the recent files: that of the mesh."""
    open_and_wait(qtbot, window, mesh_file)
    return window.features["open"].recent


@pytest.fixture
def menu(window):
    """Return the menu of recent files."""
    (menu,) = window.findChildren(RecentMenu)
    return menu


def press_in_menu(menu, key):
    """Open a menu and press a letter in it."""
    menu.popup(QPoint(50, 50))
    QTest.keyClick(menu, key)


def test_recent_files_are_listed_once_each_newest_first(window, qtbot, recent, menu, tmp_path, mesh_file):
    assert recent.files() == [mesh_file]
    other = tmp_path / "R&D" / "other.vtu"
    other.parent.mkdir()
    shutil.copy(mesh_file, other)
    open_and_wait(qtbot, window, other)
    open_and_wait(qtbot, window, demo_mesh())
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "nowhere.vtu")
    assert recent.files() == [other, mesh_file]
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE) as ended:
        press_in_menu(menu, Qt.Key.Key_2)
    assert ended.args == [mesh_file]
    assert recent.files() == [mesh_file, other]
    assert menu.isHidden()


@pytest.mark.slow
def test_a_missing_file_is_disabled_and_the_list_can_be_cleared(recent, menu, tmp_path):
    for k in range(MAX_RECENT_FILES + 2):
        recent.add(tmp_path / f"mesh{k}.vtu")
    assert len(recent.files()) == MAX_RECENT_FILES
    menu.popup(QPoint(50, 50))
    missing = menu.actions()[0]
    assert "not found" in missing.text()
    assert not missing.isEnabled()
    QTest.keyClick(menu, Qt.Key.Key_C)
    assert recent.files() == []
    assert not menu.menuAction().isEnabled()


@pytest.mark.slow
def test_the_welcome_page_opens_recent_files(window, recent, qtbot, mesh_file):
    welcome = window.features["open"].welcome
    assert not welcome.isVisible()
    welcome.show()
    link = next(b for b in welcome.findChildren(QPushButton) if mesh_file.name in b.text())
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        QTest.mouseClick(link, LEFT)


def test_a_dropped_file_is_opened(window, qtbot, tmp_path):
    io.write(tmp_path / "five.mesh", gallery.make("five-side", size=500))
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(tmp_path / "five.mesh"))])
    drag = Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier
    entered, dropped = QDragEnterEvent(QPoint(50, 50), *drag), QDropEvent(QPointF(50, 50), *drag)
    QApplication.sendEvent(window, entered)
    assert entered.isAccepted()
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        QApplication.sendEvent(window, dropped)
    window.refresh()
    assert window.windowTitle().startswith("five.mesh")


@pytest.mark.slow
def test_a_dropped_folder_of_a_case_is_opened_and_saved(window, qtbot, tmp_path):
    mesh = gallery.make("five-side", size=500)
    io.write(tmp_path / "case" / "case.foam", mesh)
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(tmp_path / "case"))])
    drag = Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier
    entered, dropped = QDragEnterEvent(QPoint(50, 50), *drag), QDropEvent(QPointF(50, 50), *drag)
    QApplication.sendEvent(window, entered)
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        QApplication.sendEvent(window, dropped)
    window.refresh()
    assert window.windowTitle().startswith("case")
    (tmp_path / "case/system").mkdir()
    (tmp_path / "copy").mkdir()
    with qtbot.waitSignal(window.session.saver.ended, timeout=PATIENCE):
        window.session.commands.save_in_background(tmp_path / "copy" / "copy.foam")
    assert (tmp_path / "copy/system").is_dir()
    assert io.read(tmp_path / "copy").n_hexes == mesh.n_hexes


def test_an_unreadable_file_shows_an_error_and_the_open_mesh_stays(window, qtbot, tmp_path):
    bad = tmp_path / "cut.vtk"
    bad.write_text("# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0\n")
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(bad)
    assert window.session.document.now is now
    ((kind, title, text),) = window.messages.messages()
    assert kind == "error"
    assert "cut.vtk" in title
    assert "POINTS ends after 1 of 8 rows" in text
    assert "bridge.vtu stays open" in text
    assert window.messages.isVisible()
    key(window, Qt.Key.Key_Escape)
    assert not window.messages.isVisible()


# Cancelling


@pytest.fixture
def slow_read(monkeypatch):
    """Block reading until the yielded event is set."""
    proceed, read = threading.Event(), mesh_opener.read

    def blocked_read(path):
        proceed.wait(PATIENCE / 1000)
        return read(path)

    monkeypatch.setattr(mesh_opener, "read", blocked_read)
    yield proceed
    proceed.set()


def finish_reading(qtbot, slow_read):
    """Unblock all files that are being read, also cancelled ones, and wait for them."""
    slow_read.set()
    qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()), timeout=PATIENCE)


@pytest.mark.slow
@pytest.mark.parametrize("by", ["button", "Esc"])
def test_opening_shows_its_progress_and_is_cancelled(window, qtbot, recent, slow_read, mesh_file, tmp_path, by):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    before = window.session.document.now
    window.session.selection.choose(3)
    window.features["open"].open(other)
    assert window.busy.isVisible()
    assert "Reading slow.vtu" in window.busy.text()
    if by == "button":
        press(named(window.busy, QPushButton, "Cancel"))
    else:
        key(window, Qt.Key.Key_Escape)
    assert not window.session.opener.busy
    assert not window.busy.isVisible()
    assert window.session.selection.hex == 3  # Esc cancelled the opening only
    assert "Opening slow.vtu was cancelled" in window.messages.messages()[-1][1]
    finish_reading(qtbot, slow_read)
    assert window.session.document.now is before
    assert recent.files() == [mesh_file]
    open_and_wait(qtbot, window, other)
    assert window.session.document.name == "slow.vtu"


@pytest.mark.slow
def test_another_mesh_is_opened_while_a_cancelled_file_is_still_read(window, qtbot, slow_read, mesh_file, tmp_path):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    window.features["open"].open(other)
    window.session.opener.cancel()
    window.features["open"].open(mesh_file)
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE) as ended:
        slow_read.set()
    assert ended.args == [mesh_file]
    finish_reading(qtbot, slow_read)
    assert window.session.document.name == mesh_file.name


@pytest.mark.slow
def test_a_cancelled_file_is_read_no_further(window, qtbot, monkeypatch, mesh_file, tmp_path):
    """The thread ends although the file would take for ever."""
    monkeypatch.setattr(file_watcher, "INTERVAL", 0.0)
    failed = threading.Event()

    def endless_read(path):
        with file_operation(path, FileAction.READING):
            while not failed.wait(0.01):
                report(0.4)

    monkeypatch.setattr(mesh_opener, "read", endless_read)
    before = window.session.document.now
    window.features["open"].open(tmp_path / "endless.vtu")
    qtbot.waitUntil(lambda: window.busy.text().startswith("Reading endless.vtu: 40%"), timeout=PATIENCE)
    press(named(window.busy, QPushButton, "Cancel"))
    try:
        qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()), timeout=PATIENCE)
    finally:
        failed.set()  # otherwise the thread would be left
    assert window.session.document.now is before
    assert "Opening endless.vtu was cancelled" in window.messages.messages()[-1][1]
    assert not any("cannot be opened" in title for title, *_ in window.messages.messages())
