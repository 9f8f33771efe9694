"""Decoration of compared views: a caption above each, and the choices and edge of the wipe."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QRect, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.canvas.view_captions import Caption, CaptionRow, WipeRow
from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.scene.views.arrangement import columns
from hexmend_app.state.view.side_views import Wipe

#: Most rows in which views stand.
_ROWS = 2


class ViewFrame(QVBoxLayout):
    """The view with captions of its parts; a single mesh has none.

    Parameters
    ----------
    view : QWidget

    Signals
    -------
    view_closed(int)
        The user closes a view: 1 is the first beside that of the mesh.
    wipe_chosen(left, right), wipe_moved(share), wipe_stepped(way)
        The user chooses the views of the wipe, or moves its edge to a position, or by a step.
    """

    view_closed = Signal(int)
    wipe_chosen = Signal(int, int)
    wipe_moved = Signal(float)
    wipe_stepped = Signal(int)

    def __init__(self, view: QWidget):
        super().__init__()
        self.setSpacing(0)
        self.captions: Sequence[Caption] = ()
        self._rows, self._wiped = [CaptionRow(view) for _ in range(_ROWS)], WipeRow()
        self._edge = WipeHandle(view)
        self.addWidget(self._wiped)
        self.addWidget(view, 1)
        for row in self._rows:
            row.closed.connect(self.view_closed)
        self._wiped.chosen.connect(self.wipe_chosen)
        self._edge.moved.connect(self.wipe_moved)
        self._edge.stepped.connect(self.wipe_stepped)

    @property
    def clickable(self) -> dict[QWidget, Callable[[], QRect]]:
        """The widgets over the view that are clicked or dragged, each with the area that must stay free."""
        return {row: row.rect for row in self._rows} | {self._edge: self._edge.knob}

    def set_captions(self, captions: Sequence[Caption], wipe: Wipe | None) -> None:
        """Set the captions of the views, or of the sides of a wipe."""
        self.captions = captions
        side_by_side = captions if len(captions) > 1 and wipe is None else []
        wide = columns(max(len(side_by_side), 1))
        for at, row in enumerate(self._rows):
            row.set_captions(side_by_side[at * wide : (at + 1) * wide], at * wide)
        self.fit()
        self._wiped.set_captions(captions, (wipe.left, wipe.right) if wipe is not None else None)

    def set_wipe(self, wipe: Wipe | None) -> None:
        """Show the edge of the wipe at a position, or hide it."""
        self._edge.setVisible(wipe is not None)
        if wipe is not None:
            self._edge.set_share(wipe.at)

    def fit(self) -> None:
        """Lay out all parts for the present size of the view."""
        shown = [row for row in self._rows if not row.isHidden()]
        for at, row in enumerate(shown):
            row.stand_at(at / len(shown))
