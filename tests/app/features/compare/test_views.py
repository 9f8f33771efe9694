"""Results of a comparison in views side by side, by mouse and keys."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from hexmend_app.features.compare.comparison_table import VIEW, title_of
from hexmend_app.picture.cut import Cut
from tests.app.driving import LEFT, drag, key, pixels, press, seen_at
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
    assert not model(compared).entries[row(compared, "laplacian")].shown
    assert [one.name for one in compared.session.snapshots.all] == [title_of("getme"), title_of("local-sd")]
    key(compared, Qt.Key.Key_W, Qt.KeyboardModifier.ControlModifier)
    assert captions(compared) == []
    assert compared.session.snapshots.all == ()


@pytest.mark.slow
def test_a_drag_rotates_all_views_and_a_click_selects_a_hex_in_all(compared, qtbot):
    tick(compared, "getme", VIEW)
    canvas, view = compared.canvas, compared.canvas.interactor
    canvas.draw_still()
    before = pixels(compared)
    half = before.shape[1] // 2
    right = QPoint(view.width() * 3 // 4, view.height() // 2)
    drag(view, right, right + QPoint(60, 20))
    canvas.draw_still()
    after = pixels(compared)
    for part in (after[:, :half] - before[:, :half], after[:, half:] - before[:, half:]):
        assert (np.abs(part).max(axis=2) > 40).mean() > 0.02
    assert compared.session.selection.hex is None
    QTest.mouseClick(view, LEFT, pos=right)
    compared.refresh()
    chosen = compared.session.selection.hex
    assert chosen is not None
    for one in canvas.panes.all:
        assert one.overlay_layers.selection.hex == chosen
        np.testing.assert_allclose(
            one.overlay_layers.selection.highlight.edges.lines.points,
            one.frame.mesh.points[one.frame.mesh.hexes[chosen]],
            rtol=1e-6,
        )
    tick(compared, "laplacian", VIEW)
    assert canvas.panes.all[2].overlay_layers.selection.hex == chosen


@pytest.mark.slow
@pytest.mark.parametrize("arranged", ["side by side", "wipe", "wipe, the mesh at the right"])
def test_a_plane_dragged_in_the_first_view_cuts_all_views(compared, qtbot, arranged):
    tick(compared, "getme", VIEW)
    if arranged != "side by side":
        compared.session.side_views.set_wiping(True)
        compared.session.side_views.move_wipe(0.9 if arranged == "wipe" else 0.1)
    if arranged == "wipe, the mesh at the right":
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
