"""Which theme is worn: what the user chose, kept in the settings, or what the desktop has."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from hexmend_app.state.settings import THEME
from hexmend_app.widgets.style import apply_style


class Choice(Enum):
    """Which theme the user wants."""

    LIGHT = "light"
    DARK = "dark"
    DESKTOP = "desktop"


_SCHEMES = {
    Choice.LIGHT: Qt.ColorScheme.Light,
    Choice.DARK: Qt.ColorScheme.Dark,
    Choice.DESKTOP: Qt.ColorScheme.Unknown,
}


def chosen() -> Choice:
    """What the user chose; at first, to do as the desktop does."""
    kept = THEME.get()
    return Choice(kept) if kept in [choice.value for choice in Choice] else Choice.DESKTOP


def choose(choice: Choice) -> None:
    """Wear another theme, at once and at the next start."""
    THEME.set(choice.value)
    wear()


def wear() -> None:
    """Dress the program as was chosen; the frames of its windows, which are the desktop's, follow where they can."""
    app, choice = QApplication.instance(), chosen()
    app.styleHints().setColorScheme(_SCHEMES[choice])
    scheme = app.styleHints().colorScheme() if choice is Choice.DESKTOP else _SCHEMES[choice]
    apply_style(app, scheme == Qt.ColorScheme.Dark)
