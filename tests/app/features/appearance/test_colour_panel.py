"""The colour panel by mouse and keys."""

from html import escape

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QLabel, QWidget

from hexmend.gallery import make
from hexmend.quality import METRICS, Metric
from hexmend_app.features.appearance.colour_panel import ColourPanel
from hexmend_app.features.appearance.feature import FeatureAppearance
from hexmend_app.picture.colours import Colours, Range
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import LEFT, brought, heard_from, key, named, open_mesh, pixels, press, type_text, walk_to


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
    return heard_from(panel.colours_changed)


def part(panel, name):
    return named(panel, QWidget, name)


def problem(panel):
    """Return the error shown for the limits, "" if there is none."""
    labels = panel.findChildren(QLabel)
    return " ".join(label.text() for label in labels if label.isVisible() and "xpected" in label.text())


def choose_range(panel, mode):
    QTest.mouseClick(part(panel, "Range").button(mode), LEFT)


def choose(combo, name):
    """Select an entry with the arrow keys."""
    combo.setFocus()
    while combo.currentData() != name:
        there, here = combo.findData(name), combo.currentIndex()
        QTest.keyClick(combo, Qt.Key.Key_Down if there > here else Qt.Key.Key_Up)


def type_in(box, text, *, enter=True):
    box.lineEdit().setFocus()
    type_text(box.lineEdit(), text)
    if enter:
        QTest.keyClick(box.lineEdit(), Qt.Key.Key_Return)


def test_every_metric_is_listed_with_its_description(panel):
    assert part(panel, "Metric").itemData(0) == "q"
    for name, metric in METRICS.items():
        at = part(panel, "Metric").findData(name)
        tip = part(panel, "Metric").itemData(at, Qt.ItemDataRole.ToolTipRole)
        assert escape(metric.source) in tip
        assert f"Acceptable from {metric.acceptable[0]:g} to" in tip
    tip = part(panel, "Metric").itemData(part(panel, "Metric").findData("long"), Qt.ItemDataRole.ToolTipRole)
    assert "1 to ∞" in tip
    assert "Lower is better" in tip


def test_each_choice_emits_one_signal(panel, emitted):
    choose(part(panel, "Metric"), "scaled-jacobian")
    choose(part(panel, "Colour map"), "cividis")
    choose_range(panel, "acceptable")
    QTest.mouseClick(part(panel, "Reverse"), LEFT, pos=QPoint(8, part(panel, "Reverse").height() // 2))
    assert emitted == [
        Colours(metric="scaled-jacobian"),
        Colours(metric="scaled-jacobian", map="cividis"),
        Colours(metric="scaled-jacobian", map="cividis", range=Range.ACCEPTABLE),
        Colours(metric="scaled-jacobian", map="cividis", range=Range.ACCEPTABLE, reverse=True),
    ]


def test_pinning_fixes_the_current_range(panel, emitted):
    choose_range(panel, "fitted")
    panel.set_ends(0.123456, 0.987654)
    assert not part(panel, "Minimum value").isEnabled()
    choose_range(panel, "pinned")
    assert emitted[-1].range == (0.123, 0.988)
    panel.set_ends(0, 1)  # of a later iteration
    assert (part(panel, "Minimum value").value(), part(panel, "Maximum value").value()) == (0.123, 0.988)


def test_a_number_being_typed_emits_no_signal(panel, emitted):
    choose_range(panel, "pinned")
    emitted.clear()
    type_in(part(panel, "Maximum value"), "0.35", enter=False)
    panel.set_ends(0.1, 0.2)  # an iteration is drawn meanwhile
    assert part(panel, "Maximum value").lineEdit().text() == "0.35"
    assert emitted == []
    QTest.keyClick(part(panel, "Maximum value").lineEdit(), Qt.Key.Key_Tab)
    assert [colours.range for colours in emitted] == [(0, 0.35)]


def test_invalid_limits_show_an_error_and_stay_as_typed(panel, emitted):
    choose_range(panel, "pinned")
    emitted.clear()
    for text, words in (("2", "the lower value first"), ("1e", "Expected a number"), ("1", "the lower value first")):
        type_in(part(panel, "Minimum value"), text)
        assert words in problem(panel)
        choose(part(panel, "Colour map"), "plasma")
        choose(part(panel, "Colour map"), "viridis")
        assert part(panel, "Minimum value").lineEdit().text() == text
    assert all(colours.range == (0, 1) for colours in emitted)
    type_in(part(panel, "Minimum value"), "-1e-1")
    assert emitted[-1].range == (-0.1, 1)
    assert problem(panel) == ""


def test_typed_limits_are_remembered_for_their_metric(panel, emitted):
    choose_range(panel, "pinned")
    type_in(part(panel, "Minimum value"), "0.25")
    choose(part(panel, "Metric"), "scaled-jacobian")
    assert emitted[-1].range is Range.FULL
    choose(part(panel, "Metric"), "q")
    choose_range(panel, "full")
    choose_range(panel, "pinned")
    assert emitted[-1].range == (0.25, 1)


# Colours by material.


@pytest.fixture
def host(hosted):
    hexes = {"low": np.arange(32), "high": np.arange(32, 64)}
    host = hosted(make("cube", size=64).replace(hex_sets=hexes))
    host.feature = FeatureAppearance(host)
    return host


@pytest.mark.parametrize("range", [Range.FULL, Range.ACCEPTABLE, Range.FITTED, (0.1, 0.5)])
def test_the_range_is_as_before_after_colours_by_material(host, range):
    view, panel = host.session.view, host.feature.panel
    view.change(colours={"metric": "q", "range": range})
    host.feature.refresh()
    for _ in (1, 2):
        panel.choose_metric("material")
        panel.choose_metric("q")
        assert (view.look.colours.metric, view.look.colours.range) == ("q", range)


def test_another_metric_after_the_material_has_a_range_of_its_own(host):
    view, panel = host.session.view, host.feature.panel
    view.change(colours={"metric": "q", "range": (0.1, 0.5)})
    host.feature.refresh()
    panel.choose_metric("material")
    panel.choose_metric("scaled-jacobian")
    assert view.look.colours.range is Range.FULL


def test_controls_of_values_are_disabled_for_materials(host):
    panel = host.feature.panel
    controls = [named(panel, QComboBox, "Colour map"), named(panel, Segmented, "Range")]
    panel.choose_metric("material")
    assert not any(control.isEnabled() for control in controls)
    panel.choose_metric("q")
    assert all(control.isEnabled() for control in controls)


# Appearance in the window: colours and their ranges.


@pytest.fixture
def front_panel(window, qtbot):
    """Return the colour panel, in front."""
    return brought(window, qtbot, "look", "appearance")


def differ(before, after):
    """Return the fraction of pixels that differ clearly."""
    return (np.abs(after - before).sum(axis=2) > 60).mean()


@pytest.mark.slow
def test_the_colours_by_metric_map_and_range(window, qtbot, front_panel):
    whole, bar = pixels(window), window.canvas.colour_bar
    walk_to(window, named(front_panel, QComboBox, "Metric"), "scaled-jacobian")
    assert window.session.view.look.colours.metric == "scaled-jacobian"
    assert "Scaled Jacobian from 0 to 1" in bar.accessibleDescription()
    recoloured = pixels(window)
    assert differ(whole, recoloured) > 0.05
    maps = named(front_panel, QComboBox, "Colour map")
    maps.setFocus()
    QTest.keyClick(maps, Qt.Key.Key_Down)
    assert differ(recoloured, pixels(window)) > 0.05
    low, high = (named(front_panel, QAbstractSpinBox, f"{end} value") for end in ("Minimum", "Maximum"))
    press(named(front_panel, QAbstractButton, "Range: Fitted"))
    assert f"from {low.value():g} to {high.value():g}" in bar.accessibleDescription()
    assert not low.isEnabled()
    start = window.session.document.now
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(lambda: window.session.document.now is not start)
    window.refresh()
    now = window.session.document.now.quality
    values = now.scaled_jacobian[~now.inverted]
    assert (low.value(), high.value()) == pytest.approx((values.min(), values.max()), abs=0.01)
    press(named(front_panel, QAbstractButton, "Range: Pinned"))
    assert window.session.view.look.colours.range == (low.value(), high.value())


@pytest.mark.slow
def test_a_click_on_a_material_in_the_legend_shows_only_its_hexes(window, qtbot, tmp_path):
    mesh = make("materials", size=200)
    open_mesh(qtbot, window, tmp_path / "two.vtu", mesh)
    window.features["appearance"].panel.choose_metric("material")
    window.refresh()
    names = next(label for label in window.canvas.colour_bar.findChildren(QLabel) if ">■</span> ball" in label.text())
    QTest.mouseClick(names, LEFT, pos=QPoint(30, names.fontMetrics().lineSpacing() // 2))
    balls = np.flatnonzero(mesh.materials.of_hex == mesh.materials.names.index("ball"))
    assert window.session.view.look.show.isolate.hexes == tuple(balls)
