"""Mnemonics of menus and shortcuts of actions are unique."""

from __future__ import annotations

from collections import Counter

from PySide6.QtGui import QAction, QKeySequence


def letter(action):
    """Return the mnemonic of an action, "" if it has none."""
    return QKeySequence.mnemonic(action.text()).toString()


def menus(window):
    """Return the menu bar and all menus and submenus."""
    found = [window.menuBar()]
    for menu in found:
        found += [action.menu() for action in menu.actions() if action.menu() is not None]
    return found


def test_no_two_actions_have_the_same_keys(window):
    keys = [action.shortcut().toString() for action in window.findChildren(QAction) if not action.shortcut().isEmpty()]
    assert [key for key, times in Counter(keys).items() if times > 1] == []


def test_entries_of_a_menu_have_distinct_mnemonics_as_far_as_letters_are_left(window):
    shown = menus(window)
    assert len(shown) > 10
    for menu in shown:
        letters = {action.text(): letter(action) for action in menu.actions() if not action.isSeparator()}
        taken = [one for one in letters.values() if one]
        assert [one for one, times in Counter(taken).items() if times > 1] == [], menu.title()
        for text in (text for text, one in letters.items() if not one):
            assert {f"Alt+{one.upper()}" for one in text if one.isalnum()} <= set(taken), text


def test_a_mnemonic_stays_when_the_text_of_an_action_changes(window):
    before = letter(window.action("undo"))
    window.session.commands.tag("bad", [7])
    window.refresh()
    assert window.action("undo").text() == "&Undo tag"
    assert letter(window.action("undo")) == before
