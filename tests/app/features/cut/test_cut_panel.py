"""The cut panel by mouse and keys."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QPushButton, QWidget
from superqt import QRangeSlider

from hexmend_app.features.cut.cut_panel import CutPanel
from hexmend_app.picture import Box, Cut, Plane, Slab, Sphere
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import heard_from, named

_LEFT = Qt.MouseButton.LeftButton
_BOUNDS = np.array([[-1.0, 0.0, 2.0], [3.0, 30.0, 4.0]])
_BOX = QPoint(8, 8)


@pytest.fixture
def panel(shown):
    widget = shown(CutPanel())
    widget.set_bounds(_BOUNDS)
    return widget


@pytest.fixture
def emitted(panel):
    planes = heard_from(panel.cut_changed)
    return planes


def part(panel, name):
    return named(panel, QWidget, name)


def switch_on(panel):
    QTest.mouseClick(named(panel, QCheckBox, "Cut"), _LEFT, pos=_BOX)


@pytest.mark.parametrize(("key", "normal"), [("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))])
def test_axis_buttons_align_the_plane_and_centre_it(panel, emitted, key, normal):
    panel.set_cut(Cut.at((1, 2, 3), (0, 0, 2)))
    QTest.mouseClick(part(panel, "Axis").button(key), _LEFT)
    assert emitted == [Cut.at(normal, (1, 15, 3))]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: np.linalg.norm(n) > 0.1), st.integers(0, 1000))
def test_the_slider_sweeps_the_whole_mesh_whatever_the_normal(panel, normal, tick):
    corners = np.array([[x, y, z] for x in (-1, 3) for y in (0, 30) for z in (2, 4)], dtype=float)
    panel.set_cut(Cut.at(normal, (0, 0, 0)))
    part(panel, "Position").setValue(0)
    part(panel, "Position").setValue(1)  # so that both ends are changes
    part(panel, "Position").setValue(0)
    low = panel.cut().planes[0].signed_distance(corners)
    part(panel, "Position").setValue(1000)
    high = panel.cut().planes[0].signed_distance(corners)
    assert min(np.abs(low).min(), np.abs(high).min()) < 1e-9
    assert np.all(low * high <= 1e-9)  # all of the mesh lies between the two ends
    part(panel, "Position").setValue(tick)
    shown = panel.cut()
    panel.set_cut(shown)
    assert part(panel, "Position").value() == tick
    assert panel.cut() == shown


def texts(panel):
    return [part(panel, "Plane").tabText(k) for k in range(part(panel, "Plane").count())]


def test_planes_are_added_selected_and_removed(panel, emitted, qtbot):
    switch_on(panel)
    assert not part(panel, "Remove plane").isEnabled()
    assert not part(panel, "Hide").isVisible()
    QTest.mouseClick(part(panel, "Add plane"), _LEFT)
    assert [plane.normal for plane in emitted[-1].planes] == [(1, 0, 0), (0, 1, 0)]
    assert (texts(panel), part(panel, "Plane").currentIndex()) == (["1", "2"], 1)
    QTest.keyClick(part(panel, "Position"), Qt.Key.Key_End)
    assert emitted[-1].planes[0].point == (1, 15, 3)
    assert emitted[-1].planes[1].point[1] == pytest.approx(30)
    with qtbot.waitSignal(panel.plane_chosen) as chosen:
        QTest.mouseClick(part(panel, "Plane"), _LEFT, pos=part(panel, "Plane").tabRect(0).center())
    assert chosen.args == [0]
    assert part(panel, "Axis").value() == "x"
    QTest.mouseClick(part(panel, "Hide").button("all"), _LEFT)
    assert emitted[-1].notch
    QTest.mouseClick(part(panel, "Remove plane"), _LEFT)
    assert [plane.normal for plane in emitted[-1].planes] == [(0, 1, 0)]
    assert texts(panel) == ["1"]


def test_a_box_is_moved_by_its_sliders_and_inverted(panel, emitted):
    switch_on(panel)
    QTest.mouseClick(part(panel, "Cut by").button("box"), _LEFT)
    assert emitted[-1] == Cut(box=Box((0, 7.5, 2.5), (2, 22.5, 3.5)))
    assert not part(panel, "Position").isVisible()
    sides = named(panel, QRangeSlider, "Y extent of the box")
    QTest.mouseClick(sides, _LEFT, pos=QPoint(sides.width() - 3, sides.height() // 2))
    QTest.mouseClick(part(panel, "Hidden side").button("all"), _LEFT)
    box = emitted[-1]
    assert (box.box.low, box.notch) == ((0, 7.5, 2.5), True)
    assert box.box.high[1] > 22.5
    assert (box.box.high[0], box.box.high[2]) == (2, 3.5)
    QTest.mouseClick(part(panel, "Cut by").button("planes"), _LEFT)
    assert emitted[-1] == Cut.at((1, 0, 0), (1, 15, 3))
    QTest.mouseClick(part(panel, "Cut by").button("box"), _LEFT)
    assert emitted[-1] == box


def choose_kind(panel, key):
    switch_on(panel)
    QTest.mouseClick(part(panel, "Cut by").button(key), _LEFT)


def type_into(panel, name, text):
    box = named(panel, NumberBox, name)
    box.setFocus()
    box.lineEdit().selectAll()
    QTest.keyClicks(box, text)


def test_a_slab_is_turned_moved_and_made_thicker(panel, emitted):
    choose_kind(panel, "slab")
    assert emitted[-1] == Cut(slab=Slab((1, 0, 0), point=(1, 15, 3), thickness=0.4))
    assert not named(panel, QPushButton, "Flip").isVisible()
    type_into(panel, "Thickness", "1.5")
    QTest.mouseClick(part(panel, "Axis").button("z"), _LEFT)
    assert emitted[-1].slab == Slab((0, 0, 1), point=(1, 15, 3), thickness=1.5)
    QTest.keyClick(part(panel, "Position"), Qt.Key.Key_End)
    assert emitted[-1].slab.point[2] == pytest.approx(4)
    QTest.mouseClick(named(panel, Segmented, "Cut").button("smooth"), _LEFT)
    assert emitted[-1].smooth
    QTest.mouseClick(part(panel, "Hidden side").button("all"), _LEFT)
    assert emitted[-1].notch
    before = emitted[-1]
    QTest.mouseClick(part(panel, "Cut by").button("planes"), _LEFT)
    assert emitted[-1].planes == (Plane((1, 0, 0), point=(1, 15, 3)),)
    QTest.mouseClick(part(panel, "Cut by").button("slab"), _LEFT)
    assert emitted[-1] == before


def test_pages_that_are_hidden_change_their_own_cut(panel, emitted):
    choose_kind(panel, "planes")
    planes = emitted[-1]
    named(panel, QRangeSlider, "X extent of the box").setValue((0, 1000))
    named(panel, NumberBox, "Radius").stepBy(1)
    named(panel, NumberBox, "Thickness").stepBy(1)
    named(panel, NumberBox, "Maximum depth").stepBy(1)
    assert set(emitted) == {planes}
    QTest.mouseClick(part(panel, "Cut by").button("box"), _LEFT)
    assert (emitted[-1].box.low[0], emitted[-1].box.high[0]) == (-1, 3)


def test_a_sphere_is_typed_and_has_whole_hexes(panel, emitted):
    choose_kind(panel, "planes")
    QTest.mouseClick(named(panel, Segmented, "Cut").button("smooth"), _LEFT)
    QTest.mouseClick(part(panel, "Cut by").button("sphere"), _LEFT)
    assert emitted[-1].crinkled
    assert not named(panel, Segmented, "Cut").isVisible()
    type_into(panel, "Centre Y", "7.25")
    type_into(panel, "Radius", "3")
    assert emitted[-1].sphere == Sphere((1, 7.25, 3), 3)
    type_into(panel, "Radius", "-1")
    assert emitted[-1].sphere.radius > 0


def test_numbers_that_are_dragged_are_shown_rounded_and_kept(panel, emitted):
    choose_kind(panel, "sphere")
    panel.set_cut(Cut(sphere=Sphere((1 / 3, 2 / 3, 3), 1 / 7)))
    assert named(panel, NumberBox, "Centre X").value() == 0.3333
    type_into(panel, "Radius", "0.123456")
    assert emitted[-1].sphere == Sphere((1 / 3, 2 / 3, 3), 0.123456)
    assert named(panel, NumberBox, "Radius").lineEdit().text() == "0.123456"
