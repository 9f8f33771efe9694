"""Dialogs that export charts and tables."""

import pytest
from PySide6.QtWidgets import QFileDialog, QLabel, QMessageBox

from hexmend_app.report.charts import ChartStyle
from hexmend_app.report.histogram import Histogram, Outline
from hexmend_app.widgets.dialogs.export_dialog import ChartDialog, TableDialog

HISTOGRAM = Histogram([Outline("at the start", "#5b6573", [1, 2, 3])], "bridge", "q", "hexes", [(0.0, "0")], (0.0, 1.0))
WORDS = ("the histogram", "bridge.svg", "SVG figure (*.svg);;Counts (*.csv)", ChartStyle())


@pytest.fixture
def dialog(qtbot, tmp_path):
    dialog = ChartDialog(HISTOGRAM, *WORDS)
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.target.line.setText(str(tmp_path / "a.svg"))
    return dialog


def test_edited_values_are_in_the_chosen_style(dialog):
    dialog.form.editor("width").set_value(85.0)
    dialog.title.setText("")
    dialog.names["at the start"].setText("as given")
    assert dialog.chosen() == ChartStyle(width=85.0, title="", names={"at the start": "as given"})
    dialog.accept()
    assert dialog.result() == ChartDialog.DialogCode.Accepted


@pytest.mark.parametrize(("file", "height", "problem"), [
    ("", None, "Enter the name of the file"), ("a.gif", None, ".gif"), ("a.svg", 5.0, "at least 20 mm"),
])  # fmt: skip
def test_a_wrong_file_name_or_size_is_a_problem(dialog, file, height, problem):
    dialog.target.line.setText(file)
    if height is not None:
        dialog.form.editor("height").set_value(height)
    dialog.accept()
    assert dialog.isVisible()
    assert any(problem in text for text in texts(dialog))


def test_replacing_an_existing_file_is_asked_once(dialog, qtbot, tmp_path, monkeypatch):
    (tmp_path / "a.svg").touch()
    questions = []
    monkeypatch.setattr(QMessageBox, "exec", lambda box: questions.append(box.text()) or QMessageBox.StandardButton.No)
    dialog.accept()
    assert dialog.isVisible()
    assert len(questions) == 1
    browse = next(child for child in dialog.target.children() if getattr(child, "text", str)() == "Browse…")
    for name in ("a", "a.svg"):
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, n=name: (str(tmp_path / n), "SVG (*.svg)"))
        browse.click()
        dialog.accept()
        assert len(questions) == 2  # the file dialog has asked about a.svg itself
    assert dialog.target.path() == tmp_path / "a.svg"
    assert not dialog.isVisible()


def test_the_preview_of_a_table_has_the_typed_names(qtbot):
    dialog = TableDialog(lambda style: f"**{style.names.get('mend', 'mend')}**", *WORDS, "bridge", ["mend"])
    qtbot.addWidget(dialog)
    dialog.show()
    qtbot.waitUntil(lambda: dialog.preview.toPlainText() == "mend")
    dialog.names["mend"].setText("ours")
    dialog.names["mend"].textEdited.emit("ours")
    qtbot.waitUntil(lambda: dialog.preview.toPlainText() == "ours")


def texts(dialog):
    """Return the problems that the dialog shows."""
    return [label.text() for label in dialog.findChildren(QLabel) if label.accessibleName() == "Problem"]
