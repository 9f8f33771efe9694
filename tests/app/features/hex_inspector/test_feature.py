"""Selection of hexes and nodes in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox

from tests.app.driving import LEFT, drag, key, open_mesh, smooth, texts
from tests.core.boundary.solids import slid
from tests.core.grids import grid


def centre(window):
    return window.canvas.interactor.rect().center()


def click_view(window, modifier=Qt.KeyboardModifier.NoModifier, pos=None):
    """Click in the view and refresh the window."""
    QTest.mouseClick(window.canvas.interactor, LEFT, modifier, pos=centre(window) if pos is None else pos)
    window.refresh()


def test_a_click_in_the_view_selects_a_hex_and_a_drag_does_not(window, qtbot):
    window.show_panel("worst")
    click_view(window)
    chosen = window.session.selection.hex
    assert chosen is not None
    neighbours = window.session.document.now.mesh.topology.face_neighbours[chosen]
    assert (neighbours < 0).any()  # the visible hexes are at the surface
    assert window.in_front("hex")
    click_view(window, pos=QPoint(3, 3))
    assert window.session.selection.hex is None
    drag(window.canvas.interactor, centre(window), centre(window) + QPoint(40, 0))
    assert window.session.selection.hex is None


@pytest.mark.slow
def test_keys_step_through_the_worst_hexes_and_the_camera_follows(window, qtbot):
    camera = window.canvas.viewport.camera
    before = np.array(camera.GetFocalPoint())
    key(window, Qt.Key.Key_N)
    worst = window.session.selection.hex
    assert worst == window.features["hex_inspector"].worst_list.hexes[0]
    middle = window.session.document.now.mesh.points[window.session.document.now.mesh.hexes[worst]].mean(axis=0)
    qtbot.waitUntil(lambda: np.allclose(camera.GetFocalPoint(), middle))
    assert not np.allclose(before, middle)
    key(window, Qt.Key.Key_N)
    key(window, Qt.Key.Key_N, Qt.KeyboardModifier.ShiftModifier)
    assert window.session.selection.hex == worst
    assert window.session.view.look.show.isolate.hexes == (worst,)
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.show.isolate is None
    assert window.session.selection.hex == worst
    key(window, Qt.Key.Key_Escape)
    assert window.session.selection.hex is None


@pytest.mark.slow
def test_a_boundary_node_pinned_by_key_does_not_slide(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "slid.vtu", slid(grid(4), 0.3, seed=3))
    mesh = window.session.document.now.mesh
    middle = (grid(4).points == (2, 2, 4)).all(axis=1)  # of the top
    node = int(np.flatnonzero(middle)[0])
    h = np.flatnonzero((mesh.hexes == node).any(axis=1))[0]
    assert not window.window_actions["pin"].isEnabled()
    window.session.selection.choose(int(h), node)
    window.show_panel("hex")
    window.refresh()
    pin = next(b for b in window.features["hex_inspector"].panel.findChildren(QCheckBox) if b.text() == "Pinned")
    assert pin.isEnabled()
    assert not pin.isChecked()
    key(window, Qt.Key.Key_P, Qt.KeyboardModifier.ShiftModifier)
    assert pin.isChecked()
    assert window.window_actions["pin"].isChecked()
    assert any(f"Node {node}: boundary, pinned" in text for text in texts(window.features["hex_inspector"].panel))
    smooth(qtbot, window.session, "mend", 30, boundary="slide")
    moved = (window.session.document.now.mesh.points != mesh.points).any(axis=1)
    assert moved[mesh.topology.boundary].sum() > 20
    assert not moved[node]
    window.session.commands.undo()
    window.session.commands.undo()
    window.refresh()
    assert not pin.isChecked()


def test_ctrl_click_hides_a_hex_and_backspace_shows_it(window, qtbot):
    click_view(window)
    first = window.session.selection.hex
    click_view(window, Qt.KeyboardModifier.ControlModifier)
    assert window.session.view.look.show.hidden == {first}
    assert window.session.selection.hex is None
    window.canvas.draw_still()
    click_view(window)
    behind = window.session.selection.hex
    assert behind not in (None, first)
    key(window, Qt.Key.Key_Delete)
    assert window.session.view.look.show.hidden == {first, behind}
    key(window, Qt.Key.Key_Backspace)
    assert window.session.view.look.show.hidden == {first}
    key(window, Qt.Key.Key_Backspace)
    assert not window.session.view.look.show.hidden


# Pinning all nodes outside the isolated hexes and the rings around them.


@pytest.mark.slow
def test_only_the_isolated_region_is_free_until_undo(window):
    session = window.session
    mesh = session.document.now.mesh
    session.view.isolate([40], 1)
    window.refresh()
    assert window.window_actions["free_isolated"].isEnabled()
    window.window_actions["free_isolated"].trigger()
    expected = np.zeros(mesh.n_nodes, dtype=bool)
    expected[mesh.hexes[mesh.topology.hexes_around([40], 1)]] = True
    np.testing.assert_array_equal(session.document.now.mesh.free, expected & mesh.free)
    assert session.document.undo_title == "free a region"
    session.commands.undo()
    np.testing.assert_array_equal(session.document.now.mesh.free, mesh.free)
