"""Sessions contain the settings of panels and the pose history: another window restores them."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTableView

from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from tests.app.driving import named, open_and_wait
from tests.app.features.session.test_feature import work
from tests.app.test_resetting import live, session_of

pytestmark = pytest.mark.slow


def at_rest(window, qtbot):
    window.refresh()
    qtbot.waitUntil(lambda: window.canvas.camera_animation.at_rest)
    window.messages.clear()
    window.refresh()


def saved(window, tmp_path):
    path = tmp_path / "work.hexmend"
    assert window.features["save"].save_and_wait(path)
    return path


def test_a_session_restores_the_whole_window(window, fresh_window, qtbot, tmp_path):
    """All settings differ from the defaults."""
    work(window, qtbot)
    live(window, qtbot)
    compare = window.features["compare"].panel
    table = named(compare, QTableView, "Comparison of methods")
    table.sortByColumn(3, Qt.SortOrder.DescendingOrder)
    ticked = table.model().index(1, 0)
    table.model().setData(ticked, Qt.CheckState.Checked, Qt.ItemDataRole.CheckStateRole)
    for record in window.session.history.records[:1]:
        window.features["convergence"].panel.runs.toggled.emit(record, False)
    saved(window, tmp_path)  # the camera fits the view anew beneath the message
    at_rest(window, qtbot)
    path = saved(window, tmp_path)
    before = session_of(window, tmp_path / "before.hexmend")
    open_and_wait(qtbot, fresh_window, path)
    at_rest(fresh_window, qtbot)
    np.testing.assert_equal(session_of(fresh_window, tmp_path / "after.hexmend"), before)


INVALID = [
    ("charts", "taste", True, "'taste' is unknown: expected log, by_time"),
    ("worst", "metric", "taste", "metric = 'taste' is not among its values"),
    ("compare", "ticked", ["taste"], "there is no method or column 'taste'"),
    ("histogram", "bins", "many", "bins = 'many' is not among its values"),
    ("histogram", "bins", 10**20, f"bins = {10**20} is not among its values"),
    ("cut", "colour", 1, "[cut] has an unknown key 'colour'"),
]  # fmt: skip


def written(path, place, field, value):
    """Change a value in a session file, and return the path of the changed file."""
    data = read_archive(path, "Hexmend session", VERSION)
    part = data["window"]
    for name in place:
        part = part[name]
    part[field] = value
    invalid = path.with_name("invalid.hexmend")
    write_archive(invalid, "Hexmend session", VERSION, data)
    return invalid


def test_an_invalid_session_is_rejected_and_the_open_mesh_stays(window, qtbot, tmp_path):
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(written(saved(window, tmp_path), ("view", "look"), "colour", "red"))
    assert window.session.document.now is now
    assert "[view] look has an unknown key 'colour'" in window.messages.messages()[-1][2]


def test_an_invalid_part_of_a_feature_is_left_out(window, qtbot, tmp_path):
    path = saved(window, tmp_path)
    for place, field, value, said in INVALID:
        open_and_wait(qtbot, window, written(path, ("feature_states", place), field, value))
        qtbot.waitUntil(lambda said=said: any(said in message[2] for message in window.messages.messages()))
