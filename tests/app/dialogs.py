"""Dialogs of a window, by name: functions that make them without waiting for an answer."""

from collections.abc import Callable

from PySide6.QtWidgets import QDialog

from hexmend_app.features.pad.feature import PadDialog
from hexmend_app.features.preferences.feature import PreferencesDialog
from hexmend_app.shell.command_palette import CommandPalette, choice_entries, command_entries
from hexmend_app.shell.window import Window
from hexmend_app.shell.window_actions import KeysPage
from hexmend_app.widgets.dialogs.questions import waiting_dialog


def _pad(window: Window) -> QDialog:
    now = window.session.document.now
    return PadDialog(now.mesh, now.summary.locked_inverted, now.summary.inverted, window)


def _palette(window: Window) -> QDialog:
    actions = {id: action for id, action in window.window_actions.items() if id != "commands"}
    return CommandPalette([*command_entries(actions), *choice_entries(window.session)], window)


DIALOGS: dict[str, Callable[[Window], QDialog]] = {
    "picture": lambda window: window.features["export"].dialog("picture"),
    "histogram": lambda window: window.features["histogram"].dialog(),
    "report": lambda window: window.features["export"].dialog("report"),
    "pad": _pad,
    "settings": PreferencesDialog,
    "keys": lambda window: KeysPage(window.menus.declared(), window),
    "palette": _palette,
    "waiting": lambda window: waiting_dialog(window, "The file is being saved.", lambda: False, "Close anyway"),
}
