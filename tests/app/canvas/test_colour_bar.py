"""Colour bar, checked by its pixels."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest

from hexmend_app.canvas.colour_bar import ColourBar


@pytest.fixture
def ramp():
    """A colour table in which each entry encodes its row number."""
    k = np.arange(256, dtype=np.uint8)
    return np.column_stack([k, 255 - k, np.full(256, 60, np.uint8)])


def pixels(widget):
    # Not grab(): its pixels have the screen's depth, which may be 16 bits.
    image = QImage(widget.size(), QImage.Format.Format_RGB32)
    widget.render(image)
    return np.array(
        [[image.pixelColor(x, y).getRgb()[:3] for x in range(image.width())] for y in range(image.height())]
    )


def test_the_gradient_shows_the_whole_table_in_order(shown, ramp):
    bar = ColourBar()
    bar.set_table(ramp)
    shown(bar, 90, 500)
    rgb = pixels(bar)
    of_table = (rgb[..., 2] == 60) & (rgb[..., 0].astype(int) + rgb[..., 1] == 255)
    along = [rgb[y, of_table[y], 0].max() for y in range(rgb.shape[0]) if of_table[y].sum() > 5][::-1]
    assert len(along) > 250
    assert np.all(np.diff(np.array(along, dtype=int)) >= 0)
    assert along[0] <= 2
    assert along[-1] >= 253


@pytest.mark.slow
@pytest.mark.usefixtures("qapp")
@given(st.floats(-1e7, 1e7), st.floats(-1e7, 1e7), st.floats(10, 2000))
def test_ticks_include_both_ends_and_labels_do_not_overlap(low, high, length):
    assume(high - low > 1e-6 * max(abs(low), abs(high), 1e-3))
    bar = ColourBar()
    bar.set_range(low, high)
    ticks = bar.ticks(length)
    assert (ticks[0], ticks[-1]) == (low, high)
    if len(ticks) > 2:
        assert np.diff(ticks).min() / (high - low) * length >= 1.9 * bar.fontMetrics().height()


def test_each_special_colour_has_a_swatch_below_the_gradient(shown, ramp):
    bar = ColourBar()
    bar.set_table(ramp)
    bar.set_range(-0.25, 0.25)
    kinds = [
        ("newly invalid", 3, (0x12, 0xAB, 0x34)),
        ("still invalid", 0, "#ab1234"),
        ("mended", 12, QColor("#3412ab")),
    ]
    bar.set_special(kinds)
    shown(bar, 130)
    rgb = pixels(bar)
    for colour in ((0x12, 0xAB, 0x34), (0xAB, 0x12, 0x34), (0x34, 0x12, 0xAB)):
        assert (rgb == colour).all(axis=2).sum() > 80
    assert bar.accessibleDescription() == ("newly invalid (3); still invalid; mended (12); q(H) from −0.25 to 0.25")
    bar.set_special(kinds[2:])
    assert bar.accessibleDescription().startswith("mended (12); q(H)")
    assert [one.isVisible() for one in bar.swatches] == [True, False, False]


def test_a_swatch_can_be_clicked_by_mouse_and_keys_unless_its_count_is_zero(shown):
    bar = ColourBar()
    bar.set_special([("newly invalid", 3, "#12ab34"), ("still invalid", 0, "#ab1234")])
    shown(bar, 130)
    asked = []
    bar.special_clicked.connect(asked.append)
    for swatch in bar.swatches:
        QTest.mouseClick(swatch, Qt.MouseButton.LeftButton)
    assert asked == ["newly invalid"]
    bar.swatches[0].setFocus()
    QTest.keyClick(bar.swatches[0], Qt.Key.Key_Space)
    assert asked == ["newly invalid"] * 2
    assert not bar.swatches[1].isEnabled()
