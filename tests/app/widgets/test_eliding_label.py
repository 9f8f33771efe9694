"""Labels that elide their text."""

import numpy as np
import pytest
from PySide6.QtGui import QImage

from hexmend_app.widgets.eliding_label import ElidingLabel

TEXT = "1,234 of 100,000 hexes shown"


def inked(label):
    """Return the columns of pixels that contain ink, (w,) bool."""
    image = label.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return np.ptp(rows[:, : image.width()], axis=0) > 60


@pytest.fixture
def label(qtbot):
    label = ElidingLabel(TEXT)
    qtbot.addWidget(label)
    return label


def test_it_keeps_its_text_and_paints_within_its_width(label):
    label.resize(label.sizeHint())
    whole = inked(label)
    label.resize(label.width() // 2, label.height())
    half = inked(label)
    assert label.text() == TEXT
    assert half.any()
    begin, end = slice(len(half) // 2), slice(len(half) * 2 // 3, len(half))
    np.testing.assert_array_equal(half[begin], whole[begin])
    assert (half[end] != whole[end]).any()  # an ellipsis
