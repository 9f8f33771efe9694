"""The script in the window: seen as it grows, copied, saved, and run."""

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from PySide6.QtWidgets import QApplication, QFileDialog, QPlainTextEdit, QPushButton

from hexmend.run import Stop
from hexmend_app.state.run import Phase
from tests.app.driving import choose, click, named, phase, press
from tests.patience import PATIENCE


@pytest.fixture(autouse=True)
def nothing_done_before(window):
    """What other tests have done in the window they share is not in the script."""
    window.features["script"].script.begin_anew()


@pytest.fixture
def panel(window, qtbot):
    window.show_panel("script")
    qtbot.waitUntil(window.features["script"].panel.isVisible)
    return window.features["script"].panel


def shown(window, panel):
    window.refresh()
    return panel.findChild(QPlainTextEdit).toPlainText()


def test_what_is_done_is_seen_as_it_is_done(window, panel, qtbot):
    assert "import hexmend as hx" in shown(window, panel)
    before = shown(window, panel)
    choose(window, "local-sd", Stop(max_iterations=2, tolerance=0))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    after = shown(window, panel)
    assert after.startswith(before.rstrip())
    assert "hx.smooth(" in after[len(before.rstrip()) :]


def test_it_begins_anew_with_the_mesh_as_it_is(window, panel, tmp_path):
    window.session.commands.save(tmp_path / "out.vtu")
    assert "out.vtu" in shown(window, panel)
    press(named(panel, QPushButton, "Begin the script anew"))
    assert "out.vtu" not in shown(window, panel)
    window.session.commands.save(tmp_path / "more.vtu")
    assert "mesh_0 = " in shown(window, panel)
    assert "more.vtu" in shown(window, panel)


def test_it_is_copied(window, panel):
    QApplication.clipboard().clear()
    press(named(panel, QPushButton, "Copy the script"))
    assert QApplication.clipboard().text() == window.features["script"].script.text


def test_it_is_saved_under_a_python_name_and_runs(window, panel, tmp_path, monkeypatch):
    asked = str(tmp_path / "again"), "Python script (*.py)"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *args: asked)
    window.session.commands.save(tmp_path / "out.vtu")
    (tmp_path / "out.vtu").unlink()
    press(named(panel, QPushButton, "Save the script"))
    subprocess.run([sys.executable, tmp_path / "again.py"], check=True)
    assert (tmp_path / "out.vtu").exists()


def test_why_it_was_not_saved_is_said(window, tmp_path):
    assert not window.features["script"].save(tmp_path / "nowhere" / "script.py")


def test_a_picture_is_drawn_again_as_it_was(window, tmp_path):
    path, script = tmp_path / "view.png", window.features["script"]
    window.action("cut").trigger()
    window.refresh()
    assert window.features["save"].picture(path, (400, 300))
    with Image.open(path) as image:
        before = np.asarray(image.convert("RGB")).astype(int)
    path.unlink()
    assert script.save(tmp_path / "script.py")
    subprocess.run([sys.executable, tmp_path / "script.py"], check=True)
    with Image.open(path) as image:
        after = np.asarray(image.convert("RGB")).astype(int)
    assert abs(before - after).mean() < 0.5


def test_a_picture_of_several_views_is_told_of(window, tmp_path):
    window.session.views.show("as it was", window.session.document.now)
    window.refresh()
    assert window.features["save"].picture(tmp_path / "view.png", (400, 300))
    assert "it carries its scene" in window.features["script"].script.entries[-1]
