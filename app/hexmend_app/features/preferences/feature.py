"""Preferences: theme, size of letters, and what the program opens at its start."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QVBoxLayout, QWidget

from hexmend.parameters import Parametrised, declared, parameter
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.settings.settings import LETTERS, REOPEN, THEME, Setting
from hexmend_app.theme import theme_choice
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.theme_choice import ThemeChoice
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

_STORED: dict[str, Setting[Any]] = {"theme": THEME, "letters": LETTERS, "reopen": REOPEN}


@dataclass(frozen=True)
class Preferences(Parametrised):
    """Preferences of the user."""

    theme: str = parameter(
        "desktop",
        choices=tuple(choice.value for choice in ThemeChoice),
        titles=("Light", "Dark", "System"),
        help="Colours of the window; System follows the desktop.",
    )
    letters: int = parameter(
        100,
        low=80,
        high=200,
        unit="%",
        label="Size of letters",
        help="Size of all texts in the window, from the next start on.",
    )
    reopen: bool = parameter(
        False, label="Reopen the last mesh", help="Open the last mesh again when the program starts without a file."
    )


class PreferencesDialog(QDialog):
    """Form of the preferences, which are stored as soon as they change."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Settings"))
        self.form = ParameterForm(declared(Preferences))
        self.form.set_values({name: setting.get() for name, setting in _STORED.items()})
        self.form.changed.connect(self._store)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        fill(QVBoxLayout(self), self.form, None, buttons)

    def _store(self) -> None:
        for name, value in self.form.values().items():
            _STORED[name].set(value)
        theme_choice.apply_theme()


class FeaturePreferences(Feature):
    """Edits the preferences, and follows changes of the desktop's theme."""

    def __init__(self, host: Host):
        super().__init__(host)
        QGuiApplication.styleHints().colorSchemeChanged.connect(theme_choice.apply_theme)

    def actions(self) -> Iterable[Action]:
        """Yield the action that opens the dialog."""
        yield Action(
            id="settings",
            text=tr("&Settings…"),
            menu="Edit",
            section=9,
            keys="Ctrl+,",
            icon="cog-outline",
            help=tr("Select the theme, the size of letters and what is opened at the start."),
            handle=self._edit,
            needs_mesh=False,
        )

    def _edit(self) -> None:
        dialog = PreferencesDialog(self.host.dialog_parent)
        dialog.exec()
        dialog.deleteLater()
