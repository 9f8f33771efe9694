"""Dialogs that ask for files: their common folder, and suffixes of names."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QFileDialog, QMessageBox

from hexmend_app.state.settings.settings import FOLDER
from hexmend_app.widgets.dialogs import questions

SAVING = {
    "ask_target": ("bridge",),
    "ask_list": ("bridge",),
    "ask_recipe_target": (),
    "ask_film": ("bridge",),
}
OPENING = ("ask_mesh", "ask_recipe")


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


@pytest.mark.parametrize("name", [*SAVING, *OPENING])
def test_every_dialog_starts_in_the_folder_of_the_last_file(answers, tmp_path, name):
    one, other = tmp_path / "one", tmp_path / "other"
    one.mkdir()
    other.mkdir()
    questions.remember_folder(one / "mesh.vtu")
    answers.name = str(other / "result.txt")
    assert getattr(questions, name)(None, *SAVING.get(name, ())) == answers.name
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
    FOLDER.clear()
    questions.ask_mesh(None)
    assert Path(answers.begun[-1]) == tmp_path / place


@pytest.mark.parametrize("name", SAVING)
def test_a_name_without_a_suffix_gets_that_of_the_chosen_or_first_kind(answers, tmp_path, name):
    answers.name = str(tmp_path / "result")
    assert getattr(questions, name)(None, *SAVING[name]).startswith(f"{answers.name}.")
    answers.kind = "Something (*.some)"
    assert getattr(questions, name)(None, *SAVING[name]) == f"{answers.name}.some"


def test_replacing_a_file_is_asked_if_the_file_dialog_did_not(answers, tmp_path, monkeypatch):
    (tmp_path / "list.csv").write_text("another")
    answers.name = str(tmp_path / "list")
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.No)
    assert questions.ask_list(None, "bridge") == ""
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Yes)
    assert questions.ask_list(None, "bridge") == str(tmp_path / "list.csv")
