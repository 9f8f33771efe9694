"""The script in the window: shown, copied, saved and run."""

import subprocess
import sys

import pytest
from PySide6.QtWidgets import QApplication, QFileDialog, QPlainTextEdit, QPushButton

from benchmarks.window.windows import save_and_wait
from hexmend.run import StoppingCriteria
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, click, named, phase, press
from tests.patience import PATIENCE


@pytest.fixture(autouse=True)
def nothing_done_before(window):
    """Clear the script, because tests share the window."""
    window.features["script"].script.restart()


@pytest.fixture
def panel(window, qtbot):
    window.show_panel("script")
    qtbot.waitUntil(window.features["script"].panel.isVisible, timeout=PATIENCE)
    return window.features["script"].panel


def shown(window, panel):
    window.refresh()
    return panel.findChild(QPlainTextEdit).toPlainText()


def test_actions_appear_as_they_happen(window, panel, qtbot):
    assert "import hexmend as hx" in shown(window, panel)
    before = shown(window, panel)
    choose(window, "local-sd", StoppingCriteria(max_iterations=2, tolerance=0))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    done = before.partition("# Current view")[0].rstrip()
    assert shown(window, panel).startswith(done)
    assert "hx.smooth(" in shown(window, panel)[len(done) :]


def test_it_restarts_with_the_current_mesh(window, panel, tmp_path):
    save_and_wait(window.session, tmp_path / "out.vtu")
    assert "out.vtu" in shown(window, panel)
    press(named(panel, QPushButton, "Restart the script"))
    assert "hx.write(" not in shown(window, panel)
    save_and_wait(window.session, tmp_path / "more.vtu")
    assert "mesh_0 = " in shown(window, panel)
    assert "more.vtu" in shown(window, panel)


def test_it_is_copied(window, qtbot, panel):
    def copied():
        QApplication.clipboard().clear()
        press(named(panel, QPushButton, "Copy the script"))
        return QApplication.clipboard().text() == window.features["script"].script.text

    qtbot.waitUntil(copied, timeout=PATIENCE)  # the camera fits the view anew after its panel has opened


@pytest.mark.slow
def test_it_is_saved_under_a_python_name_and_runs(window, panel, tmp_path, monkeypatch):
    asked = str(tmp_path / "again"), "Python script (*.py)"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *args: asked)
    save_and_wait(window.session, tmp_path / "out.vtu")
    (tmp_path / "out.vtu").unlink()
    press(named(panel, QPushButton, "Save the script"))
    subprocess.run([sys.executable, tmp_path / "again.py"], check=True)
    assert (tmp_path / "out.vtu").exists()


def test_a_failed_save_returns_false(window, tmp_path):
    assert not window.features["script"].save(tmp_path / "nowhere" / "script.py")
