"""Section of a panel that collapses under its title."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QVBoxLayout, QWidget
from superqt import QCollapsible

from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help, set_variant

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
        self.layout().setSpacing(4)
        inside = QWidget()
        fill(QVBoxLayout(inside), content, margins=(0, 4, 0, 8))
        inside.setMaximumHeight(0)
        self.setContent(inside)
        button = self.toggleButton()
        button.setStyleSheet("")  # that of superqt has no states
        set_variant(button, "section")
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
