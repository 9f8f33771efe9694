"""The letters of menus and the keys of actions: none means two things."""

from __future__ import annotations

from collections import Counter

from PySide6.QtGui import QAction, QKeySequence


def letter(action):
    """What is pressed in the menu for an action, "" for nothing."""
    return QKeySequence.mnemonic(action.text()).toString()


def menus(window):
    """The bar of menus, every menu, and those within."""
    every = [window.menuBar()]
    for menu in every:
        every += [action.menu() for action in menu.actions() if action.menu() is not None]
    return every


def test_no_two_actions_have_the_same_keys(window):
    keys = [action.shortcut().toString() for action in window.findChildren(QAction) if not action.shortcut().isEmpty()]
    assert [key for key, times in Counter(keys).items() if times > 1] == []


def test_every_entry_of_a_menu_has_a_letter_of_its_own(window):
    shown = menus(window)
    assert len(shown) > 10
    for menu in shown:
        letters = [letter(action) for action in menu.actions() if not action.isSeparator()]
        assert "" not in letters, menu.title()
        assert [one for one, times in Counter(letters).items() if times > 1] == [], menu.title()


def test_a_letter_stays_while_the_text_of_an_action_changes(window):
    before = letter(window.action("undo"))
    window.session.commands.tag("bad", [7])
    window.refresh()
    assert window.action("undo").text() == "&Undo tag"
    assert letter(window.action("undo")) == before
