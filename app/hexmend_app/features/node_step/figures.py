"""Table of the figures of a node's step, each with an explanation."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtWidgets import QFrame, QTextBrowser, QWidget

from hexmend_app.features.node_step.step_texts import Row
from hexmend_app.theme.style import MUTED, TEXT, on_theme_change, set_help, smaller
from hexmend_app.translation import tr

_ROW = (
    '<table width="100%" cellspacing="0" cellpadding="0" style="margin-top: 5px">'
    '<tr><td style="color: {text}">{name}</td>'
    '<td align="right" style="color: {colour}">{value}</td></tr></table>'
    '<p style="color: {muted}; font-size: {size}pt; margin: 0">{meaning}</p>'
)


class NodeFigures(QTextBrowser):
    """Shows the figures of a node's step."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._rows: Sequence[Row] = ()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setTabChangesFocus(True)
        self.viewport().setAutoFillBackground(False)
        self.document().setDocumentMargin(3)
        set_help(self, tr("Values of the step"), "")
        on_theme_change(self, self._render)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Replace the figures and scroll to the top."""
        self._rows = rows
        self._render()

    def _render(self) -> None:
        size = smaller(self.font()).pointSizeF()
        self.setHtml(
            "".join(
                _ROW.format(
                    name=escape(row.name),
                    value=escape(row.value).replace("  ", " &nbsp;"),
                    meaning=escape(row.meaning),
                    text=TEXT,
                    muted=MUTED,
                    colour=row.colour,
                    size=size,
                )
                for row in self._rows
            )
        )
