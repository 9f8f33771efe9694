"""Section of a panel that collapses under its title."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QVBoxLayout, QWidget
from superqt import QCollapsible

from hexmend_app.theme.palette import BLUE, HOVER, MUTED
from hexmend_app.theme.style import icon, on_theme_change, set_help

# QWIDGETSIZE_MAX of Qt, which PySide6 does not provide.
_UNBOUNDED = (1 << 24) - 1


class Section(QCollapsible):
    """Collapsible widget under a title.

    Parameters
    ----------
    title : str
    content : QWidget
    help : str
        Tooltip of the title.
    """

    def __init__(self, title: str, content: QWidget, help: str, parent: QWidget | None = None):
        super().__init__(title, parent, icon("chevron-down", MUTED), icon("chevron-right", MUTED))
        # An animation would end with a fixed height, which is too small for lines that appear later.
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
        """Return a size as wide as the collapsed content, so that expanding does not change the width of the panel."""
        size = super().minimumSizeHint()
        return QSize(max(size.width(), self.content().minimumSizeHint().width()), size.height())

    def _fit(self, open_: bool) -> None:
        # Hidden, not only of zero height, so that Tab does not reach collapsed widgets.
        self.content().setVisible(open_)
        self.content().setMaximumHeight(_UNBOUNDED if open_ else 0)


def _sheet() -> str:
    return (
        "QPushButton { text-align: left; border: 1px solid transparent; border-radius: 3px; padding: 3px 1px;"
        f" font-weight: 600; }} QPushButton:hover {{ background: {HOVER}; }}"
        f" QPushButton:focus {{ border-color: {BLUE}; outline: none; }}"
    )
