"""Features: their actions have a place and a help, and they are refreshed when what they show changes."""

from pathlib import Path

import pytest

from hexmend_app.feature import MENUS
from hexmend_app.shell.keys import as_markdown

pytestmark = pytest.mark.slow


def test_every_action_has_a_known_menu_and_help(window):
    declared = list(window.menus.declared())
    assert {one.menu for one in declared} <= {"", *MENUS}
    for one in declared:
        assert one.help.endswith("."), one.id


def test_docs_keys_match_the_declared_actions(window):
    """`make docs` writes it."""
    page = Path(__file__).resolve().parents[3] / "docs" / "reference" / "keys.md"
    assert page.read_text(encoding="utf-8") == as_markdown(window.menus.declared())


def test_all_changes_in_a_turn_of_the_event_loop_cause_one_refresh(window, qtbot, monkeypatch):
    calls = []
    monkeypatch.setattr(window.features["help"], "refresh", lambda: calls.append(1))
    for _ in range(20):
        window.session.selection.changed.emit()
    assert calls == []
    qtbot.waitUntil(lambda: calls != [])
    assert calls == [1]


def test_a_new_iteration_refreshes_only_features_that_show_it(window, qtbot, monkeypatch):
    calls = []
    for name in ("timeline", "help"):
        feature = window.features[name]
        monkeypatch.setattr(feature, "refresh", lambda name=name: calls.append(name))
    window.refresh_iteration()
    assert calls == ["timeline"]
    window.refresh()
    assert sorted(calls) == ["help", "timeline", "timeline"]
