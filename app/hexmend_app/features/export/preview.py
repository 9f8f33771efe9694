"""Preview of a page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QTimer, Signal
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QPixmap, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from hexmend.errors import HexmendError
from hexmend_app.picture import Scene
from hexmend_app.picture.page import PT_PER_INCH
from hexmend_app.theme.palette import LINE
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from PIL import Image

#: Milliseconds between the last change and drawing.
_PAUSE = 150


class Preview(QWidget):
    """Small picture of a page without shading, redrawn shortly after each change.

    Signals
    -------
    drawn(str)
        Emitted after drawing, with the problem or "".
    """

    drawn = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._scene: Scene | None = None
        self._picture = QPixmap()
        self.setMinimumSize(360, 280)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        set_help(self, tr("Preview"), tr("Small preview of the page, without shading."))
        self._soon = QTimer(self, interval=_PAUSE, singleShot=True)
        self._soon.timeout.connect(self._redraw)

    def show_scene(self, scene: Scene, draw: Callable[[Scene], Image.Image]) -> None:
        """Draw a scene after a short delay."""
        self._scene, self._draw = scene, draw
        self._soon.start()

    def stop(self) -> None:
        """Draw nothing until the next scene is shown."""
        self._soon.stop()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Redraw in the new size."""
        super().resizeEvent(event)
        if self._scene is not None:
            self._soon.start()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture centred."""
        painter = QPainter(self)
        size = self._picture.size() / self.devicePixelRatioF()
        left, top = (self.width() - size.width()) // 2, (self.height() - size.height()) // 2
        if not self._picture.isNull():
            painter.drawPixmap(left, top, self._picture)
            painter.setPen(str(LINE))
            painter.drawRect(left - 1, top - 1, size.width() + 1, size.height() + 1)

    def _redraw(self) -> None:
        ratio = self.devicePixelRatioF()
        try:
            scene = preview_scene(self._scene, (self.width() - 4) * ratio, (self.height() - 4) * ratio)
            image = self._draw(scene).convert("RGBA")
        except HexmendError as error:
            self.drawn.emit(str(error))
            return
        data = QImage(image.tobytes(), *image.size, QImage.Format.Format_RGBA8888)
        self._picture = QPixmap.fromImage(data)
        self._picture.setDevicePixelRatio(ratio)
        self.update()
        self.drawn.emit("")


def preview_scene(scene: Scene, width: float, height: float) -> Scene:
    """Return the scene with fewer pixels and fast settings; text and lines keep their size relative to the page.

    Parameters
    ----------
    scene : Scene
    width, height : float
        Available size in pixels.
    """
    page = scene.page
    scale = min(1.0, width / page.size[0], height / page.size[1])
    dpi = page.resolution * scale
    across, down = (max(16, round(side * scale)) for side in page.size)
    edges = scene.lines.edges
    pen = edges if edges == 0 else page.line_width(scene.lines) / page.resolution * PT_PER_INCH
    fast: dict[str, Any] = {"shading": False, "supersampling": 1, "font_size": page.letters}
    small = replace(page, width=None, height=None, pixels=(across, down), dpi=max(dpi, 5.0), **fast)
    return replace(scene, page=small, lines=replace(scene.lines, edges=pen))
