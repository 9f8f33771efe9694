"""What the colours show, chosen by mouse and keys."""

import dataclasses
from html import escape

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from hexmend.quality import METRICS, Metric
from hexmend_app.features.look.colour_panel import ColourPanel
from hexmend_app.scene.colours import MAPS
from hexmend_app.state.look import ColourScale, RangeMode

_LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def unbounded(monkeypatch):
    """A metric without an upper end, of which less is better."""
    bounds = (1.0, float("inf"))
    metric = Metric("long", "Long", "long / short", "nobody", bounds, bounds, -1, "None.", of=lambda *_: None)
    monkeypatch.setitem(METRICS._entries, "long", metric)
    return metric


@pytest.fixture
def panel(shown, unbounded):
    return shown(ColourPanel())


@pytest.fixture
def heard(panel):
    scales = []
    panel.scale_changed.connect(scales.append)
    return scales


def press(panel, mode):
    QTest.mouseClick(panel._mode.button(mode), _LEFT)


def choose(combo, name):
    """Walk to an entry with the arrow keys."""
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


def test_every_metric_is_offered_with_what_it_declares(panel):
    assert panel._metric.itemData(0) == "q"
    for name, metric in METRICS.items():
        at = panel._metric.findData(name)
        tip = panel._metric.itemData(at, Qt.ItemDataRole.ToolTipRole)
        assert escape(metric.source) in tip
        assert f"acceptable {metric.acceptable[0]:g} to" in tip
    tip = panel._metric.itemData(panel._metric.findData("long"), Qt.ItemDataRole.ToolTipRole)
    assert "1 to ∞" in tip
    assert "Less is better" in tip


def test_every_map_is_offered_with_a_swatch(panel):
    assert [panel._map.itemData(k) for k in range(panel._map.count())] == list(MAPS)
    assert all(not panel._map.itemIcon(k).isNull() for k in range(panel._map.count()))


def test_what_is_chosen_is_announced_once(panel, heard):
    choose(panel._metric, "scaled-jacobian")
    choose(panel._map, "cividis")
    press(panel, "acceptable")
    QTest.mouseClick(panel._reverse, _LEFT, pos=QPoint(8, panel._reverse.height() // 2))
    assert heard == [
        ColourScale("scaled-jacobian"),
        ColourScale("scaled-jacobian", "cividis"),
        ColourScale("scaled-jacobian", "cividis", RangeMode.ACCEPTABLE),
        ColourScale("scaled-jacobian", "cividis", RangeMode.ACCEPTABLE, reverse=True),
    ]


def test_ranges_without_bound_cannot_be_chosen(panel, heard):
    choose(panel._metric, "long")
    assert heard[-1].mode is RangeMode.FITTED
    for mode in ("full", "acceptable"):
        assert not panel._mode.button(mode).isEnabled()
        assert "without bound" in panel._mode.button(mode).toolTip()
        press(panel, mode)
    assert panel.scale().mode is RangeMode.FITTED
    choose(panel._metric, "q")
    assert panel._mode.button("full").isEnabled()


def test_pinning_holds_the_range_that_is_shown(panel, heard):
    press(panel, "fitted")
    panel.set_ends(0.123456, 0.987654)
    assert not panel._low.isEnabled()
    press(panel, "pinned")
    assert heard[-1].pinned == (0.123, 0.988)
    panel.set_ends(0, 1)  # of a later iteration
    assert (panel._low.value(), panel._high.value()) == (0.123, 0.988)


def test_a_half_typed_number_is_no_wish(panel, heard):
    press(panel, "pinned")
    heard.clear()
    type_in(panel._high, "0.35", enter=False)
    panel.set_ends(0.1, 0.2)  # a frame arrives meanwhile
    assert panel._high.lineEdit().text() == "0.35"
    assert heard == []
    QTest.keyClick(panel._high.lineEdit(), Qt.Key.Key_Tab)
    assert [scale.pinned for scale in heard] == [(0, 0.35)]


def test_numbers_that_are_no_range_are_said_and_stay_as_typed(panel, heard):
    press(panel, "pinned")
    heard.clear()
    for text, words in (("2", "the lower value first"), ("1e", "Expected a number"), ("1", "the lower value first")):
        type_in(panel._low, text)
        assert words in panel._problem.text()
        assert panel._problem.isVisible()
        choose(panel._map, "plasma")
        choose(panel._map, "viridis")
        assert panel._low.lineEdit().text() == text
    assert all(scale.pinned == (0, 1) for scale in heard)
    type_in(panel._low, "-1e-1")
    assert heard[-1].pinned == (-0.1, 1)
    assert not panel._problem.isVisible()


def test_arrow_keys_step_a_pinned_end(panel, heard):
    press(panel, "pinned")
    panel._high.lineEdit().setFocus()
    QTest.keyClick(panel._high, Qt.Key.Key_Down)
    assert heard[-1].pinned == (0, 0.9)


def test_ends_that_were_typed_are_found_again_for_their_metric_only(panel, heard):
    press(panel, "pinned")
    type_in(panel._low, "0.25")
    choose(panel._metric, "scaled-jacobian")
    assert heard[-1].mode is RangeMode.FULL
    choose(panel._metric, "q")
    press(panel, "full")
    press(panel, "pinned")
    assert heard[-1].pinned == (0.25, 1)


def test_what_is_set_is_shown_silently(panel, heard):
    scale = ColourScale("scaled-jacobian", "inferno", RangeMode.PINNED, (-0.5, 0.5), True)
    panel.set_scale(scale)
    assert heard == []
    assert panel.scale() == scale
    assert panel._metric.currentData() == "scaled-jacobian"
    assert panel._map.currentData() == "inferno"
    assert panel._mode.value() == "pinned"
    assert (panel._low.value(), panel._high.value()) == (-0.5, 0.5)
    assert panel._reverse.isChecked()


def test_a_scale_checks_its_range():
    for pinned in ((1, 1), (2, 1), (0, float("inf")), (float("nan"), 1)):
        with pytest.raises(ValueError, match="the lower first"):
            ColourScale(pinned=pinned)
    with pytest.raises(dataclasses.FrozenInstanceError):
        ColourScale().map = "plasma"
