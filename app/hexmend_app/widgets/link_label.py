"""Label with links to hexes or nodes."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QWidget

from hexmend_app.theme.style import on_theme_change


class LinkLabel(QLabel):
    """Label of rich text, which can be selected, with links, which are followed by mouse or keyboard.

    A text that begins with a link needs a zero-width space before it: Shift+Tab cannot leave a link at the start of a
    label.

    Signals
    -------
    followed(int)
        The user followed a link to this number; `linkActivated` is emitted for all links.
    """

    followed = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.linkActivated.connect(lambda link: self.followed.emit(int(link)) if link.isdigit() else None)
        on_theme_change(self, lambda: self.setText(self.text()))

    def setText(self, text: str) -> None:
        """Set the text, with links in the colour of the theme."""
        self.clear()  # Qt colours links when the text is set, and ignores an unchanged text
        super().setText(text)
