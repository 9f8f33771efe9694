"""Icons are sharp, and legible in both themes."""

import numpy as np
from PySide6.QtCore import QSize
from PySide6.QtGui import QIcon, QImage

from hexmend_app.theme.palette import FAINT, TEXT
from hexmend_app.theme.style import icon


def opacity(name, size, ratio=1.0):
    """Return the opacity of the pixels of an icon, from 0 to 1."""
    image = icon(name).pixmap(QSize(size, size), ratio).toImage().convertToFormat(QImage.Format.Format_RGBA8888)
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)[..., 3] / 255


def test_icons_have_the_resolution_of_the_screen(qapp):
    assert opacity("grid", 16, 2.0).shape == (32, 32)
    assert opacity("grid", 16).max() > 0.9


def test_a_disabled_icon_is_faint(qapp):
    image = icon("grid").pixmap(QSize(16, 16), 1.0, QIcon.Mode.Disabled).toImage()
    colours = {
        image.pixelColor(x, y).name() for x in range(16) for y in range(16) if image.pixelColor(x, y).alpha() > 250
    }
    assert str(FAINT) in colours
    assert str(TEXT) not in colours
