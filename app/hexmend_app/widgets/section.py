"""A part of a panel that folds away under its title."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QVBoxLayout, QWidget
from superqt import QCollapsible

from hexmend_app.theme.palette import BLUE, HOVER, MUTED
from hexmend_app.theme.style import icon, on_theme_change, set_help

# Qt's QWIDGETSIZE_MAX, which PySide6 does not hand on.
_UNBOUNDED = (1 << 24) - 1


class Section(QCollapsible):
    """`content` under a title that folds it.

    Parameters
    ----------
    title : str
    content : QWidget
    help : str
        What is found inside, as tooltip of the title.
    """

    def __init__(self, title: str, content: QWidget, help: str, parent: QWidget | None = None):
        super().__init__(title, parent, icon("chevron-down", MUTED), icon("chevron-right", MUTED))
        # An animation ends on a fixed height, into which lines that appear later would not fit.
        self.setDuration(0)
        self.layout().setContentsMargins(0, 0, 0, 0)
        self.layout().setSpacing(2)
        inside = QWidget()
        inner = QVBoxLayout(inside)
        inner.setContentsMargins(6, 2, 0, 6)
        inner.addWidget(content)
        inside.setMaximumHeight(0)
        self.setContent(inside)
        button = self.toggleButton()
        on_theme_change(button, lambda: button.setStyleSheet(_sheet()))
        set_help(button, title, help)
        self.toggled.connect(self._fit)
        self._fit(False)

    def minimumSizeHint(self) -> QSize:
        """Return the width of the folded content too, so that the surroundings keep their width as it unfolds."""
        size = super().minimumSizeHint()
        return QSize(max(size.width(), self.content().minimumSizeHint().width()), size.height())

    def _fit(self, open_: bool) -> None:
        # Hidden, not only of no height, so that Tab does not walk through what cannot be seen.
        self.content().setVisible(open_)
        self.content().setMaximumHeight(_UNBOUNDED if open_ else 0)


def _sheet() -> str:
    return (
        "QPushButton { text-align: left; border: 1px solid transparent; border-radius: 3px; padding: 3px 1px;"
        f" font-weight: 600; }} QPushButton:hover {{ background: {HOVER}; }}"
        f" QPushButton:focus {{ border-color: {BLUE}; outline: none; }}"
    )
