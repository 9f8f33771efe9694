"""What stands around the 3D view while several are compared: captions above and below, the wipe's choices and edge."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.canvas.captions import Caption, CaptionRow, WipeRow
from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.scene.arrangement import columns
from hexmend_app.state.views import Wipe


class ViewFrame(QVBoxLayout):
    """The view with what is said of its parts; of one mesh alone, nothing is.

    Parameters
    ----------
    view : QWidget

    Signals
    -------
    view_closed(int)
        The user wants a view closed: 1 is the first beside that of the mesh.
    wipe_chosen(left, right), wipe_moved(share)
        The user wants other views on either side of the wipe's edge, or the edge elsewhere.
    """

    view_closed = Signal(int)
    wipe_chosen = Signal(int, int)
    wipe_moved = Signal(float)

    def __init__(self, view: QWidget):
        super().__init__()
        self.setSpacing(0)
        self.captions: Sequence[Caption] = ()
        self._above, self._below, self._wiped = CaptionRow(), CaptionRow(), WipeRow()
        self._edge = WipeHandle(view)
        for part in (self._above, self._wiped, view, self._below):
            self.addWidget(part, 1 if part is view else 0)
        for row in (self._above, self._below):
            row.closed.connect(self.view_closed)
        self._wiped.chosen.connect(self.wipe_chosen)
        self._edge.moved.connect(self.wipe_moved)

    def set_captions(self, captions: Sequence[Caption], wipe: Wipe | None) -> None:
        """Say what is seen in which view; of a wipe, on which side."""
        self.captions = captions
        above = columns(len(captions)) if len(captions) > 1 and wipe is None else 0
        self._above.set_captions(captions[:above], 0)
        self._below.set_captions(captions[above:] if above else [], above)
        self._wiped.set_captions(captions, (wipe.left, wipe.right) if wipe is not None else None)

    def set_wipe(self, wipe: Wipe | None) -> None:
        """Show the wipe's edge where it is, or none."""
        self._edge.setVisible(wipe is not None)
        if wipe is not None:
            self._edge.set_share(wipe.at)
