"""The theme: light, dark, or as the desktop has it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtGui import QGuiApplication

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.theme import theme_choice
from hexmend_app.theme.theme_choice import ThemeChoice

_WORDS = {
    ThemeChoice.LIGHT: ("&Light", "Dark on light, as pictures for reports are in any theme."),
    ThemeChoice.DARK: ("&Dark", "Light on dark, easier on the eyes in a dim room."),
    ThemeChoice.DESKTOP: ("&As the desktop", "Light or dark as the desktop is, and changing with it."),
}


class FeatureTheme(Feature):
    """Lets the user choose the theme, and follows the desktop's."""

    order = 60

    def __init__(self, host: Host):
        super().__init__(host)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_desktop)

    def actions(self) -> Sequence[Action]:
        """One for each theme."""
        return [
            Action(
                id=f"theme_{choice.value}",
                text=text,
                menu="View/Theme",
                help=help,
                handle=lambda on, choice=choice: self._choose(choice, on),
                checked=lambda choice=choice: theme_choice.chosen() is choice,
                needs_mesh=False,
                exclusive=True,
            )
            for choice, (text, help) in _WORDS.items()
        ]

    def _choose(self, choice: ThemeChoice, on: bool) -> None:
        if on and choice is not theme_choice.chosen():
            theme_choice.choose(choice)
            self.host.refresh_soon()

    def _on_desktop(self) -> None:
        theme_choice.apply_theme()
