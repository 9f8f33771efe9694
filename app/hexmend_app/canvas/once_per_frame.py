"""Drawing what is seen once a frame."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from pyvistaqt import QtInteractor


class OncePerFrame(QObject):
    """Has a 3D view rendered as Qt paints it, and at no other time.

    Left to themselves VTK renders whenever it is told to, and the widget once more as that is to be seen: every frame
    costs twice. Here a wish to render asks Qt to paint, of which several make one frame.

    Parameters
    ----------
    interactor : QtInteractor
    """

    def __init__(self, interactor: QtInteractor):
        super().__init__(interactor)
        self._interactor = interactor
        self._iren = interactor.iren.interactor
        self._painting = False
        self._iren.EnableRenderOff()
        self._iren.AddObserver("RenderEvent", lambda *_: self._on_wish())
        interactor.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let VTK render while Qt paints."""
        if event.type() == QEvent.Type.Paint:
            self._painting = True
            self._iren.EnableRenderOn()
        return super().eventFilter(watched, event)

    def _on_wish(self) -> None:
        if self._painting:
            self._painting = False
            self._iren.EnableRenderOff()
        else:
            self._interactor.update()
