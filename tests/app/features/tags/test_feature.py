"""Tagging hexes in the window by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QTableWidget

from hexmend import LocalSteepestDescent, StoppingCriteria, io
from hexmend_app.features.tags.feature import FeatureTags
from hexmend_app.features.tags.tag_panel import TagPanel, TagRow
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, brought, button, heard_from, key, press, type_text
from tests.app.hosting import action
from tests.core.grids import grid, scrambled


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "tags")


def listed(panel):
    panel.window().refresh()
    table = panel.findChild(QTableWidget)
    return [[table.item(row, column).text() for column in range(4)] for row in range(table.rowCount())]


def seen(window):
    window.refresh()
    return [label.text() for label in window.features["hex_inspector"].panel.findChildren(QLabel)]


def tags(window):
    return {name: members.tolist() for name, members in window.session.document.now.mesh.hex_sets.items()}


def test_a_hex_is_tagged_and_untagged_by_key_undone_and_saved(window, panel, tmp_path):
    key(window, Qt.Key.Key_T)
    assert tags(window) == {}
    key(window, Qt.Key.Key_N)
    first = window.session.selection.hex
    key(window, Qt.Key.Key_T)
    key(window, Qt.Key.Key_N)
    second = window.session.selection.hex
    key(window, Qt.Key.Key_T)
    assert tags(window) == {"tagged": sorted([first, second])}
    assert listed(panel) == [
        ["tagged", "2", "2", f"{window.session.document.now.figures.q[[first, second]].min():.4f}"]
    ]
    key(window, Qt.Key.Key_T)
    assert tags(window) == {"tagged": [first]}
    assert f"Hex {second:,}" in seen(window)
    window.session.commands.undo()
    assert tags(window) == {"tagged": sorted([first, second])}
    assert f"Hex {second:,}: tagged" in seen(window)
    assert window.session.document.redo_title == "untag"
    assert window.features["save"].save_and_wait(tmp_path / "tagged.vtk")
    kept = io.read(tmp_path / "tagged.vtk")
    assert kept.hex_sets["tagged"].tolist() == sorted([first, second])


@pytest.mark.slow
def test_shown_or_listed_hexes_are_tagged_and_isolated(window, panel):
    name = panel.findChild(QComboBox)
    type_text(name.lineEdit(), "bad ones")
    window.session.view.change(show={"peel": 2})
    window.refresh()
    press(button(panel, "Shown"))
    layers = window.session.document.now.mesh.topology.layers
    assert tags(window) == {"bad ones": np.flatnonzero(layers >= 2).tolist()}
    type_text(name.lineEdit(), "worst")
    press(button(panel, "Worst"))
    assert tags(window)["worst"] == sorted(window.features["hex_inspector"].worst_list.hexes.tolist())
    table = panel.findChild(QTableWidget)
    QTest.mouseClick(table.viewport(), LEFT, pos=table.visualItemRect(table.item(1, 0)).center())
    press(button(panel, "Isolate"))
    assert sorted(window.session.view.look.show.isolate.hexes) == tags(window)["worst"]
    press(button(panel, "Remove"))
    assert list(tags(window)) == ["bad ones"]


@pytest.mark.slow
def test_a_tag_is_renamed_unless_the_name_exists(window, panel, qtbot):
    window.session.commands.tag("one", [1, 2])
    window.session.commands.tag("two", [3])
    window.refresh()
    table = panel.findChild(QTableWidget)

    def write(row, text):
        QTest.mouseDClick(table.viewport(), LEFT, pos=table.visualItemRect(table.item(row, 0)).center())
        editor = table.findChild(QLineEdit)
        type_text(editor, text, enter=True)
        # Qt takes what was typed in a later turn of the event loop
        qtbot.waitUntil(lambda: table.findChild(QLineEdit) is None)
        window.refresh()

    QTest.mouseClick(table.viewport(), LEFT, pos=QPoint(20, 10))
    write(0, "three")
    assert tags(window) == {"three": [1, 2], "two": [3]}
    write(0, "two")
    assert tags(window) == {"three": [1, 2], "two": [3]}
    assert listed(panel)[0][0] == "three"


# The panel and the shortcut tell why a hex cannot be tagged.


@pytest.fixture
def tag_panel(shown):
    return shown(TagPanel(), 500, 200)


@pytest.fixture
def refused(tag_panel):
    told = heard_from(tag_panel.refused)
    tag_panel.toggle_requested.connect(lambda name: told.append(f"tagged {name}"))
    return told


def said(tag_panel):
    return [label.text() for label in tag_panel.findChildren(QLabel) if label.isVisible()]


REFUSED_TAGS = [
    (False, False, "bad", "No hex selected"),
    (True, True, "bad", "during a run"),
    (False, True, "bad", "during a run"),
    (True, False, " ", "Enter a tag name"),
]


@pytest.mark.parametrize("rows", [[], [TagRow("one", 3, 0, 0.5)]])
@pytest.mark.parametrize(("selected", "busy", "name", "word"), REFUSED_TAGS)
def test_a_refused_tag_has_a_reason(tag_panel, refused, rows, selected, busy, name, word):
    tag_panel.set_tags(rows)
    tag_panel.findChild(QComboBox).setEditText(name)
    tag_panel.set_state(selected, busy)
    tag_panel.toggle()
    assert len(refused) == 1
    assert word in refused[0]
    # The first hint also tells how to select a hex.
    assert any(word in text or ("Select a hex" in text and not busy and name.strip()) for text in said(tag_panel))


@pytest.fixture
def host(hosted):
    return hosted(scrambled(grid(4), 0.3))


def test_the_shortcut_reports_that_a_run_is_paused(host, qtbot):
    feature = FeatureTags(host)
    tag = action(feature, "tag")
    smoothing = host.session.run
    host.session.selection.choose(5)
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0), 1)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)
    feature.refresh()
    assert tag.enabled()
    tag.handle()
    assert "during a run" in " ".join(host.messages.messages()[-1])
    assert host.session.document.now.mesh.hex_sets == {}
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
    feature.refresh()
    tag.handle()
    assert host.session.document.now.mesh.hex_sets["tagged"].tolist() == [5]
