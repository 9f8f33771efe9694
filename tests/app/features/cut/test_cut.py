"""Cuts in the window, by mouse and keys."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QPushButton, QSlider, QWidget

from hexmend_app.features.cut.cut_panel import CutPanel
from hexmend_app.picture import Box, Cut, CutStyle, Plane, Slab, Sphere
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import (
    LEFT,
    drag,
    heard_from,
    key,
    move,
    named,
    open_and_wait,
    open_mesh,
    pixels,
    press,
    seen_at,
    smooth,
    tick,
    write_picture,
)
from tests.core.grids import grid, scrambled


def moving(window):
    """Return the pixels of a moving view, which has other edges and shading than a still one."""
    window.canvas.changed()
    return pixels(window)


def choose(window, text):
    """Press one of the panel's buttons."""
    press(next(b for b in window.features["cut"].panel.findChildren(QPushButton) if b.text() == text))


def test_the_clipping_plane_by_check_box_axis_and_slider(window, qtbot):
    whole = moving(window)
    panel = window.features["cut"].panel
    tick(next(b for b in panel.findChildren(QCheckBox) if b.text() == "Cut"))
    assert window.session.view.look.cut.active
    assert window.window_actions["cut"].isChecked()
    for text in ("Y", "Smooth cut"):
        choose(window, text)
    clip = window.session.view.look.cut
    assert np.abs(clip.planes[0].normal).tolist() == [0, 1, 0]
    assert clip.style is CutStyle.SMOOTH
    halved = moving(window)
    assert (np.abs(halved - whole).sum(axis=2) > 60).mean() > 0.02
    slider = named(panel, QSlider, "Position")
    slider.setFocus()
    for _ in range(3):
        QTest.keyClick(slider, Qt.Key.Key_PageDown)
    assert window.session.view.look.cut.planes[0].point[1] != pytest.approx(clip.planes[0].point[1])
    key(window, Qt.Key.Key_C)
    assert window.session.view.look.cut == Cut()
    assert (np.abs(moving(window) - whole).sum(axis=2) > 60).mean() < 0.02


@pytest.mark.slow
def test_a_side_of_the_box_is_dragged_in_the_view(window, qtbot):
    key(window, Qt.Key.Key_C)
    choose(window, "Box")
    window.canvas.draw_still()
    before = window.session.view.look.cut
    assert before.box is not None
    (x0, y0, _), (x1, y1, z1) = before.box.low, before.box.high
    top = seen_at(window, ((x0 + x1) / 2, (y0 + y1) / 2, z1))
    drag(window.canvas.interactor, top, top + QPoint(0, -30))
    after = window.session.view.look.cut
    assert after.box.high[2] > z1
    assert after.box.low == pytest.approx(before.box.low)
    assert window.features["cut"].panel.cut() == after
    inside = moving(window)
    choose(window, "Inside")
    assert window.session.view.look.cut.notch
    assert (np.abs(moving(window) - inside).sum(axis=2) > 60).mean() > 0.1
    key(window, Qt.Key.Key_C)
    assert window.session.view.look.cut == Cut()


@pytest.mark.slow
def test_a_cut_switched_off_and_on_between_two_refreshes_is_shown_as_on(window):
    window.window_actions["cut"].trigger()
    window.refresh()
    box = named(window, QCheckBox, "Cut")
    assert box.isChecked()
    clip = window.session.view.look.cut
    box.click()
    window.session.view.set_cut(clip)
    window.refresh()
    assert box.isChecked()


@pytest.mark.slow
def test_the_sphere_is_moved_and_resized_in_the_view(window, qtbot):
    key(window, Qt.Key.Key_C)
    choose(window, "Sphere")
    window.canvas.draw_still()
    before = window.session.view.look.cut.sphere
    view, centre = window.canvas.interactor, np.array(before.centre)
    rim = seen_at(window, centre + (before.radius, 0, 0))
    inwards = seen_at(window, centre + (0.6 * before.radius, 0, 0))
    drag(view, rim, inwards)
    smaller = window.session.view.look.cut.sphere
    assert 0.4 * before.radius < smaller.radius < 0.9 * before.radius
    assert smaller.centre == pytest.approx(before.centre)
    window.refresh()
    at = seen_at(window, centre)
    drag(view, at, at + QPoint(0, -40))
    moved = window.session.view.look.cut.sphere
    assert moved.centre[2] > before.centre[2]
    assert moved.radius == pytest.approx(smaller.radius)


@pytest.mark.slow
def test_handles_are_hidden_while_a_small_part_of_the_mesh_is_isolated(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "bar.vtu", grid(9, 1, 1))
    key(window, Qt.Key.Key_C)
    for hexes, shown in (((3,), False), ((1, 2, 3, 4), True), ((6,), False), ((0, 8), True)):
        window.session.view.isolate(hexes)
        window.refresh()
        assert bool(window.canvas.plane.widget.GetEnabled()) is shown, hexes
    window.session.view.isolate((3,))
    window.session.view.end_isolation()
    window.refresh()
    assert window.canvas.plane.widget.GetEnabled()


def handle_at(window, state):
    """Move the pointer along two lines through the centre of the plane to the handle of a state; return the place."""
    view, shape = window.canvas.interactor, window.canvas.plane.widget.GetRepresentation()
    centre = seen_at(window, window.session.view.look.cut.planes[0].point)
    for distance in range(0, 400, 3):
        for x, y in ((0, -1), (1, 0), (-1, 0), (0, 1)):
            place = centre + QPoint(x, y) * distance
            move(view, place)
            if view.rect().contains(place) and shape.GetRepresentationState() == state:
                return place
    raise AssertionError(state)


@pytest.mark.slow
def test_the_arrow_and_the_wheel_push_the_plane_and_the_ring_rotates_it(window, qtbot):
    key(window, Qt.Key.Key_C)
    choose(window, "Z")
    window.session.view.set_snap(False)
    window.canvas.draw_still()
    view, shape = window.canvas.interactor, window.canvas.plane.widget.GetRepresentation()
    heights = []

    def plane():
        window.refresh()
        return window.session.view.look.cut.planes[0]

    arrow = handle_at(window, shape.Rotating)
    drag(view, arrow, arrow + QPoint(0, -30))
    heights.append(plane().point[2])
    place, camera = handle_at(window, shape.Rotating), window.canvas.viewport.camera.GetPosition()
    for turn in (120, -120):
        pixels, none = QPoint(), Qt.MouseButton.NoButton
        phase, keys = Qt.ScrollPhase.NoScrollPhase, Qt.KeyboardModifier.NoModifier
        event = QWheelEvent(QPointF(place), QPointF(place), pixels, QPoint(0, turn), none, keys, phase, False)
        QApplication.sendEvent(view, event)
        heights.append(plane().point[2])
    assert heights[0] < heights[1] > heights[2] == pytest.approx(heights[0])
    assert window.canvas.viewport.camera.GetPosition() == camera
    assert plane().normal == pytest.approx((0, 0, 1))
    ring = handle_at(window, shape.ResizeDiskRadius)
    drag(view, ring, ring + QPoint(0, -30))
    assert abs(plane().normal[2]) < 0.999


@pytest.mark.slow
def test_a_dragged_plane_is_released_where_the_pointer_leaves_the_view(window, qtbot):
    key(window, Qt.Key.Key_C)
    choose(window, "Z")
    window.canvas.draw_still()
    view, (x, y, z) = window.canvas.interactor, window.session.view.look.cut.planes[0].point
    place = seen_at(window, (x + 3, y - 3, z))
    move(view, place)
    QTest.mousePress(view, LEFT, pos=place)
    move(view, place + QPoint(0, -20), LEFT)
    move(view, QPoint(place.x(), -5), LEFT)
    left = window.session.view.look.cut
    assert left.planes[0].point[2] > z
    assert window.features["cut"].panel.cut() == left
    camera = window.canvas.viewport.camera.GetPosition()
    for _ in range(3):
        move(view, place + QPoint(0, 40), LEFT)
        move(view, place, LEFT)
    assert window.session.view.look.cut == left
    assert window.canvas.viewport.camera.GetPosition() == camera
    QTest.mouseRelease(view, LEFT, pos=place)


# Cuts by whole hexes made before the mesh moved: scenes, pictures and sessions restore the same hexes.


CUT = Cut.at((1, 0.3, 0), (2.1, 2.0, 2.0))


@pytest.fixture
def moved(window, qtbot, tmp_path):
    """Cut and then smooth a mesh; return a mask of the visible hexes, which differ from those of a new cut."""
    open_mesh(qtbot, window, tmp_path / "mesh.vtu", scrambled(grid(4), 0.9))
    window.session.view.set_cut(CUT)
    window.refresh()
    kept = window.canvas.viewport.kept()
    smooth(qtbot, window.session)
    window.refresh()
    np.testing.assert_array_equal(window.canvas.viewport.kept(), kept)
    window.features["save"].save_and_wait(tmp_path / "mesh.vtu")
    return kept


@pytest.mark.slow
def test_pictures_and_sessions_restore_the_cut_hexes(window, moved, qtbot, tmp_path):
    assert write_picture(window, tmp_path / "p.png", (200, 150))
    assert window.features["save"].save_and_wait(tmp_path / "work.hexmend")
    for name in ("p.png", "work.hexmend"):
        open_and_wait(qtbot, window, tmp_path / "mesh.vtu")
        window.session.view.set_cut(CUT)
        window.refresh()
        assert (window.canvas.viewport.kept() != moved).any()
        open_and_wait(qtbot, window, tmp_path / name)
        window.refresh()
        np.testing.assert_array_equal(window.canvas.viewport.kept(), moved)
    window.session.view.set_cut(CUT)  # a new cut
    window.refresh()
    assert (window.canvas.viewport.kept() != moved).any()


# The cut panel by mouse and keys.


_BOUNDS = np.array([[-1.0, 0.0, 2.0], [3.0, 30.0, 4.0]])
_BOX = QPoint(8, 8)


@pytest.fixture
def panel(shown):
    widget = shown(CutPanel())
    widget.set_bounds(_BOUNDS)
    return widget


@pytest.fixture
def emitted(panel):
    return heard_from(panel.cut_changed)


def part(panel, name):
    return named(panel, QWidget, name)


def switch_on(panel):
    QTest.mouseClick(named(panel, QCheckBox, "Cut"), LEFT, pos=_BOX)


@pytest.mark.parametrize(("key", "normal"), [("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))])
def test_axis_buttons_align_the_plane_and_centre_it(panel, emitted, key, normal):
    panel.set_cut(Cut.at((1, 2, 3), (0, 0, 2)))
    QTest.mouseClick(part(panel, "Axis").button(key), LEFT)
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
    QTest.mouseClick(part(panel, "Add plane"), LEFT)
    assert [plane.normal for plane in emitted[-1].planes] == [(1, 0, 0), (0, 1, 0)]
    assert (texts(panel), part(panel, "Plane").currentIndex()) == (["1", "2"], 1)
    QTest.keyClick(part(panel, "Position"), Qt.Key.Key_End)
    assert emitted[-1].planes[0].point == (1, 15, 3)
    assert emitted[-1].planes[1].point[1] == pytest.approx(30)
    with qtbot.waitSignal(panel.plane_chosen) as chosen:
        QTest.mouseClick(part(panel, "Plane"), LEFT, pos=part(panel, "Plane").tabRect(0).center())
    assert chosen.args == [0]
    assert part(panel, "Axis").value() == "x"
    QTest.mouseClick(part(panel, "Hide").button("all"), LEFT)
    assert emitted[-1].notch
    QTest.mouseClick(part(panel, "Remove plane"), LEFT)
    assert [plane.normal for plane in emitted[-1].planes] == [(0, 1, 0)]
    assert texts(panel) == ["1"]


def choose_kind(panel, key):
    switch_on(panel)
    QTest.mouseClick(part(panel, "Cut by").button(key), LEFT)


def type_into(panel, name, text):
    box = named(panel, NumberBox, name)
    box.setFocus()
    box.lineEdit().selectAll()
    QTest.keyClicks(box, text)


def test_a_box_is_typed_and_inverted(panel, emitted):
    choose_kind(panel, "box")
    assert emitted[-1] == Cut(box=Box((0, 7.5, 2.5), (2, 22.5, 3.5)))
    assert not part(panel, "Position").isVisible()
    type_into(panel, "Maximum Y of the box", "25")  # its first digit is less than the minimum
    QTest.mouseClick(part(panel, "Hidden side").button("all"), LEFT)
    box = emitted[-1]
    assert (box.box.low, box.notch) == ((0, 7.5, 2.5), True)
    assert box.box.high == (2, 25, 3.5)
    QTest.mouseClick(part(panel, "Cut by").button("planes"), LEFT)
    assert emitted[-1] == Cut.at((1, 0, 0), (1, 15, 3))
    QTest.mouseClick(part(panel, "Cut by").button("box"), LEFT)
    assert emitted[-1] == box


def test_a_slab_is_turned_moved_and_made_thicker(panel, emitted):
    choose_kind(panel, "slab")
    assert emitted[-1] == Cut(slab=Slab((1, 0, 0), point=(1, 15, 3), thickness=0.4))
    assert not named(panel, QPushButton, "Flip").isVisible()
    type_into(panel, "Thickness", "1.5")
    QTest.mouseClick(part(panel, "Axis").button("z"), LEFT)
    assert emitted[-1].slab == Slab((0, 0, 1), point=(1, 15, 3), thickness=1.5)
    QTest.keyClick(part(panel, "Position"), Qt.Key.Key_End)
    assert emitted[-1].slab.point[2] == pytest.approx(4)
    QTest.mouseClick(named(panel, Segmented, "Cut").button("smooth"), LEFT)
    assert emitted[-1].smooth
    QTest.mouseClick(part(panel, "Hidden side").button("all"), LEFT)
    assert emitted[-1].notch
    before = emitted[-1]
    QTest.mouseClick(part(panel, "Cut by").button("planes"), LEFT)
    assert emitted[-1].planes == (Plane((1, 0, 0), point=(1, 15, 3)),)
    QTest.mouseClick(part(panel, "Cut by").button("slab"), LEFT)
    assert emitted[-1] == before


def test_the_position_of_a_plane_is_typed(panel, emitted):
    choose_kind(panel, "planes")
    type_into(panel, "Position in mesh units", "2.25")
    assert emitted[-1] == Cut.at((1, 0, 0), (2.25, 15, 3))


def test_pages_that_are_hidden_change_their_own_cut(panel, emitted):
    choose_kind(panel, "planes")
    planes = emitted[-1]
    named(panel, NumberBox, "Minimum X of the box").stepBy(-1)
    named(panel, NumberBox, "Radius").stepBy(1)
    named(panel, NumberBox, "Thickness").stepBy(1)
    named(panel, NumberBox, "Maximum depth").stepBy(1)
    assert set(emitted) == {planes}
    QTest.mouseClick(part(panel, "Cut by").button("box"), LEFT)
    assert (emitted[-1].box.low[0], emitted[-1].box.high[0]) == (-1, 2)


def test_a_sphere_is_typed_and_has_whole_hexes(panel, emitted):
    choose_kind(panel, "planes")
    QTest.mouseClick(named(panel, Segmented, "Cut").button("smooth"), LEFT)
    QTest.mouseClick(part(panel, "Cut by").button("sphere"), LEFT)
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
