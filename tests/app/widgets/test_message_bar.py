"""Message bar: queue, repetitions, copying and dismissing."""

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QGuiApplication, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QToolButton, QVBoxLayout, QWidget

from hexmend_app.widgets.message_bar import MessageBar
from tests.app.driving import named

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


def test_the_newest_error_is_shown_before_older_ones(bar):
    bar.show_error("first")
    bar.show_error("second")
    assert bar.title.text() == "second"
    assert named(bar, QToolButton, "Next message").text().startswith("1 of 2")
    QTest.mouseClick(named(bar, QToolButton, "Next message"), _LEFT)
    assert bar.title.text() == "first"
    bar.show_error("third")
    assert bar.title.text() == "third"
    for left in ("second", "first"):
        QTest.mouseClick(named(bar, QToolButton, "Dismiss message"), _LEFT)
        assert bar.title.text() == left
    assert not named(bar, QToolButton, "Next message").isVisible()
    QTest.mouseClick(named(bar, QToolButton, "Dismiss message"), _LEFT)
    assert not bar.isVisible()


def test_messages_wait_behind_those_of_higher_priority(bar):
    bar.show_warning("careful")
    bar.show_error("broken")
    bar.show_warning("more careful")
    bar.show_info("done", timeout_ms=0)
    shown = []
    while bar.isVisible():
        shown.append(bar.title.text())
        QTest.mouseClick(named(bar, QToolButton, "Dismiss message"), _LEFT)
    assert shown == ["broken", "more careful", "careful", "done"]


def test_escape_dismisses_a_message_wherever_the_focus_is(window, bar):
    bar.show_warning("careful")
    window.field.setFocus()
    QTest.keyClick(window.field, Qt.Key.Key_Escape)
    assert not bar.isVisible()
    assert not bar.findChild(QShortcut).isEnabled()


def test_a_repeated_message_is_counted(bar):
    for _ in range(1000):
        bar.show_error("The view cannot be drawn", "Traceback")
    assert len(bar.messages()) == 1
    assert "1000" in bar.title.text()


def test_results_disappear_after_a_while_and_errors_stay(bar, qtbot):
    bar.show_info("Saved.", timeout_ms=30)
    qtbot.waitUntil(lambda: not bar.isVisible())
    bar.show_error("stays")
    assert bar.isVisible()
    assert not any(timer.isActive() for timer in bar.findChildren(QTimer))


def test_copy_copies_the_full_text_of_a_long_message(bar):
    text = "line\n" * 400
    bar.show_error("long", text)
    assert len(bar.text.text()) < len(text)
    QTest.mouseClick(named(bar, QToolButton, "Copy message"), _LEFT)
    assert QGuiApplication.clipboard().text() == f"long\n{text}"


def test_markup_in_a_message_is_shown_as_plain_text(bar):
    bar.show_error("<b>a</b>", "vector<int>")
    assert bar.title.textFormat() == bar.text.textFormat() == Qt.TextFormat.PlainText


def test_emptied_is_emitted_once(bar, qtbot):
    ends = []
    bar.emptied.connect(lambda: ends.append(1))
    bar.show_error("a")
    bar.show_error("b")
    bar.clear()
    bar.dismiss()
    assert ends == [1]
