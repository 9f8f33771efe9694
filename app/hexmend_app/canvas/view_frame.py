"""Layout of compared views: captions, and view selectors and edge of a wipe."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.canvas.view_captions import Caption, CaptionRow, WipeRow
from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.scene.views.arrangement import columns
from hexmend_app.state.view.side_views import Wipe

#: Maximum number of rows of views.
_MAX_ROWS = 2


class ViewFrame(QVBoxLayout):
    """Layout of the 3D view with captions of its views; a single view has no caption.

    Parameters
    ----------
    view : QWidget

    Signals
    -------
    view_closed(int)
        The user closed a view; number 1 is the view next to the first.
    """

    view_closed = Signal(int)

    def __init__(self, view: QWidget):
        super().__init__()
        self.setSpacing(0)
        self.captions: Sequence[Caption] = ()
        self._wipe: Wipe | None = None
        self._rows, self.wipe_row = [CaptionRow(view) for _ in range(_MAX_ROWS)], WipeRow()
        self.edge = WipeHandle(view)
        self._strip = QWidget(view)  # behind the legend, to the right of several views
        self._strip.setAutoFillBackground(True)
        self._strip.hide()
        self._view, self._legend_width = view, 0
        self.addWidget(self.wipe_row)
        self.addWidget(view, 1)
        for row in self._rows:
            row.closed.connect(self.view_closed)

    def set_captions(self, captions: Sequence[Caption], wipe: Wipe | None) -> None:
        """Set the captions of the views, or of the sides of a wipe."""
        self.captions, self._wipe = captions, wipe
        side_by_side = captions if len(captions) > 1 and wipe is None else []
        n_columns = columns(max(len(side_by_side), 1))
        for i, row in enumerate(self._rows):
            row.set_captions(side_by_side[i * n_columns : (i + 1) * n_columns], i * n_columns)
        self.fit()
        self.wipe_row.set_captions(captions, (wipe.left, wipe.right) if wipe is not None else None)

    def change_captions(self, captions: Sequence[Caption]) -> None:
        """Set the captions of the same views, or of the same wipe."""
        self.set_captions(captions, self._wipe)

    def set_legend_width(self, width: int) -> None:
        """Set the width of the strip for the legend to the right of several views, in pixels."""
        self._legend_width = width
        self._strip.setVisible(width > 0)
        self.fit()

    def set_wipe(self, wipe: Wipe | None) -> None:
        """Show the edge of the wipe at a position, or hide it."""
        self.edge.setVisible(wipe is not None)
        if wipe is not None:
            self.edge.set_share(wipe.at)

    def fit(self) -> None:
        """Place the captions for the current size of the view."""
        shown = [row for row in self._rows if not row.isHidden()]
        for i, row in enumerate(shown):
            row.place_at(i / len(shown), self._view.width() - self._legend_width)
        self._strip.setGeometry(self._view.width() - self._legend_width, 0, self._legend_width, self._view.height())
