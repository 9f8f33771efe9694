"""The script in the window: shown, copied and saved."""

import pytest
from PySide6.QtWidgets import QApplication, QFileDialog, QPlainTextEdit, QPushButton

from tests.app.driving import brought, named, press, run_to_end


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "script")


def test_the_script_is_shown_copied_and_saved(window, panel, qtbot, tmp_path, monkeypatch):
    run_to_end(window, qtbot, "local-sd", max_iterations=2, tolerance=0)
    text = panel.findChild(QPlainTextEdit).toPlainText()
    assert "mesh_1 = hx.smooth(mesh_0, hx.LocalSteepestDescent(), " in text
    assert "[camera]" in text
    press(named(panel, QPushButton, "Copy the script"))
    assert QApplication.clipboard().text().startswith(text.partition("# Current view")[0])
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *asked: (str(tmp_path / "again"), "Python script (*.py)")
    )
    press(named(panel, QPushButton, "Save the script"))
    assert "hx.smooth(" in (tmp_path / "again.py").read_text()
    assert not window.features["script"].save(tmp_path / "nowhere" / "script.py")
