"""What makes the window pleasant: recent files, work that can be called off, the first hint, sharp screens."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QPushButton

from hexmend_app.resources import demo_mesh
from hexmend_app.shell.keys import words
from hexmend_app.shell.keys_page import KeysPage
from hexmend_app.state import opener, worker
from hexmend_app.state.recent import MOST
from hexmend_app.state.run import Phase
from tests.app.driving import LEFT, click, open_and_wait, phase
from tests.patience import PATIENCE

# Recent files


def choose(menu, key):
    """Open a menu and press a letter in it."""
    menu.popup(QPoint(50, 50))
    QTest.keyClick(menu, key)


def test_opened_files_are_offered_newest_first_once_each(window, qtbot, tmp_path, mesh_file):
    assert window.features["open"].recent.files() == [mesh_file]
    other = tmp_path / "R&D" / "other.vtu"
    other.parent.mkdir()
    shutil.copy(mesh_file, other)
    open_and_wait(qtbot, window, other)
    open_and_wait(qtbot, window, demo_mesh())
    with qtbot.waitSignal(window.session.opener.failed, timeout=5000):
        window.features["open"].open(tmp_path / "nowhere.vtu")
    assert window.features["open"].recent.files() == [other, mesh_file]
    with qtbot.waitSignal(window.session.opener.ended, timeout=5000) as ended:
        choose(window.recent_menu, Qt.Key.Key_2)
    assert ended.args == [mesh_file]
    assert window.features["open"].recent.files() == [mesh_file, other]
    assert window.recent_menu.isHidden()


def test_a_file_that_is_gone_says_so_and_the_list_is_cleared(window, tmp_path):
    for k in range(MOST + 2):
        window.features["open"].recent.add(tmp_path / f"mesh{k}.vtu")
    assert len(window.features["open"].recent.files()) == MOST
    window.recent_menu.popup(QPoint(50, 50))
    gone = window.recent_menu.actions()[0]
    assert "no longer there" in gone.text()
    assert not gone.isEnabled()
    QTest.keyClick(window.recent_menu, Qt.Key.Key_C)
    assert window.features["open"].recent.files() == []
    assert not window.recent_menu.menuAction().isEnabled()


def test_the_welcome_offers_recent_files(window, qtbot, mesh_file):
    window.features["open"].welcome.show()
    qtbot.wait(20)
    link = next(b for b in window.features["open"].welcome.findChildren(QPushButton) if mesh_file.name in b.text())
    with qtbot.waitSignal(window.session.opener.ended, timeout=5000):
        QTest.mouseClick(link, LEFT)


# Work that can be called off


@pytest.fixture
def slow_read(monkeypatch):
    """Reading waits until it is let go on."""
    go_on, read = threading.Event(), opener.read

    def reading(path):
        go_on.wait(20)
        return read(path)

    monkeypatch.setattr(opener, "read", reading)
    yield go_on
    go_on.set()


@pytest.mark.parametrize("by", ["button", "Esc"])
def test_opening_says_what_it_does_and_is_cancelled(window, qtbot, slow_read, mesh_file, tmp_path, by):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    before = window.session.document.now
    window.session.selection.choose(3)
    window.features["open"].open(other)
    assert window.busy.isVisible()
    assert "Reading slow.vtu" in window.busy.text()
    if by == "button":
        QTest.mouseClick(window.busy.findChild(QPushButton), LEFT)
    else:
        QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape)
    assert not window.session.opener.busy
    assert not window.busy.isVisible()
    assert window.session.selection.hex == 3  # Esc was for the opening alone
    assert "Opening slow.vtu was cancelled" in window.messages.messages()[-1][1]
    slow_read.set()
    qtbot.wait(300)
    assert window.session.document.now is before
    assert window.features["open"].recent.files() == [mesh_file]
    open_and_wait(qtbot, window, other)
    assert window.session.document.name == "slow.vtu"


def test_another_mesh_is_opened_while_a_cancelled_one_is_still_read(window, qtbot, slow_read, mesh_file, tmp_path):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    window.features["open"].open(other)
    window.session.opener.cancel()
    window.features["open"].open(mesh_file)
    with qtbot.waitSignal(window.session.opener.ended, timeout=5000) as ended:
        slow_read.set()
    assert ended.args == [mesh_file]
    qtbot.wait(200)
    assert window.session.document.name == mesh_file.name


@pytest.fixture
def slow_method(monkeypatch):
    """A method waits, in its preparation, until it is let go on."""
    go_on, iterate = threading.Event(), worker.iterate

    def preparing(*order):
        go_on.wait(20)
        return iterate(*order)

    monkeypatch.setattr(worker, "iterate", preparing)
    yield go_on
    go_on.set()


def test_a_run_is_stopped_while_its_method_is_prepared(window, qtbot, slow_method):
    before = window.session.document.now
    click(window, "Run")
    assert window.session.smoothing.phase is Phase.PREPARING
    qtbot.wait(100)
    assert "Preparing" in sentence(window)
    click(window, "Stop")
    assert window.session.smoothing.phase is Phase.STOPPING
    assert "as soon as the method is ready" in sentence(window)
    assert not window.actions["stop"].isEnabled()
    slow_method.set()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now is before
    assert window.session.document.undo_title is None
    assert "Stopped" in sentence(window)
    assert not window.busy.isVisible()


def sentence(window):
    return window.features["smooth"].panel._sentence.text()


# Keys


def test_the_page_of_keys_lists_every_key_and_finds_letters(window, qtbot):
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F1)
    page = next(one for one in window.findChildren(KeysPage) if one.isVisible())
    text = page.text()
    for declared in window.menus.declared():
        assert words(declared) in text
        assert declared.keys in text.replace("\xa0", " ")
    QTest.keyClicks(page.findChild(QLineEdit), "sharp")
    assert "Sharp edges" in page.text()
    assert "Open" not in page.text()
    page.close()


# Sharp screens

_SCALED = """
import sys
import numpy as np
from PySide6.QtCore import QPointF, QSettings
from PySide6.QtTest import QTest
from tests.app.driving import LEFT
from hexmend import gallery, io
from hexmend_app.shell.program import application
from hexmend_app.shell.window import Window

QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, sys.argv[2])
app = application()
window = Window()
window.setGeometry(0, 0, 1001, 651)
window.show()
window.furnish()
window.build_canvas()
path = sys.argv[2] + "/cube.vtu"
io.write(path, gallery.make("cube", size=512))
window.features["open"].open(path)
while window.canvas.colouring is None:
    QTest.qWait(20)
drawn = []
window.canvas.interactor.frameSwapped.connect(lambda: drawn.append(True))
window.canvas.interactor.update()
while not drawn:
    QTest.qWait(20)
view, mesh = window.canvas.interactor, window.session.document.now.mesh
ratio = view.devicePixelRatioF()
corner = view.mapTo(window, view.rect().topLeft()).toPointF() * ratio
assert (corner.x() % 1, corner.y() % 1) == (0, 0), corner
assert view.render_window.GetSize() == (view.width() * ratio, view.height() * ratio)
renderer = window.canvas.panes.pane.renderer
towards = -np.array(window.canvas.viewport.camera.GetDirectionOfProjection())
middles = mesh.points[mesh.topology.boundary_faces].mean(axis=1)
seen = 0
for middle in middles[np.argsort(middles @ towards)[-40:]]:
    renderer.SetWorldPoint(*middle, 1.0)
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    QTest.mouseClick(view, LEFT, pos=QPointF(x / ratio, view.height() - y / ratio).toPoint())
    corners = mesh.points[mesh.hexes[window.session.selection.hex]]
    seen += bool((corners.min(axis=0) - 1e-9 <= middle).all() and (middle <= corners.max(axis=0) + 1e-9).all())
assert seen == 40, seen
assert window.features["save"].picture(sys.argv[1], (640, 400))
window.close()
"""


@pytest.mark.parametrize("scale", ["1.5", "2"])
def test_clicks_hit_what_they_point_at_on_sharp_screens(tmp_path, scale):
    environment = os.environ | {"QT_SCALE_FACTOR": scale}
    picture = tmp_path / "picture.png"
    done = subprocess.run(
        [sys.executable, "-c", _SCALED, str(picture), str(tmp_path)],
        env=environment, capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    from PIL import Image

    with Image.open(picture) as image:
        assert image.size == (640, 400)
        assert np.ptp(np.asarray(image.convert("RGB")), axis=(0, 1)).max() > 100
