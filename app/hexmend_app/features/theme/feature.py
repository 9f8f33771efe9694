"""Themes of the window: light, dark, or the theme of the desktop."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtGui import QGuiApplication

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.theme import theme_choice
from hexmend_app.theme.theme_choice import ThemeChoice
from hexmend_app.translation import tr

_TEXTS = {
    ThemeChoice.LIGHT: ("&Light", "Use the light theme."),
    ThemeChoice.DARK: ("&Dark", "Use the dark theme."),
    ThemeChoice.DESKTOP: ("&System", "Follow the theme of the desktop."),
}


class FeatureTheme(Feature):
    """Switches the theme, and follows changes of the desktop's theme."""

    def __init__(self, host: Host):
        super().__init__(host)
        QGuiApplication.styleHints().colorSchemeChanged.connect(theme_choice.apply_theme)

    def actions(self) -> Iterable[Action]:
        """Yield an action for each theme."""
        for choice, (text, help) in _TEXTS.items():
            yield Action(
                id=f"theme_{choice.value}",
                text=tr(text),
                menu="View/Theme",
                help=tr(help),
                handle=lambda on, choice=choice: self._choose(choice, on),
                checked=lambda choice=choice: theme_choice.chosen() is choice,
                needs_mesh=False,
                exclusive=True,
            )

    def _choose(self, choice: ThemeChoice, on: bool) -> None:
        if on and choice is not theme_choice.chosen():
            theme_choice.choose(choice)
            self.host.refresh_soon()
