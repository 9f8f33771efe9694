"""Choice of the theme: light, dark, or as the desktop."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from hexmend_app.state.settings.settings import THEME
from hexmend_app.theme.style import apply_style


class ThemeChoice(Enum):
    """Theme selected by the user."""

    LIGHT = "light"
    DARK = "dark"
    DESKTOP = "desktop"


_SCHEMES = {
    ThemeChoice.LIGHT: Qt.ColorScheme.Light,
    ThemeChoice.DARK: Qt.ColorScheme.Dark,
    ThemeChoice.DESKTOP: Qt.ColorScheme.Unknown,
}


def chosen() -> ThemeChoice:
    """Return the stored choice; by default DESKTOP."""
    stored = THEME.get()
    return ThemeChoice(stored) if stored in [choice.value for choice in ThemeChoice] else ThemeChoice.DESKTOP


def choose(choice: ThemeChoice) -> None:
    """Store a choice and apply it."""
    THEME.set(choice.value)
    apply_theme()


def apply_theme() -> None:
    """Apply the stored choice; window frames, which the desktop draws, follow if the platform supports it."""
    hints, choice = QApplication.styleHints(), chosen()
    hints.setColorScheme(_SCHEMES[choice])
    scheme = hints.colorScheme() if choice is ThemeChoice.DESKTOP else _SCHEMES[choice]
    apply_style(QApplication.instance(), scheme == Qt.ColorScheme.Dark)  # type: ignore[arg-type]
