"""Contrast of colours and of painted texts (WCAG 2.2)."""

import numpy as np
from PySide6.QtGui import QImage

#: Least contrast of texts, and of texts of disabled controls, which WCAG exempts altogether.
TEXT, DISABLED = 4.5, 3.0

#: A letter that is a solid block, so that its colour is not blended with the background.
BLOCK = "█"


def luminance(colours):
    """Return the relative luminance of colours, (..., 3) from 0 to 255."""
    share = np.asarray(colours) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return linear @ (0.2126, 0.7152, 0.0722)


def contrast(a, b):
    """Return the contrast of colours: names #rrggbb, or arrays (..., 3) from 0 to 255."""
    a, b = (luminance(_rgb(colour)) for colour in (a, b))
    return (np.maximum(a, b) + 0.05) / (np.minimum(a, b) + 0.05)


def _rgb(colour):
    return list(bytes.fromhex(colour[1:])) if isinstance(colour, str) else colour


def painted(widget):
    """Return the pixels of a widget, (height, width, 3) from 0 to 255."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    return (
        np.array(image.constBits())
        .reshape(image.height(), -1)[:, : 3 * image.width()]
        .reshape(image.height(), image.width(), 3)
    )


def text_contrast(with_text, without_text):
    """Return the contrast of a text of `BLOCK`, painted, with the background, which a second painting shows."""
    assert with_text.shape == without_text.shape
    inked = (with_text != without_text).any(axis=2)
    assert inked.sum() > 40, "no text was painted"
    return float(np.median(contrast(with_text[inked], without_text[inked])))
