"""Legend of the views: the colour bar, and the numbers of hexes with special colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtWidgets import QWidget

from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.canvas.view_captions import Caption
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.scene.views.panes import Panes
from hexmend_app.widgets.overlay import MARGIN, Overlay

#: Maximum share of the width for a strip next to several views; a wider colour bar covers them.
_MAX_SHARE = 0.3


class ViewLegend:
    """Shows the colours of the views in the colour bar, and numbers in the captions of several views.

    The colour bar floats over a single view. To the right of several views side by side it has a strip of its own.

    Parameters
    ----------
    over : QWidget
        Widget of the views.
    panes : Panes
    frame : ViewFrame
        Layout of the views and their captions.

    Attributes
    ----------
    colour_bar : ColourBar
    """

    def __init__(self, over: QWidget, panes: Panes, frame: ViewFrame):
        self._over, self._panes, self._frame = over, panes, frame
        self.colour_bar = ColourBar()
        Overlay(self.colour_bar, over, (1.0, 0.5))

    def show_colours(self) -> None:
        """Show the colours of the views."""
        view, bar = self._panes.first, self.colour_bar
        colouring = view.colouring
        if colouring is None:
            bar.hide()
        else:
            bar.setVisible(not view.frame.look.colours.neutral)
            single = len(self._panes.all) == 1  # the captions of several views show the numbers
            bar.show_colouring(colouring, [n for _, n, _ in view.colours.special_counts] if single else [])
        self.place()
        captions = self._frame.captions
        with_counts = self.with_counts(captions)
        if any(one.counts != before.counts for one, before in zip(with_counts, captions, strict=True)):
            self._frame.change_captions(with_counts)

    def place(self) -> None:
        """Reserve a strip for the colour bar to the right of several views side by side, if there is space."""
        width = self.colour_bar.sizeHint().width() + 2 * MARGIN
        several = len(self._panes.all) > 1 and self._panes.wipe is None and not self.colour_bar.isHidden()
        width = width if several and width < _MAX_SHARE * self._over.width() else 0
        self._frame.set_legend_width(width)
        self._panes.reserve_legend(round(width * self._over.devicePixelRatioF()))

    def with_counts(self, captions: Sequence[Caption]) -> Sequence[Caption]:
        """Return the captions of several views with the numbers of hexes with special colours."""
        views = self._panes.all
        if self._panes.first.colouring is None or len(views) < 2 or len(views) != len(captions):
            return captions
        counts = [tuple((name, n) for name, n, _ in view.colours.special_counts) for view in views]
        return [replace(caption, counts=own) for caption, own in zip(captions, counts, strict=True)]
