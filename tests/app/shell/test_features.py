"""Features: their declarations appear in menus, command palette, page of keys and window."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import pytest
from PySide6.QtWidgets import QLabel, QMenu

from hexmend_app.feature import MENUS, Action, Feature, Panel, PanelPlace
from hexmend_app.shell import features as finding
from hexmend_app.shell.keys import as_markdown
from hexmend_app.shell.palette.command_palette import CommandPalette
from hexmend_app.shell.palette.palette_entries import command_entries
from hexmend_app.shell.window import Window
from tests.patience import PATIENCE


class FeatureCounting(Feature):
    """Example feature that counts."""

    order = 99

    def __init__(self, host):
        super().__init__(host)
        self.count = self.refreshed = 0
        self.panel = QLabel()

    def actions(self):
        return (
            Action(
                id="count",
                text="Count &up",
                menu="Help",
                keys="Ctrl+Alt+U",
                help="Count one more.",
                handle=self._count,
                enabled=lambda: self.count < 2,
                needs_mesh=False,
            ),
        )

    def panels(self):
        return (Panel(id="count", title="Counter", widget=self.panel, place=PanelPlace.FACTS, help="The count."),)

    def refresh(self):
        self.refreshed += 1
        self.panel.setText(f"{self.count} counted")

    def _count(self):
        self.count += 1
        self.session.selection.changed.emit()


@pytest.fixture
def with_example(qtbot, monkeypatch, tmp_path):
    """A window with the example among its features."""
    names, feature_class = finding.feature_names(), finding.feature_class
    monkeypatch.setitem(sys.modules, "hexmend_app.features.counting", ModuleType("counting"))
    monkeypatch.setattr(FeatureCounting, "__module__", "hexmend_app.features.counting.feature")
    monkeypatch.setattr(finding, "feature_names", lambda: [*names, "counting"])
    monkeypatch.setattr(
        finding, "feature_class", lambda name: FeatureCounting if name == "counting" else feature_class(name)
    )
    window = Window()
    qtbot.addWidget(window)
    window.build_features()
    window.show()
    yield window
    window.close()


def test_a_feature_appears_in_menu_palette_keys_and_window(with_example, qtbot):
    window = with_example
    action = window.action("count")
    menu = next(one for one in window.menuBar().findChildren(QMenu) if one.title().replace("&", "") == "Help")
    assert action in menu.actions()
    assert action.shortcut().toString() == "Ctrl+Alt+U"
    palette = CommandPalette(command_entries(window.window_actions), window)
    assert "Count up" in palette.titles()
    palette.close()
    assert "| Count up | `Ctrl+Alt+U` | Count one more. |" in as_markdown(window.menus.declared())
    assert "panel_count" in window.window_actions
    window.show_panel("count")
    assert window.features["counting"].panel.isVisible()
    assert window.in_front("count")


@pytest.mark.slow
def test_all_changes_in_a_turn_of_the_event_loop_cause_one_refresh(with_example, qtbot):
    window = with_example
    example = window.features["counting"]
    qtbot.waitUntil(lambda: example.refreshed > 0, timeout=PATIENCE)
    before = example.refreshed
    for _ in range(20):
        window.session.selection.changed.emit()
    assert example.refreshed == before
    qtbot.waitUntil(lambda: example.refreshed > before, timeout=PATIENCE)
    assert example.refreshed == before + 1
    window.action("count").trigger()
    window.action("count").trigger()
    qtbot.waitUntil(lambda: example.panel.text() == "2 counted", timeout=PATIENCE)
    assert not window.action("count").isEnabled()


def test_every_action_has_a_known_menu_and_help(with_example):
    declared = list(with_example.menus.declared())
    assert {one.menu for one in declared} <= {"", *MENUS}
    for one in declared:
        assert one.help.endswith("."), one.id


@pytest.mark.slow
def test_docs_keys_match_the_declared_actions(window):
    """`make docs` writes it."""
    page = Path(__file__).resolve().parents[3] / "docs" / "keys.md"
    assert page.read_text(encoding="utf-8") == as_markdown(window.menus.declared())


@pytest.mark.slow
def test_a_new_iteration_refreshes_only_features_that_show_it(window, qtbot, monkeypatch):
    calls = []
    for name in ("timeline", "help"):
        feature = window.features[name]
        monkeypatch.setattr(feature, "refresh", lambda name=name: calls.append(name))
    window.refresh_iteration()
    assert calls == ["timeline"]
    window.refresh()
    assert sorted(calls) == ["help", "timeline", "timeline"]
