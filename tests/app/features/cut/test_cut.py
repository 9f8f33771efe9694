"""Cuts in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QPushButton, QSlider

from hexmend_app.picture import Cut, CutStyle
from tests.app.driving import (
    LEFT,
    drag,
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


def press_plane(window):
    """Press the mouse on a horizontal plane and begin a drag; return the view, the place and the height before."""
    key(window, Qt.Key.Key_C)
    choose(window, "Z")
    window.canvas.draw_still()
    view, (x, y, z) = window.canvas.interactor, window.session.view.look.cut.planes[0].point
    place = seen_at(window, (x + 3, y - 3, z))
    move(view, place)
    QTest.mousePress(view, LEFT, pos=place)
    move(view, place + QPoint(0, -20), LEFT)
    return view, place, z


@pytest.mark.slow
def test_a_dragged_plane_is_released_where_the_pointer_leaves_the_view(window, qtbot):
    view, place, z = press_plane(window)
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
    assert window.features["save"].picture(tmp_path / "p.png", (200, 150))
    assert window.features["session"].save_and_wait(tmp_path / "work.hexmend")
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
