"""Preview of what a dialog writes."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QPainter, QPixmap, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from hexmend.errors import HexmendError
from hexmend_app.theme.palette import LINE
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

#: Milliseconds between the last change and drawing.
_PAUSE = 150


class Preview(QLabel):
    """Picture that is drawn again shortly after each change, as large as there is space.

    Parameters
    ----------
    help : str
        Tooltip.

    Signals
    -------
    drawn(str)
        Emitted after drawing, with the problem or "".
    """

    drawn = Signal(str)

    def __init__(self, help: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._draw: Callable[[QSize], QImage] | None = None
        self.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.setMinimumSize(360, 280)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        set_help(self, tr("Preview"), help)
        self._soon = QTimer(self, interval=_PAUSE, singleShot=True)
        self._soon.timeout.connect(self._redraw)

    def draw_soon(self, draw: Callable[[QSize], QImage]) -> None:
        """Show after a short delay what a function draws for a size in device pixels; it may raise `HexmendError`."""
        self._draw = draw
        self._soon.start()

    def stop(self) -> None:
        """Draw nothing until the next `draw_soon`."""
        self._draw = None
        self._soon.stop()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw in the new size."""
        super().resizeEvent(event)
        if self._draw is not None:
            self._soon.start()

    def _redraw(self) -> None:
        ratio = self.devicePixelRatioF()
        size = self.contentsRect().size() * ratio
        try:
            image = self._draw(size)
        except HexmendError as error:
            self.drawn.emit(str(error))
            return
        if image.height() > size.height() or image.width() > size.width():
            image = image.scaled(size, Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation)
        picture = QPixmap.fromImage(image)
        with QPainter(picture) as painter:
            painter.setPen(str(LINE))
            painter.drawRect(0, 0, picture.width() - 1, picture.height() - 1)
        picture.setDevicePixelRatio(ratio)
        self.setPixmap(picture)
        self.drawn.emit("")
