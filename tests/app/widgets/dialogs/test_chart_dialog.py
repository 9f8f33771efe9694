"""Dialogs that export charts, and dialogs that ask for files."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QFileDialog, QLabel, QMessageBox

from hexmend_app.report.charts import ChartStyle
from hexmend_app.report.histogram import Histogram, Series
from hexmend_app.state.settings.settings import FOLDER
from hexmend_app.widgets.dialogs import questions
from hexmend_app.widgets.dialogs.chart_dialog import ChartDialog

HISTOGRAM = Histogram([Series("at the start", "#5b6573", [1, 2, 3])], "bridge", "q", "hexes", [(0.0, "0")])
WORDS = ("the histogram", "bridge.svg", "SVG figure (*.svg);;Counts (*.csv)", ChartStyle())


@pytest.fixture
def dialog(qtbot, tmp_path):
    dialog = ChartDialog(HISTOGRAM, *WORDS)
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.target.line.setText(str(tmp_path / "a.svg"))
    return dialog


def test_edited_values_are_in_the_chosen_style(dialog):
    dialog.form.editors["width"].set_value(85.0)
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
        dialog.form.editors["height"].set_value(height)
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


def texts(dialog):
    """Return the problems that the dialog shows."""
    return [label.text() for label in dialog.findChildren(QLabel) if label.accessibleName() == "Problem"]


# Dialogs that ask for files: their common folder, and suffixes of names.


LIST = ("Save list as", "bridge-worst.csv", "Table (*.csv)")
DIALOGS = {
    "ask_mesh_target": ("Save mesh as", "bridge"),
    "ask_to_save": LIST,
    "ask_mesh": (),
    "ask_to_open": ("Load recipe", "Recipes (*.toml)"),
}


@pytest.fixture
def answers(qapp, tmp_path, monkeypatch):
    """Replace file dialogs: set their answer, and record the folder in which they start."""
    for kind in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(kind, QSettings.Scope.UserScope, str(tmp_path / "settings"))

    class Answers:
        def __init__(self):
            self.name, self.kind, self.begun = "", "", []

        def answer(self, parent, title, begin, *kinds):
            self.begun.append(begin)
            return self.name, self.kind

    answers = Answers()
    monkeypatch.setattr(QFileDialog, "getSaveFileName", answers.answer)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", answers.answer)
    return answers


@pytest.mark.parametrize("name", DIALOGS)
def test_every_dialog_starts_in_the_folder_of_the_last_file(answers, tmp_path, name):
    one, other = tmp_path / "one", tmp_path / "other"
    one.mkdir()
    other.mkdir()
    questions.remember_folder(one / "mesh.vtu")
    answers.name = str(other / "result.txt")
    assert getattr(questions, name)(None, *DIALOGS[name]) == answers.name
    assert answers.begun[-1].startswith(str(one))
    assert questions.folder() == other


@pytest.mark.parametrize(("terminal", "place"), [(True, "working"), (False, "home"), (None, "home")])
def test_the_first_dialog_starts_in_the_working_directory_of_a_terminal(
    answers, tmp_path, monkeypatch, terminal, place
):
    for name in ("working", "home"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path / "working")
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "home")
    monkeypatch.setattr("sys.stdin", None if terminal is None else SimpleNamespace(isatty=lambda: terminal))
    FOLDER.set(FOLDER.default)
    questions.ask_mesh(None)
    assert Path(answers.begun[-1]) == tmp_path / place


@pytest.mark.parametrize("name", ["ask_mesh_target", "ask_to_save"])
def test_a_name_without_a_suffix_gets_that_of_the_chosen_or_first_kind(answers, tmp_path, name):
    answers.name = str(tmp_path / "result")
    assert getattr(questions, name)(None, *DIALOGS[name]).startswith(f"{answers.name}.")
    answers.kind = "Something (*.some)"
    assert getattr(questions, name)(None, *DIALOGS[name]) == f"{answers.name}.some"


def test_replacing_a_file_is_asked_if_the_file_dialog_did_not(answers, tmp_path, monkeypatch):
    (tmp_path / "list.csv").write_text("another")
    answers.name = str(tmp_path / "list")
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.No)
    assert questions.ask_to_save(None, *LIST) == ""
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Yes)
    assert questions.ask_to_save(None, *LIST) == str(tmp_path / "list.csv")
