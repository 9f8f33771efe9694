"""What makes the window pleasant: recent files, work that can be called off, the first hint, sharp screens."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from hexmend_app.features.help.hint import Hint
from hexmend_app.resources import demo_mesh
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
    assert window.recent.files() == [mesh_file]
    other = tmp_path / "R&D" / "other.vtu"
    other.parent.mkdir()
    shutil.copy(mesh_file, other)
    open_and_wait(qtbot, window, other)
    open_and_wait(qtbot, window, demo_mesh())
    with qtbot.waitSignal(window.opener.failed, timeout=5000):
        window.open(tmp_path / "nowhere.vtu")
    assert window.recent.files() == [other, mesh_file]
    with qtbot.waitSignal(window.opener.ended, timeout=5000) as ended:
        choose(window.recent_menu, Qt.Key.Key_2)
    assert ended.args == [mesh_file]
    assert window.recent.files() == [mesh_file, other]
    assert window.recent_menu.isHidden()


def test_a_file_that_is_gone_says_so_and_the_list_is_cleared(window, tmp_path):
    for k in range(MOST + 2):
        window.recent.add(tmp_path / f"mesh{k}.vtu")
    assert len(window.recent.files()) == MOST
    window.recent_menu.popup(QPoint(50, 50))
    gone = window.recent_menu.actions()[0]
    assert "no longer there" in gone.text()
    assert not gone.isEnabled()
    QTest.keyClick(window.recent_menu, Qt.Key.Key_C)
    assert window.recent.files() == []
    assert not window.recent_menu.menuAction().isEnabled()


def test_the_welcome_offers_recent_files(window, qtbot, mesh_file):
    window.welcome.show()
    qtbot.wait(20)
    link = next(b for b in window.welcome.findChildren(QPushButton) if mesh_file.name in b.text())
    with qtbot.waitSignal(window.opener.ended, timeout=5000):
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
    before = window.document.now
    window.selection.choose(3)
    window.open(other)
    assert window.busy.isVisible()
    assert "Reading slow.vtu" in window.busy.text()
    if by == "button":
        QTest.mouseClick(window.busy.findChild(QPushButton), LEFT)
    else:
        QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape)
    assert not window.opener.busy
    assert not window.busy.isVisible()
    assert window.selection.hex == 3  # Esc was for the opening alone
    assert "Opening slow.vtu was cancelled" in window.messages.messages()[-1][1]
    slow_read.set()
    qtbot.wait(300)
    assert window.document.now is before
    assert window.recent.files() == [mesh_file]
    open_and_wait(qtbot, window, other)
    assert window.document.name == "slow.vtu"


def test_another_mesh_is_opened_while_a_cancelled_one_is_still_read(window, qtbot, slow_read, mesh_file, tmp_path):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    window.open(other)
    window.opener.cancel()
    window.open(mesh_file)
    with qtbot.waitSignal(window.opener.ended, timeout=5000) as ended:
        slow_read.set()
    assert ended.args == [mesh_file]
    qtbot.wait(200)
    assert window.document.name == mesh_file.name


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
    before = window.document.now
    click(window, "Run")
    assert window.smoothing.phase is Phase.PREPARING
    qtbot.wait(100)
    assert "Preparing" in sentence(window)
    click(window, "Stop")
    assert window.smoothing.phase is Phase.STOPPING
    assert "as soon as the method is ready" in sentence(window)
    assert not window.actions_by_id["stop"].isEnabled()
    slow_method.set()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.document.now is before
    assert window.document.undo_title is None
    assert "Stopped" in sentence(window)
    assert not window.busy.isVisible()


def sentence(window):
    return window.smoothing_panel._sentence.text()


# The first hint


def test_the_hint_is_there_until_it_is_dismissed_and_again_by_key(window, qtbot):
    assert window.hint.isVisible()
    QTest.mouseClick(window.hint.close_button, LEFT)
    assert not window.hint.isVisible()
    later = Hint()
    qtbot.addWidget(later)
    assert later.isHidden()
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F1)
    assert window.hint.isVisible()
    assert QSettings().contains("hint dismissed")


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
window.build_canvas()
path = sys.argv[2] + "/cube.vtu"
io.write(path, gallery.make("cube", size=512))
window.open(path)
while window.canvas.colouring is None:
    QTest.qWait(20)
drawn = []
window.canvas.interactor.frameSwapped.connect(lambda: drawn.append(True))
window.canvas.interactor.update()
while not drawn:
    QTest.qWait(20)
view, mesh = window.canvas.interactor, window.document.now.mesh
ratio = view.devicePixelRatioF()
corner = view.mapTo(window, view.rect().topLeft()).toPointF() * ratio
assert (corner.x() % 1, corner.y() % 1) == (0, 0), corner
assert view.render_window.GetSize() == (view.width() * ratio, view.height() * ratio)
renderer = view.renderer
towards = -np.array(window.canvas.viewport.camera.GetDirectionOfProjection())
middles = mesh.points[mesh.topology.boundary_faces].mean(axis=1)
seen = 0
for middle in middles[np.argsort(middles @ towards)[-40:]]:
    renderer.SetWorldPoint(*middle, 1.0)
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    QTest.mouseClick(view, LEFT, pos=QPointF(x / ratio, view.height() - y / ratio).toPoint())
    corners = mesh.points[mesh.hexes[window.selection.hex]]
    seen += bool((corners.min(axis=0) - 1e-9 <= middle).all() and (middle <= corners.max(axis=0) + 1e-9).all())
assert seen == 40, seen
assert window.saving.picture(sys.argv[1], (640, 400))
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
