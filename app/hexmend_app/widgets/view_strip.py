"""Bar below the view that is shown only while it is used."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QWidget

from hexmend_app.theme.spacing import Part, fill
from hexmend_app.theme.style import cross_button, set_help
from hexmend_app.translation import tr


class ViewStrip(QWidget):
    """Row of controls below the view, with a cross at its end; hidden at first.

    Parameters
    ----------
    name : str
        Accessible name.

    Signals
    -------
    closed
        The user pressed the cross.
    """

    closed = Signal()

    def __init__(self, name: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName(name)
        self.hide()

    def add(self, *parts: Part) -> None:
        """Add widgets from left to right, and the cross."""
        cross = cross_button()
        set_help(cross, tr("Close {name}", name=self.accessibleName()), tr("Close this bar."))
        cross.clicked.connect(self.closed)
        fill(QHBoxLayout(self), *parts, cross, margins=(8, 4, 8, 4), spacing=4)
