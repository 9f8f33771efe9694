"""The clipping plane set by mouse and keys."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QStyle, QStyleOptionSlider

from hexmend_app.state.look import ClipPlane
from hexmend_app.widgets.clip_panel import ClipPanel

_LEFT = Qt.MouseButton.LeftButton
_BOUNDS = (-1.0, 3.0, 0.0, 30.0, 2.0, 4.0)
_BOX = QPoint(8, 8)


@pytest.fixture
def panel(shown):
    widget = shown(ClipPanel())
    widget.set_bounds(_BOUNDS)
    return widget


@pytest.fixture
def heard(panel):
    planes = []
    panel.clip_changed.connect(planes.append)
    return planes


def switch_on(panel):
    QTest.mouseClick(panel._on, _LEFT, pos=_BOX)


def handle(slider):
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    return slider.style().subControlRect(
        QStyle.ComplexControl.CC_Slider, option, QStyle.SubControl.SC_SliderHandle, slider
    )


def test_without_a_mesh_nothing_can_be_clipped(shown):
    panel = shown(ClipPanel())
    assert not panel._on.isEnabled()
    assert panel.clip() is None


def test_switching_on_cuts_across_the_middle_and_off_again(panel, heard):
    switch_on(panel)
    assert heard == [ClipPlane((1, 0, 0), (1, 15, 3))]
    switch_on(panel)
    assert heard[1:] == [None]


@pytest.mark.parametrize(("key", "normal"), [("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))])
def test_axis_buttons_turn_the_plane_to_the_middle_of_the_mesh(panel, heard, key, normal):
    panel.set_clip(ClipPlane((1, 2, 3), (0, 0, 2)))
    QTest.mouseClick(panel._axis.button(key), _LEFT)
    assert heard == [ClipPlane(normal, (1, 15, 3))]


def test_dragging_the_slider_moves_the_plane_with_the_mouse(panel, heard):
    panel.set_clip(ClipPlane((0, 1, 0), (1, 15, 3)))
    slider = panel._slider
    start = handle(slider).center()
    QTest.mousePress(slider, _LEFT, pos=start)
    for dx in range(2, 42, 4):
        QTest.mouseMove(slider, start + QPoint(dx, 0))
    QTest.mouseRelease(slider, _LEFT, pos=start + QPoint(40, 0))
    places = [plane.origin[1] for plane in heard]
    assert len(places) > 3
    assert places == sorted(places)
    assert places[-1] > 17
    assert all(plane.normal == (0, 1, 0) for plane in heard)
    assert panel._value.text() == f"{places[-1]:.4g}"


def test_keys_move_the_plane_by_a_thousandth_and_to_the_ends(panel, heard):
    switch_on(panel)
    QTest.keyClick(panel._slider, Qt.Key.Key_Right)
    assert heard[-1].origin[0] == pytest.approx(1 + 4 / 1000)
    QTest.keyClick(panel._slider, Qt.Key.Key_End)
    assert heard[-1].origin[0] == pytest.approx(3)
    QTest.keyClick(panel._slider, Qt.Key.Key_Home)
    assert heard[-1].origin[0] == pytest.approx(-1)


@pytest.mark.parametrize(("place", "text"), [(-1.356e-5, "0"), (1e-6, "0"), (-0.02, "-0.02"), (1.356, "1.356")])
def test_a_position_next_to_zero_reads_zero(panel, place, text):
    panel.set_clip(ClipPlane((1, 0, 0), (place, 0, 0)))
    assert panel._value.text() == text


def test_flipping_hides_the_other_side_in_the_same_place(panel, heard):
    plane = ClipPlane((0, 1, 0), (1, 7, 3))
    panel.set_clip(plane)
    before = panel._slider.value()
    QTest.mouseClick(panel._flip, _LEFT)
    assert heard == [plane.flipped()]
    assert panel._slider.value() == before
    assert panel._axis.value() == "y"
    QTest.mouseClick(panel._flip, _LEFT)
    assert heard[-1] == plane


def test_the_cut_is_whole_or_smooth(panel, heard):
    switch_on(panel)
    QTest.mouseClick(panel._cut.button("smooth"), _LEFT)
    assert heard[-1].crinkle is False
    QTest.keyClick(panel._cut.button("smooth"), Qt.Key.Key_Left)
    assert panel._cut.value() == "crinkle"
    assert heard[-1].crinkle is True


def test_showing_the_plane_is_announced(panel, qtbot):
    switch_on(panel)
    with qtbot.waitSignal(panel.plane_shown_changed) as caught:
        QTest.mouseClick(panel._shown, _LEFT, pos=_BOX)
    assert caught.args == [False]


def test_a_dragged_plane_is_shown_free_and_silently(panel, heard):
    panel.set_clip(ClipPlane((1, 1, 0), (1, 15, 3), crinkle=False))
    assert panel._axis.value() == "free"
    assert panel._cut.value() == "smooth"
    panel.set_clip(None)
    panel.set_plane_shown(False)
    panel.set_bounds(None)
    assert heard == []


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1), st.integers(0, 1000))
def test_the_slider_sweeps_the_whole_mesh_whatever_the_normal(panel, normal, tick):
    corners = np.array([[x, y, z] for x in (-1, 3) for y in (0, 30) for z in (2, 4)], dtype=float)
    panel.set_clip(ClipPlane(normal, (0, 0, 0)))
    panel._slider.setValue(0)
    panel._slider.setValue(1)  # so that both ends are changes
    panel._slider.setValue(0)
    low = panel.clip().signed_distance(corners)
    panel._slider.setValue(1000)
    high = panel.clip().signed_distance(corners)
    assert min(np.abs(low).min(), np.abs(high).min()) < 1e-9
    assert np.all(low * high <= 1e-9)  # all of the mesh lies between the two ends
    panel._slider.setValue(tick)
    shown = panel.clip()
    panel.set_clip(shown)
    assert panel._slider.value() == tick
    assert panel.clip() == shown
