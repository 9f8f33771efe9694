"""Sessions are read as they were written; data that no window wrote are reported."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session import Session
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


@pytest.fixture
def path(qtbot, tmp_path):
    """A session with a run of three iterations and its advice, in a file."""
    session = Session()
    session.document.replace(State.of(scrambled(grid(3), 0.4)), Path("a.vtu"))
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        session.run.start(METHODS["laplacian"](), StoppingCriteria(max_iterations=3, tolerance=0))
    session_data.write(tmp_path / "work.hexmend", session.to_data())
    session.close()
    return tmp_path / "work.hexmend"


@pytest.mark.parametrize("place", [
    ("history",),
    ("history", "records", 0, "advice"),
    ("history", "records", 0, "offsets", 0),
    ("history", "records", 0, "pauses"),
    ("view", "look", "colours"),
    ("document", "files"),
])  # fmt: skip
@pytest.mark.parametrize("damage", [np.zeros(3), [[1, 2]], [1, 2]])
def test_data_of_another_type_are_reported(path, place, damage):
    content = read_archive(path, "Hexmend session", VERSION)
    part = content["window"]
    for key in place[:-1]:
        part = part[key]
    part[place[-1]] = damage
    write_archive(path, "Hexmend session", VERSION, content)
    with pytest.raises(FileError, match="inconsistent: the window"):
        session_data.read(path)


@pytest.mark.parametrize("key", ["invalid", "scaled_jacobian_min"])
def test_a_row_without_a_figure_is_reported(path, key):
    content = read_archive(path, "Hexmend session", VERSION)
    del content["window"]["history"]["records"][0]["rows"][1][key]
    write_archive(path, "Hexmend session", VERSION, content)
    with pytest.raises(FileError, match=r"iteration 1 of .* lacks values of "):
        session_data.read(path)


def test_a_session_is_unchanged_by_reading_and_writing_it(path, tmp_path):
    data = session_data.read(path)
    (record,) = data.history.records
    assert record.rows[-1]["iteration"] == 3
    assert record.advice.reason.startswith("Stopped at the limit of 3 iterations")
    session_data.write(tmp_path / "again.hexmend", data)
    again = session_data.read(tmp_path / "again.hexmend")
    assert again.history.records[0].rows == record.rows
    assert again.history.records[0].advice.reason == record.advice.reason
    np.testing.assert_array_equal(again.document.now.mesh.points, data.document.now.mesh.points)
