"""Choice of the theme: the user's, kept in the settings, or the desktop's."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from hexmend_app.state.settings.settings import THEME
from hexmend_app.theme.style import apply_style


class ThemeChoice(Enum):
    """Theme that the user wants."""

    LIGHT = "light"
    DARK = "dark"
    DESKTOP = "desktop"


_SCHEMES = {
    ThemeChoice.LIGHT: Qt.ColorScheme.Light,
    ThemeChoice.DARK: Qt.ColorScheme.Dark,
    ThemeChoice.DESKTOP: Qt.ColorScheme.Unknown,
}


def chosen() -> ThemeChoice:
    """Return the user's choice; by default that of the desktop."""
    kept = THEME.get()
    return ThemeChoice(kept) if kept in [choice.value for choice in ThemeChoice] else ThemeChoice.DESKTOP


def choose(choice: ThemeChoice) -> None:
    """Wear another theme, at once and at the next start."""
    THEME.set(choice.value)
    apply_theme()


def apply_theme() -> None:
    """Dress the program as was chosen; the frames of its windows, which are the desktop's, follow where they can."""
    app, choice = QApplication.instance(), chosen()
    app.styleHints().setColorScheme(_SCHEMES[choice])
    scheme = app.styleHints().colorScheme() if choice is ThemeChoice.DESKTOP else _SCHEMES[choice]
    apply_style(app, scheme == Qt.ColorScheme.Dark)
