"""Labels with links."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.plots import left_of_next
from hexmend_app.widgets.wording import figure, name_in_words, short_number


def test_a_link_is_followed_by_keys(shown, qtbot):
    panel, label = QWidget(), LinkLabel()
    QVBoxLayout(panel).addWidget(label)
    label.setText('Hexes: <a href="7">7</a>, <a href="1200">1,200</a>')
    shown(panel, 200, 60)
    with qtbot.waitActive(panel):
        panel.activateWindow()
    label.setFocus()
    QTest.keyClick(label, Qt.Key.Key_Tab)  # to the first link
    with qtbot.waitSignal(label.followed) as followed:
        QTest.keyClick(label, Qt.Key.Key_Return)
    assert followed.args == [7]


# Labels that elide their text.


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


# Texts of numbers and names.


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_short_number_is_parsed_as_the_same_value(value):
    assert float(short_number(value)) == value


@given(st.floats(min_value=-1e15, max_value=1e15))
def test_a_figure_is_close_to_its_value_and_fits_its_column(value):
    text = figure(value)
    assert float(text.replace(",", "").replace("−", "-")) == pytest.approx(value, rel=1e-3, abs=5.1e-5)
    assert len(text) <= 14


@given(st.from_regex(r"[a-z]+(_[a-z]+)*", fullmatch=True))
def test_a_name_in_words_has_no_underscores_and_keeps_its_letters(name):
    words = name_in_words(name)
    assert "_" not in words
    assert words.lower().startswith(name.replace("_", " "))


def test_a_value_that_is_not_finite_is_a_dash():
    assert figure(None) == figure(float("inf")) == figure(float("nan")) == "–"


# Tick texts that have a colour of their own stay clear of the other ones.


@pytest.mark.parametrize(
    ("left", "others", "expected"),
    [
        (10.0, [(80.0, 8.0), (120.0, 8.0)], 10.0),  # room enough
        (40.0, [(80.0, 8.0), (120.0, 8.0)], 26.0),  # 50 wide: it would end at 90
        (40.0, [(120.0, 8.0), (80.0, 8.0)], 26.0),  # whatever their order
        (40.0, [(10.0, 8.0)], 40.0),  # a text on the left does not push it
        (40.0, [], 40.0),
    ],
)
def test_a_text_moves_to_the_left_of_the_next_one(left, others, expected):
    rect = left_of_next(QRectF(left, 3, 50, 12), [QRectF(at, 3, width, 12) for at, width in others])
    assert rect == QRectF(expected, 3, 50, 12)
