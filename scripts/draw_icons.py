"""Draw the icon for desktops, desktop/icons/SIZE.png, from resources/icon.svg.

Use: QT_QPA_PLATFORM=offscreen python scripts/draw_icons.py
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

ROOT = Path(__file__).resolve().parents[1]
SIZES = 16, 24, 32, 48, 64, 128, 256


def main() -> None:
    """Draw them all."""
    application = QGuiApplication([])
    drawing = QSvgRenderer(str(ROOT / "resources/icon.svg"))
    for size in SIZES:
        image = QImage(size, size, QImage.Format.Format_ARGB32)
        image.fill(Qt.GlobalColor.transparent)
        painter = QPainter(image)
        drawing.render(painter)
        painter.end()
        image.save(str(ROOT / f"desktop/icons/{size}.png"))
    application.quit()


if __name__ == "__main__":
    main()
