"""Labels with links."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QGuiApplication, QImage, QShortcut, QTextDocument
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QToolButton, QVBoxLayout, QWidget

from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.wording import figure, name_in_words, short_number
from tests.app.driving import named


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


# Message bar: queue, repetitions, copying and dismissing.


_LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def window(shown):
    widget = QWidget()
    layout = QVBoxLayout(widget)
    widget.bar, widget.field = MessageBar(), QLineEdit()
    layout.addWidget(widget.bar)
    layout.addWidget(widget.field)
    layout.addStretch()
    return shown(widget, 420, 300)


@pytest.fixture
def bar(window):
    return window.bar


def test_messages_wait_behind_those_of_higher_priority(bar):
    bar.show_warning("careful")
    bar.show_error("broken")
    bar.show_warning("more careful")
    bar.show_info("done", timeout_ms=0)
    shown = []
    while bar.isVisible():
        shown.append(bar.title)
        QTest.mouseClick(named(bar, QToolButton, "Dismiss message"), _LEFT)
    assert shown == ["broken", "more careful", "careful", "done"]


def test_escape_dismisses_a_message_wherever_the_focus_is(window, bar):
    bar.show_warning("careful")
    window.field.setFocus()
    QTest.keyClick(window.field, Qt.Key.Key_Escape)
    assert not bar.isVisible()
    assert not bar.findChild(QShortcut).isEnabled()


def test_a_repeated_message_is_shown_once(bar):
    for _ in range(1000):
        bar.show_error("The view cannot be drawn", "Traceback")
    assert len(bar.messages()) == 1


def test_a_card_leaves_at_the_first_action_and_other_results_stay(bar):
    bar.show_card("bunny.vtk", "2,832 hexes", (), timeout_ms=0)
    assert not bar.takes_escape
    bar.leave_card()
    assert not bar.isVisible()
    bar.show_result("Saved", "", ())
    bar.leave_card()
    assert bar.isVisible()


def test_results_disappear_after_a_while_and_errors_stay(bar, qtbot):
    bar.show_info("Saved.", timeout_ms=30)
    qtbot.waitUntil(lambda: not bar.isVisible())
    bar.show_error("stays")
    assert bar.isVisible()
    assert not any(timer.isActive() for timer in bar.findChildren(QTimer))


def test_copy_copies_the_full_text_of_a_long_message(bar):
    text = "line\n" * 400
    bar.show_error("long", text)
    assert len(bar.text) < len(text)
    QTest.mouseClick(named(bar, QToolButton, "Copy message"), _LEFT)
    assert QGuiApplication.clipboard().text() == f"long\n{text}"


def test_markup_in_a_message_is_shown_as_plain_text(bar):
    bar.show_error("<b>a</b>", "vector<int>\nend")
    page = QTextDocument()
    page.setHtml(next(label.text() for label in bar.findChildren(QLabel) if label.text()))
    assert page.toPlainText().split() == ["<b>a</b>", "vector<int>", "end"]
