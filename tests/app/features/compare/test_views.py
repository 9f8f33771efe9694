"""Results of a comparison in views side by side, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.features.compare.comparison_table import VIEW, title_of
from hexmend_app.features.side_views.feature import STEP
from hexmend_app.picture.cut import Cut
from tests.app.driving import drag, key, pixels, press, seen_at
from tests.app.features.compare.table import captions, model, row, tick


def test_results_are_shown_next_to_the_mesh_and_named_in_the_histogram(compared):
    for count, name in enumerate(("getme", "laplacian", "local-sd"), 2):
        tick(compared, name, VIEW)
        assert len(compared.canvas.panes.all) == count
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    assert [one.name for one in compared.session.snapshots.all] == [
        title_of("getme"),
        title_of("laplacian"),
        title_of("local-sd"),
    ]
    series = compared.features["histogram"].panel.series()
    assert [one.name for one in series][2:] == [title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    initial = model(compared).index(0, VIEW)
    assert not model(compared).flags(initial) & Qt.ItemFlag.ItemIsEnabled  # four views are open
    tick(compared, "initial", VIEW)
    assert len(compared.canvas.panes.all) == 4
    for view, name in zip(compared.canvas.panes.all[1:], ("getme", "laplacian", "local-sd"), strict=True):
        state = compared.session.comparison.of(name).state
        np.testing.assert_array_equal(view.frame.mesh.points, state.mesh.points)


@pytest.mark.slow
def test_one_view_is_closed_by_its_button_and_all_by_a_key(compared):
    for name in ("getme", "laplacian", "local-sd"):
        tick(compared, name, VIEW)
    crosses = [
        b
        for b in compared.findChildren(QToolButton)
        if b.accessibleName() == f"Close the view of {title_of('laplacian')}"
    ]
    press(next(cross for cross in crosses if cross.isVisible()))
    assert captions(compared) == ["now", title_of("getme"), title_of("local-sd")]
    assert not model(compared).rows[row(compared, "laplacian")].shown
    assert [one.name for one in compared.session.snapshots.all] == [title_of("getme"), title_of("local-sd")]
    key(compared, Qt.Key.Key_W, Qt.KeyboardModifier.ControlModifier)
    assert captions(compared) == []
    assert compared.session.snapshots.all == ()


@pytest.mark.slow
@pytest.mark.parametrize("wiping", [False, True], ids=["side by side", "wipe, the mesh at the right"])
def test_a_plane_dragged_in_the_first_view_cuts_all_views(compared, qtbot, wiping):
    tick(compared, "getme", VIEW)
    if wiping:
        compared.session.side_views.set_wiping(True)
        compared.session.side_views.move_wipe(0.1)
        compared.session.side_views.choose_wiped(1, 0)
    centre = compared.session.document.now.mesh.points.mean(axis=0)
    compared.session.view.set_cut(Cut.at((0, 0, 1), tuple(centre)))
    compared.refresh()
    QApplication.processEvents()  # the row of the wipe makes the view smaller
    pixels(compared)
    x, y, z = compared.session.view.look.cut.planes[0].point
    place = seen_at(compared, (x + 4, y - 4, z))  # on the plane, next to its arrow
    before = compared.canvas.panes.all[1].shown
    drag(compared.canvas.interactor, place, place + QPoint(0, -30))
    assert compared.session.view.look.cut.planes[0].point[2] > z
    compared.refresh()
    first, second = compared.canvas.panes.all
    assert second.shown == first.shown != before


# The wipe: two results in one view with an edge to drag.


@pytest.mark.slow
def test_the_wipe_is_switched_and_moved_by_mouse_and_keys(compared, qtbot):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    key(compared, Qt.Key.Key_W)
    wipe, handle = compared.session.side_views.wipe, compared.findChild(WipeHandle)
    assert (wipe.left, wipe.right, wipe.at) == (0, 2, 0.5)
    assert handle.isVisible()
    assert captions(compared) == []
    width = compared.canvas.interactor.width()
    knob = handle.rect().center()
    drag(handle, knob, knob + QPoint(-width // 5, 0), steps=1)
    assert compared.session.side_views.wipe.at == pytest.approx(0.3, abs=0.01)
    assert handle.geometry().center().x() == pytest.approx(0.3 * width, abs=3)
    at = compared.session.side_views.wipe.at
    key(compared, Qt.Key.Key_BracketRight)
    assert compared.session.side_views.wipe.at == pytest.approx(at + STEP)
    handle.setFocus()
    QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert compared.session.side_views.wipe.at == pytest.approx(at)
    key(compared, Qt.Key.Key_W)
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian")]
    assert not handle.isVisible()
