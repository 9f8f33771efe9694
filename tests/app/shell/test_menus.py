"""Mnemonics of menus, and shortcuts of actions, which are unique."""

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


def test_every_entry_of_a_menu_has_a_mnemonic(window):
    shown = menus(window)
    assert len(shown) > 10
    for menu in shown:
        letters = [letter(action) for action in menu.actions() if not action.isSeparator()]
        assert "" not in letters, menu.title()


def test_a_mnemonic_stays_when_the_text_of_an_action_changes(window):
    before = letter(window.action("undo"))
    window.session.commands.tag("bad", [7])
    window.refresh()
    assert window.action("undo").text() == "&Undo tag"
    assert letter(window.action("undo")) == before
