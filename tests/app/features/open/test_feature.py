"""Opening meshes in the window: by menu, drag and drop and the welcome page; errors; cancelling."""

import shutil
import threading

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from hexmend import Mesh, gallery, io
from hexmend.gallery import make
from hexmend.io.storage.file_progress import FileAction, file_operation, report
from hexmend_app.features.open.recent_menu import RecentMenu
from hexmend_app.features.open.welcome import card
from hexmend_app.resources import demo_mesh
from hexmend_app.state.mesh.document import State
from hexmend_app.state.settings.recent_files import MAX_RECENT_FILES
from hexmend_app.state.tasks import file_watcher, mesh_opener
from hexmend_app.state.tasks.task import running
from tests.app.driving import LEFT, key, named, open_and_wait, press
from tests.app.invalid_hexes import INSIDE, THREE
from tests.core.smoothers.mend.test_mend import with_locked_corner
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


@pytest.mark.slow
def test_recent_files_are_listed_once_each_newest_first(window, qtbot, recent, menu, tmp_path, mesh_file):
    assert recent.files() == [mesh_file]
    other = tmp_path / "R&D" / "other.vtu"
    other.parent.mkdir()
    shutil.copy(mesh_file, other)
    open_and_wait(qtbot, window, other)
    open_and_wait(qtbot, window, demo_mesh())
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(tmp_path / "nowhere.vtu")
    assert recent.files() == [other, mesh_file]
    with qtbot.waitSignal(window.session.opener.ended) as ended:
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
    with qtbot.waitSignal(window.session.opener.ended):
        QTest.mouseClick(link, LEFT)


def drop(window, qtbot, path):
    """Drag a file or folder into the window, drop it, and wait until it is open."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    drag = Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier
    entered, dropped = QDragEnterEvent(QPoint(50, 50), *drag), QDropEvent(QPointF(50, 50), *drag)
    QApplication.sendEvent(window, entered)
    assert entered.isAccepted()
    with qtbot.waitSignal(window.session.opener.ended):
        QApplication.sendEvent(window, dropped)
    window.refresh()


def test_a_dropped_file_is_opened(window, qtbot, tmp_path):
    io.write(tmp_path / "five.mesh", gallery.make("five-side", size=500))
    drop(window, qtbot, tmp_path / "five.mesh")
    assert window.windowTitle().startswith("five.mesh")


@pytest.mark.slow
def test_a_dropped_folder_of_a_case_is_opened_and_saved(window, qtbot, tmp_path):
    mesh = gallery.make("five-side", size=500)
    io.write(tmp_path / "case" / "case.foam", mesh)
    drop(window, qtbot, tmp_path / "case")
    assert window.windowTitle().startswith("case")
    (tmp_path / "case/system").mkdir()
    (tmp_path / "copy").mkdir()
    with qtbot.waitSignal(window.session.saver.ended):
        window.session.commands.save_in_background(tmp_path / "copy" / "copy.foam")
    assert (tmp_path / "copy/system").is_dir()
    assert io.read(tmp_path / "copy").n_hexes == mesh.n_hexes


def test_an_unreadable_file_shows_an_error_and_the_open_mesh_stays(window, qtbot, tmp_path):
    bad = tmp_path / "cut.vtk"
    bad.write_text("# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0\n")
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed):
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
    qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()))


@pytest.mark.slow
def test_opening_shows_its_progress_and_is_cancelled(window, qtbot, recent, slow_read, mesh_file, tmp_path):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    before = window.session.document.now
    window.session.selection.choose(3)
    window.features["open"].open(other)
    assert window.busy.isVisible()
    assert "Reading slow.vtu" in window.busy.text()
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
    qtbot.waitUntil(lambda: window.busy.text().startswith("Reading endless.vtu: 40%"))
    press(named(window.busy, QPushButton, "Cancel"))
    try:
        qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()))
    finally:
        failed.set()  # otherwise the thread would be left
    assert window.session.document.now is before
    assert "Opening endless.vtu was cancelled" in window.messages.messages()[-1][1]
    assert not any("cannot be opened" in title for title, *_ in window.messages.messages())


# Card after opening: what the mesh is, what is wrong with it, and what to do next.


def text_of(mesh):
    return card("a.vtu", State.of(mesh), ())[1]


def test_it_counts_and_says_what_to_do():
    title, text = card("a.vtu", State.of(make("bridge-sharp", size=864, scramble=0.6)), ())
    assert title.startswith("a.vtu: 864 hexes, ")
    assert "Run Mend to untangle them" in text
    assert text_of(make("cube", size=27)) == "No hex is invalid. Minimum scaled Jacobian 1.000."
    flat = make("cube", size=27)
    assert "some have a low quality" in text_of(
        flat.with_points(flat.points * [1, 1, 1] + 1.3 * np.sin(flat.points[:, ::-1] * 7) / 7)
    )


def test_it_says_that_hexes_are_invalid_inside():
    inside = Mesh(THREE.points[THREE.hexes[INSIDE]], [range(8)])
    title, text = card("a.vtu", State.of(inside), ())
    assert title == "a.vtu: 1 hex, 0 inverted, 1 invalid"
    assert text.startswith("Solvers may reject 1 hex invalid inside, between valid corners.")


def test_it_says_what_fixed_nodes_hold():
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    assert "Fixed nodes" in text_of(mesh)


def test_it_counts_materials():
    assert "2 materials." in text_of(make("materials", size=300))


@pytest.mark.slow
def test_the_doctor_is_heard_on_the_card(window, qtbot, tmp_path):
    mesh = make("cube", size=27)
    twice = Mesh(np.concatenate([mesh.points, mesh.points + [mesh.points[:, 0].max(), 0, 0]]),
                 np.concatenate([mesh.hexes, mesh.hexes + mesh.n_nodes]))  # fmt: skip
    io.write(tmp_path / "blocks.vtu", twice)
    open_and_wait(qtbot, window, tmp_path / "blocks.vtu")
    assert window.messages.title.text().startswith("blocks.vtu: 54 hexes, 0 inverted, 0 invalid")
    qtbot.waitUntil(lambda: "The doctor found" in window.messages.text.text())
