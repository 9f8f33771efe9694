"""The dialog that asks what a chart or a table is to be like."""

import pytest
from PySide6.QtWidgets import QFileDialog, QMessageBox

from hexmend.report.charts import ChartStyle
from hexmend.report.histogram import Histogram, Outline
from hexmend_app.widgets.dialogs.export_dialog import ChartDialog, TableDialog
from tests.patience import PATIENCE

HISTOGRAM = Histogram([Outline("at the start", "#5b6573", [1, 2, 3])], "bridge", "q", "hexes", [(0.0, "0")], (0.0, 1.0))
WORDS = ("the histogram", "bridge.svg", "SVG figure (*.svg);;Counts (*.csv)", ChartStyle())


@pytest.fixture
def dialog(qtbot, tmp_path):
    asks = ChartDialog(HISTOGRAM, *WORDS)
    qtbot.addWidget(asks)
    asks.show()
    asks.target.line.setText(str(tmp_path / "a.svg"))
    return asks


def test_it_begins_with_what_the_chart_calls_itself(dialog):
    assert dialog.chosen() == ChartStyle(title="bridge")


def test_what_is_edited_is_what_is_chosen(dialog):
    dialog.form.editor("width").set_value(85.0)
    dialog.title.setText("")
    dialog.names["at the start"].setText("as given")
    assert dialog.chosen() == ChartStyle(width=85.0, title="", names={"at the start": "as given"})
    dialog.accept()
    assert dialog.result() == ChartDialog.DialogCode.Accepted


def test_it_shows_what_will_be_written(dialog, qtbot):
    qtbot.waitUntil(lambda: not dialog.preview.pixmap().isNull(), timeout=PATIENCE)
    before = dialog.preview.pixmap().toImage()
    dialog.names["at the start"].setText("a name that is much longer")
    dialog.names["at the start"].textEdited.emit("")
    qtbot.waitUntil(lambda: dialog.preview.pixmap().toImage() != before, timeout=PATIENCE)
    dialog.target.line.setText("a.csv")
    qtbot.waitUntil(lambda: "without a picture" in dialog.preview.text(), timeout=PATIENCE)
    assert not dialog.form.isEnabled()


@pytest.mark.parametrize("file", ["~nobody-of-this-name/x.svg", "x" * 300 + ".svg"])
def test_a_path_that_cannot_be_is_for_the_writer_to_refuse(dialog, qtbot, file):
    dialog.target.line.setText(file)
    qtbot.waitUntil(lambda: not dialog.preview.pixmap().isNull(), timeout=PATIENCE)
    dialog.accept()
    assert dialog.target.path().name.endswith("x.svg")
    assert not dialog.isVisible()


@pytest.mark.parametrize(("file", "said"), [("", "Name the file"), ("a.gif", ".gif")])
def test_a_file_that_cannot_be_written_is_said_before(dialog, qtbot, file, said):
    dialog.target.line.setText(file)
    dialog.accept()
    assert dialog.isVisible()
    assert any(said in text for text in texts(dialog))


def test_a_size_that_cannot_be_is_said(dialog, qtbot):
    dialog.form.editor("height").set_value(5.0)
    dialog.accept()
    assert dialog.isVisible()
    assert any("at least 20 mm" in text for text in texts(dialog))


def test_a_file_that_is_there_is_asked_about_once(dialog, qtbot, tmp_path, monkeypatch):
    (tmp_path / "a.svg").touch()
    asked = []
    monkeypatch.setattr(QMessageBox, "exec", lambda box: asked.append(box.text()) or QMessageBox.StandardButton.No)
    dialog.accept()
    assert dialog.isVisible()
    assert len(asked) == 1
    browse = next(one for one in dialog.target.children() if getattr(one, "text", str)() == "Browse…")
    for name in ("a", "a.svg"):
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, n=name: (str(tmp_path / n), "SVG (*.svg)"))
        browse.click()
        dialog.accept()
        assert len(asked) == 2  # of a.svg itself the desktop's dialog had asked
    assert dialog.target.path() == tmp_path / "a.svg"
    assert not dialog.isVisible()


def test_a_table_is_shown_under_the_names_that_are_typed(qtbot):
    dialog = TableDialog(lambda style: f"**{style.names.get('mend', 'mend')}**", *WORDS, "bridge", ["mend"])
    qtbot.addWidget(dialog)
    dialog.show()
    qtbot.waitUntil(lambda: dialog.preview.toPlainText() == "mend", timeout=PATIENCE)
    dialog.names["mend"].setText("ours")
    dialog.names["mend"].textEdited.emit("ours")
    qtbot.waitUntil(lambda: dialog.preview.toPlainText() == "ours", timeout=PATIENCE)


def texts(dialog):
    """What the dialog says under its fields."""
    from PySide6.QtWidgets import QLabel

    return [label.text() for label in dialog.findChildren(QLabel) if label.accessibleName() == "What is wrong"]
