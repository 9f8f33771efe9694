"""Interactions of features: another mesh, another cut or a run in the middle of an operation."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QTableWidget

from benchmarks.window.windows import end_run
from hexmend import io
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure, summarise
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.picture.cut_shapes import Box, Plane
from hexmend_app.scene.layers import mesh as mesh_layer
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, click, key, move, open_and_wait, phase, pixels
from tests.app.features.cut.test_cut import seen_at
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def middle(window):
    return tuple(window.session.document.now.mesh.points.mean(axis=0))


def test_nothing_changes_the_mesh_while_another_is_read(window, qtbot, tmp_path):
    io.write(tmp_path / "small.vtu", scrambled(grid(3), 0.3))
    window.session.selection.choose(7)
    window.session.commands.tag("before", [7])
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "small.vtu")
        before = window.session.document.now
        window.refresh()
        assert not any(window.window_actions[id].isEnabled() for id in ("run", "step", "reset", "undo"))
        assert not window.features["smooth"].panel.isEnabled()
        window.features["smooth"].panel.run_requested.emit(Stage(METHODS["laplacian"](), StoppingCriteria()))
        window.session.commands.tag("late", [8])
        window.session.commands.undo()
        assert window.session.document.now is before
        assert not window.session.run.busy
    assert window.session.document.now is window.session.document.start
    assert window.session.document.now.mesh.n_hexes == 27
    window.refresh()
    assert window.window_actions["run"].isEnabled()
    assert window.features["smooth"].panel.isEnabled()


def test_a_tag_is_not_renamed_while_a_run_is_paused(window, qtbot):
    window.session.commands.tag("one", [1])
    choose(window, "laplacian")
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    window.refresh()
    table = window.features["tags"].panel.findChild(QTableWidget)
    assert table.editTriggers() == QTableWidget.EditTrigger.NoEditTriggers
    table.item(0, 0).setText("two")  # in an editor that was open before
    assert table.item(0, 0).text() == "one"
    end_run(window.session)
    window.refresh()
    table.item(0, 0).setText("two")
    assert list(window.session.document.now.mesh.hex_sets) == ["two"]


@pytest.mark.parametrize("notch", [False, True])
def test_hexes_removed_by_a_smooth_cut_are_not_tagged_as_shown(window, notch):
    cut = Cut(
        (Plane((1, 0, 0), point=middle(window)), Plane((0, 1, 0), point=middle(window))),
        style=CutStyle.SMOOTH,
        notch=notch,
    )
    window.session.view.set_cut(cut)
    window.refresh()
    window.features["tags"].panel.shown_requested.emit("shown")
    mesh = window.session.document.now.mesh
    heights = np.array([plane.signed_distance(mesh.points)[mesh.hexes].min(axis=1) for plane in cut.planes])
    gone = (heights > 0).all(axis=0) if notch else (heights > 0).any(axis=0)
    assert 0 < gone.sum() < mesh.n_hexes
    assert mesh.hex_sets["shown"].tolist() == np.flatnonzero(~gone).tolist()


def test_the_box_can_be_dragged_again_after_an_interrupted_drag(window, qtbot):
    size = np.ptp(window.session.document.now.mesh.points, axis=0)
    low = window.session.document.now.mesh.points.min(axis=0)
    box = Cut(box=Box(tuple(low + 0.2 * size), tuple(low + 0.8 * size)))
    window.session.view.set_cut(box)
    pixels(window)
    view = window.canvas.interactor
    place = seen_at(window, (*(low + 0.5 * size)[:2], (low + 0.8 * size)[2]))
    move(view, place)
    QTest.mousePress(view, LEFT, pos=place)
    for k in range(1, 8):
        move(view, place + QPoint(0, 4 * k), LEFT)
    assert window.session.view.look.cut != box
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_C)
    QTest.mouseRelease(view, LEFT, pos=place)
    other = Cut(box=Box(tuple(low), tuple(low + 0.5 * size)))
    window.refresh()
    window.session.view.set_cut(other)
    window.refresh()
    np.testing.assert_allclose(window.canvas.box.corners, [other.box.low, other.box.high])
    window.session.view.set_cut(box)
    pixels(window)
    for k in range(6):
        move(view, place - QPoint(0, 4 * k))
    assert window.session.view.look.cut == box  # no button is held any more


def test_the_chosen_plane_is_still_the_one_after_the_cut_was_off_or_a_box(window):
    planes = tuple(Plane(tuple(normal.tolist()), point=middle(window)) for normal in np.eye(3))
    window.session.view.set_cut(Cut(planes))
    window.session.view.choose_plane(2)
    for other in (Cut(), Cut(box=Box((0, 0, 0), (1, 1, 1)))):
        window.session.view.set_cut(other)
        window.session.view.set_cut(Cut(planes))
        assert window.session.view.plane_at == 2
    window.session.view.set_cut(Cut(planes[:1]))
    assert window.session.view.plane_at == 0


def test_a_mesh_in_other_units_opens_after_a_cut(window, qtbot, tmp_path):
    window.session.view.set_cut(Cut.at((0, 1, 0), middle(window)))
    mesh = scrambled(grid(3), 0.3)
    for scale in (1e-9, 1e9):
        io.write(tmp_path / f"{scale}.vtu", mesh.with_points(scale * mesh.points))
        open_and_wait(qtbot, window, tmp_path / f"{scale}.vtu")
        key(window, Qt.Key.Key_C)
        assert 0 < window.canvas.viewport.shown < mesh.n_hexes


def test_a_cut_begins_in_the_mesh_however_far_unused_nodes_are(window, qtbot, tmp_path):
    mesh = scrambled(grid(3), 0.3)
    stray = Mesh(np.concatenate([mesh.points, [[1e4, 1e4, 1e4]]]), mesh.hexes)
    io.write(tmp_path / "stray.vtu", stray)
    open_and_wait(qtbot, window, tmp_path / "stray.vtu")
    key(window, Qt.Key.Key_C)
    assert 0 < window.canvas.viewport.shown < mesh.n_hexes


def test_a_picture_has_the_hexes_of_the_view_after_nodes_moved(window, tmp_path):
    window.session.view.set_cut(Cut.at((1, 0, 0), middle(window)))
    window.refresh()
    mesh = window.session.document.now.mesh
    moved = mesh.with_points(mesh.points + (np.ptp(mesh.points), 0, 0))
    figures = measure(moved.points, moved.hexes)
    window.session.document.commit("shift", State(moved, figures, summarise(moved, figures)))
    window.refresh()
    window.canvas.fit()
    window.canvas.viewport.camera.SetFocalPoint(moved.points.mean(axis=0))
    window.session.view.change(show={"outline": False})
    window.refresh()
    assert window.canvas.viewport.shown > 0
    window.features["save"].picture(tmp_path / "seen.png", (200, 120))
    assert np.ptp(np.asarray(Image.open(tmp_path / "seen.png"))[:, 60:].astype(int)[..., :3], axis=2).max() > 60


def _found(view, place):
    hit = view.pick(*place)
    return hit and (hit.hex, hit.node)


def test_a_click_with_a_small_movement_selects_the_hex_under_it(window, qtbot, monkeypatch):
    monkeypatch.setattr(mesh_layer, "MANY", 10)
    view = window.canvas.viewport
    window.canvas.draw_still()
    width, height = window.canvas.interactor.render_window.GetSize()
    places = [(width * x, height * y) for x in (0.4, 0.45, 0.5, 0.55) for y in (0.4, 0.5, 0.6)]
    exact = [_found(view, place) for place in places]
    assert any(exact)
    for place, hit in zip(places, exact, strict=True):
        view.still()
        view.turning()
        assert _found(view, place) == hit
