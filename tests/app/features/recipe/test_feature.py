"""Recipes in the window, by mouse and keys: edited, run, saved and loaded."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QLineEdit, QListWidget, QPushButton

from hexmend import METHODS, Recipe, StoppingCriteria, read_recipe, smooth
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, brought, choose, key, named, phase, press, sentence

SHORT = StoppingCriteria(max_iterations=3, tolerance=0)


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "recipe")


def button(panel, name):
    panel.window().refresh()
    return named(panel, QPushButton, name)


def stages(panel):
    panel.window().refresh()
    shown = panel.findChild(QListWidget)
    return [shown.item(at).text() for at in range(shown.count())]


def click_on(panel, at):
    shown = panel.findChild(QListWidget)
    place = shown.visualItemRect(shown.item(at)).center()
    QTest.mouseClick(shown.viewport(), LEFT, pos=place)
    return place


def add(window, panel, method, values=None, stop=SHORT):
    choose(window, method, stop, **(values or {}))
    press(button(panel, "Add"))


def test_stages_are_added_with_their_values_ordered_and_removed(window, panel):
    add(window, panel, "getme", stop=StoppingCriteria(max_iterations=20))
    add(window, panel, "local-sd", {"p": 4.0})
    add(window, panel, "mend", {"goal": "shape"}, StoppingCriteria())
    assert stages(panel) == [
        "1  GETMe, simultaneous (max_iterations=20)",
        "2  Local steepest descent (p=4, max_iterations=3, tolerance=0)",
        "3  Mend (goal=shape)",
    ]
    press(button(panel, "Move up"))  # the one added last is chosen
    assert [stage.smoother.name for stage in window.session.recipe_draft.stages] == ["getme", "mend", "local-sd"]
    click_on(panel, 0)
    assert not button(panel, "Move up").isEnabled()
    press(button(panel, "Remove the stage"))
    assert [stage.smoother.name for stage in window.session.recipe_draft.stages] == ["mend", "local-sd"]
    click_on(panel, 1)
    choose(window, "laplacian")
    press(button(panel, "Replace the stage"))
    assert window.session.recipe_draft.stages[1].smoother == METHODS["laplacian"]()


@pytest.mark.slow
def test_a_recipe_is_run_as_one_run(window, panel, qtbot):
    mesh = window.session.document.now.mesh
    add(window, panel, "getme")
    add(window, panel, "local-sd")
    recipe = window.session.recipe_draft.recipe
    press(button(panel, "Run recipe"))
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    np.testing.assert_array_equal(window.session.document.now.mesh.points, smooth(mesh, recipe).mesh.points)
    assert [row["method"] for row in window.session.run.record.rows[1:]] == ["getme"] * 3 + ["local-sd"] * 3
    assert window.session.document.undo_title == recipe.title
    assert "Stage 1, GETMe" in sentence(window)
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.now.mesh.points is mesh.points


def test_a_recipe_is_saved_and_loaded(window, panel, qtbot, tmp_path, monkeypatch):
    path = tmp_path / "mine.toml"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    add(window, panel, "getme")
    add(window, panel, "mend", {"p": 3.0})
    title = panel.findChild(QLineEdit)
    window.refresh()
    assert title.placeholderText() == "GETMe, simultaneous; then Mend"
    title.setFocus()
    QTest.keyClicks(title, " Mine ")
    QTest.keyClick(title, Qt.Key.Key_Return)
    press(button(panel, "Save"))
    assert window.messages.messages()[-1][1] == f"Recipe saved to {path}"
    saved = read_recipe(path)
    assert saved == window.session.recipe_draft.recipe
    assert saved.title == "Mine"
    window.session.recipe_draft.load(Recipe.of("laplacian"))
    assert window.session.recipe_draft.title == ""
    window.window_actions["recipe_load"].trigger()
    assert window.session.recipe_draft.recipe == saved
    window.refresh()
    assert title.text() == "Mine"


@pytest.mark.slow
def test_an_invalid_file_is_reported_and_the_recipe_stays(window, panel, tmp_path):
    add(window, panel, "getme")
    before = window.session.recipe_draft.recipe
    path = tmp_path / "wrong.toml"
    path.write_text('format = 1\n[[stage]]\nmethod = "mned"')
    window.features["recipe"].load(path)
    kind, title, text = window.messages.messages()[-1]
    assert (kind, title) == ("error", "Recipe not loaded")
    assert "wrong.toml: stage 1: there is no method 'mned': did you mean mend?" in text
    assert window.session.recipe_draft.recipe == before
    window.features["recipe"].save(tmp_path / "no" / "such.toml")
    assert window.messages.messages()[-1][1] == "Recipe not saved"
