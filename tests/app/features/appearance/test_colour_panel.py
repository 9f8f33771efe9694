"""The colour panel by mouse and keys."""

from html import escape

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel

from hexmend.quality import METRICS, Metric
from hexmend_app.features.appearance.colour_panel import ColourPanel
from hexmend_app.picture.colours import Colours, Range
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import named

_LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def unbounded(monkeypatch):
    """Register a metric without an upper bound, of which lower values are better."""
    bounds = (1.0, float("inf"))
    metric = Metric("long", "Long", "long / short", "nobody", bounds, bounds, -1, "None.", of=lambda *_: None)
    monkeypatch.setattr(METRICS, "_entries", {**METRICS, "long": metric})
    return metric


@pytest.fixture
def panel(shown, unbounded):
    return shown(ColourPanel())


@pytest.fixture
def emitted(panel):
    scales = []
    panel.colours_changed.connect(scales.append)
    return scales


def metrics(panel):
    return named(panel, QComboBox, "Metric")


def maps(panel):
    return named(panel, QComboBox, "Colour map")


def ranges(panel):
    return named(panel, Segmented, "Range")


def low(panel):
    return named(panel, NumberBox, "Minimum value")


def high(panel):
    return named(panel, NumberBox, "Maximum value")


def reverse(panel):
    return named(panel, QCheckBox, "Reverse")


def problem(panel):
    """Return the error shown for the limits, "" if there is none."""
    labels = panel.findChildren(QLabel)
    return " ".join(label.text() for label in labels if label.isVisible() and "xpected" in label.text())


def press(panel, mode):
    QTest.mouseClick(ranges(panel).button(mode), _LEFT)


def choose(combo, name):
    """Select an entry with the arrow keys."""
    combo.setFocus()
    while combo.currentData() != name:
        there, here = combo.findData(name), combo.currentIndex()
        QTest.keyClick(combo, Qt.Key.Key_Down if there > here else Qt.Key.Key_Up)


def type_in(box, text, *, enter=True):
    box.lineEdit().setFocus()
    box.lineEdit().selectAll()
    QTest.keyClicks(box.lineEdit(), text)
    if enter:
        QTest.keyClick(box.lineEdit(), Qt.Key.Key_Return)


def test_every_metric_is_listed_with_its_description(panel):
    assert metrics(panel).itemData(0) == "q"
    for name, metric in METRICS.items():
        at = metrics(panel).findData(name)
        tip = metrics(panel).itemData(at, Qt.ItemDataRole.ToolTipRole)
        assert escape(metric.source) in tip
        assert f"acceptable {metric.acceptable[0]:g} to" in tip
    tip = metrics(panel).itemData(metrics(panel).findData("long"), Qt.ItemDataRole.ToolTipRole)
    assert "1 to ∞" in tip
    assert "Lower is better" in tip


def test_each_choice_emits_one_signal(panel, emitted):
    choose(metrics(panel), "scaled-jacobian")
    choose(maps(panel), "cividis")
    press(panel, "acceptable")
    QTest.mouseClick(reverse(panel), _LEFT, pos=QPoint(8, reverse(panel).height() // 2))
    assert emitted == [
        Colours(metric="scaled-jacobian"),
        Colours(metric="scaled-jacobian", map="cividis"),
        Colours(metric="scaled-jacobian", map="cividis", range=Range.ACCEPTABLE),
        Colours(metric="scaled-jacobian", map="cividis", range=Range.ACCEPTABLE, reverse=True),
    ]


def test_pinning_fixes_the_current_range(panel, emitted):
    press(panel, "fitted")
    panel.set_ends(0.123456, 0.987654)
    assert not low(panel).isEnabled()
    press(panel, "pinned")
    assert emitted[-1].range == (0.123, 0.988)
    panel.set_ends(0, 1)  # of a later iteration
    assert (low(panel).value(), high(panel).value()) == (0.123, 0.988)


def test_a_number_being_typed_emits_no_signal(panel, emitted):
    press(panel, "pinned")
    emitted.clear()
    type_in(high(panel), "0.35", enter=False)
    panel.set_ends(0.1, 0.2)  # an iteration is drawn meanwhile
    assert high(panel).lineEdit().text() == "0.35"
    assert emitted == []
    QTest.keyClick(high(panel).lineEdit(), Qt.Key.Key_Tab)
    assert [colours.range for colours in emitted] == [(0, 0.35)]


def test_invalid_limits_show_an_error_and_stay_as_typed(panel, emitted):
    press(panel, "pinned")
    emitted.clear()
    for text, words in (("2", "the lower value first"), ("1e", "Expected a number"), ("1", "the lower value first")):
        type_in(low(panel), text)
        assert words in problem(panel)
        choose(maps(panel), "plasma")
        choose(maps(panel), "viridis")
        assert low(panel).lineEdit().text() == text
    assert all(colours.range == (0, 1) for colours in emitted)
    type_in(low(panel), "-1e-1")
    assert emitted[-1].range == (-0.1, 1)
    assert problem(panel) == ""


def test_typed_limits_are_remembered_for_their_metric(panel, emitted):
    press(panel, "pinned")
    type_in(low(panel), "0.25")
    choose(metrics(panel), "scaled-jacobian")
    assert emitted[-1].range is Range.FULL
    choose(metrics(panel), "q")
    press(panel, "full")
    press(panel, "pinned")
    assert emitted[-1].range == (0.25, 1)
