"""Sessions contain the settings of panels and the pose history: another window restores them."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTableView

from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.picture.cut_shapes import Box, Depth, DepthUnit, Slab, Sphere
from tests.app.conftest import close, window_with_mesh
from tests.app.driving import key, named, open_and_wait
from tests.app.test_resetting import known, live
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow

#: What there is to compare of two windows besides their widgets, and what of it is a run's, a setting's, or of the place of panels.
_KEPT = ("session.", "camera ", "look that", "hexes that", "action ")
_NOT_KEPT = (
    "session.boundary_classifier", "session.run_setup.active_stage", "session.run.record", "session.run.advice", "session.run.work",
    "session.run.phase", "session.run.outcome", "session.run.pace", "action panel", "action drawer",
    "action pace",
)  # fmt: skip


@pytest.fixture
def other_window(qtbot, mesh_file, fresh_window):
    """A second window."""
    window = window_with_mesh(qtbot, mesh_file)
    yield window
    close(window)


def at_rest(window, qtbot):
    window.refresh()
    qtbot.waitUntil(lambda: window.canvas.camera_animation.at_rest, timeout=PATIENCE)
    window.messages.clear()
    window.refresh()


def seen(window, qtbot):
    """Return the state that a session must restore: the session, the view and the actions."""
    at_rest(window, qtbot)
    return sorted(line for line in known(window, qtbot) if line.startswith(_KEPT) and not line.startswith(_NOT_KEPT))


def saved(window, tmp_path):
    path = tmp_path / "work.hexmend"
    assert window.features["session"].save_and_wait(path)
    return path


def test_a_session_restores_the_whole_window(fresh_window, other_window, qtbot, tmp_path):
    """All settings differ from the defaults."""
    window, other = fresh_window, other_window
    live(window, qtbot)
    compare = window.features["compare"].panel
    table = named(compare, QTableView, "Comparison of methods")
    table.sortByColumn(3, Qt.SortOrder.DescendingOrder)
    ticked = table.model().index(1, 0)
    table.model().setData(ticked, Qt.CheckState.Checked, Qt.ItemDataRole.CheckStateRole)
    for record in window.session.history.records[:1]:
        window.features["convergence"].panel.legend.toggled.emit(record, False)
    saved(window, tmp_path)  # the camera fits the view anew beneath the message
    at_rest(window, qtbot)
    path = saved(window, tmp_path)
    states = window.session.feature_states.to_data()
    before = seen(window, qtbot)
    open_and_wait(qtbot, other, path)
    at_rest(other, qtbot)
    assert other.session.feature_states.to_data() == states
    assert [r.plotted for r in other.session.history.records] == [r.plotted for r in window.session.history.records]
    assert [r.slot for r in other.session.history.records] == [r.slot for r in window.session.history.records]
    assert seen(other, qtbot) == before


def test_the_pose_history_is_restored(window, qtbot, tmp_path):
    poses = []
    for direction in ("+x", "-y", "+z"):
        window.canvas.look_along(direction)
        at_rest(window, qtbot)
        poses.append(window.canvas.pose)
    key(window, Qt.Key.Key_Left, Qt.KeyboardModifier.AltModifier)
    at_rest(window, qtbot)
    path = saved(window, tmp_path)
    window.canvas.look_along("iso")
    open_and_wait(qtbot, window, path)
    at_rest(window, qtbot)
    assert window.canvas.pose == poses[1]
    for action, pose in (("view_forward", poses[2]), ("view_back", poses[1]), ("view_back", poses[0])):
        assert window.action(action).isEnabled()
        window.action(action).trigger()
        at_rest(window, qtbot)
        assert window.canvas.pose.position == pytest.approx(pose.position)
    window.action("view_forward").trigger()
    assert window.action("view_forward").isEnabled()


def test_a_disabled_cut_is_restored(window, qtbot, tmp_path, mesh_file):
    view = window.session.view
    box = Cut(box=Box((0.1, 0.1, 0.1), (0.4, 0.4, 0.4)), style=CutStyle.SMOOTH)
    slab = Cut(slab=Slab((0, 1, 0), point=(1, 2, 3), thickness=0.5), notch=True)
    sphere, depth = Cut(sphere=Sphere((1, 2, 3), 0.5)), Cut(depth=Depth(0.5, 3, DepthUnit.EDGES))
    for clip in (Cut.at((1, 2, 3), (0.5, 0.5, 0.5)), slab, sphere, depth, box):
        view.set_cut(clip)
        window.refresh()
    view.set_cut(Cut())
    window.refresh()
    path = saved(window, tmp_path)
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    open_and_wait(qtbot, window, path)
    window.refresh()
    assert view.look.cut == Cut()
    window.action("cut").trigger()
    assert view.look.cut == box


@pytest.mark.parametrize(("part", "field", "value", "said"), [
    ("charts", "shown", ["objective", "taste"], "there is no chart 'taste'"),
    ("worst", "metric", "taste", "there is no metric 'taste'"),
    ("compare", "ticked", ["taste"], "there is no method 'taste'"),
    ("compare", "sorted_by", "taste", "there is no column 'taste'"),
    ("histogram", "bins", "many", "the window.features.histogram.bins is of another type"),
    ("histogram", "bins", 10**20, "the number of bins is not from 1 to 1,000,000"),
    ("cut", "colour", 1, "the window.features.cut has an unknown field 'colour'"),
])  # fmt: skip
def test_unknown_settings_are_rejected(window, qtbot, tmp_path, part, field, value, said):
    path = saved(window, tmp_path)
    data = read_archive(path, "Hexmend session", VERSION)
    data["window"]["features"][part][field] = value
    write_archive(path, "Hexmend session", VERSION, data)
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(path)
    assert said in window.messages.messages()[-1][2]
