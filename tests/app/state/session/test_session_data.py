"""Sessions are read as they were written; data that no window wrote are reported."""

import numpy as np
import pytest
from PySide6.QtCore import QObject, Signal

from hexmend.errors import FileError
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.state_part import StatePart
from tests.app.driving import smooth
from tests.core.grids import grid, scrambled


@pytest.fixture
def path(qtbot, hosted, tmp_path):
    """A session with a run of three iterations and its advice, in a file."""
    session = hosted(scrambled(grid(3), 0.4)).session
    smooth(qtbot, session)
    session_data.write(tmp_path / "work.hexmend", session.to_data())
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
    with pytest.raises(FileError, match=rf"inconsistent: \[{place[0]}\]|inconsistent: {place[0]} "):
        session_data.read(path)


@pytest.mark.parametrize("key", ["invalid", "scaled_jacobian_min"])
def test_a_row_without_a_figure_is_reported(path, key):
    content = read_archive(path, "Hexmend session", VERSION)
    del content["window"]["history"]["records"][0]["rows"][1][key]
    write_archive(path, "Hexmend session", VERSION, content)
    with pytest.raises(FileError, match=r"iteration 1 of .* lacks values of "):
        session_data.read(path)


# State parts of features: restored late, saved automatically, and of one mesh only.


class Counter(QObject):
    """A feature's state: a number."""

    changed = Signal()

    def __init__(self):
        super().__init__()
        self.number = 0

    def restore(self, number):
        self.number = number

    def part(self):
        return StatePart(name="test-counter", data=int, to_data=lambda: self.number, restore=self.restore,
                         changed=self.changed)  # fmt: skip


@pytest.fixture
def session(hosted):
    return hosted(grid(2)).session


def test_data_of_a_session_are_restored_when_the_part_is_declared(session):
    session.feature_states.restore({"test-counter": 7})
    assert session.feature_states.to_data() == {"test-counter": 7}
    counter = Counter()
    session.feature_states.add(counter.part())
    assert counter.number == 7
    with pytest.raises(ValueError, match="two features declare the state 'test-counter'"):
        session.feature_states.add(counter.part())


def test_data_of_another_mesh_are_neither_restored_nor_saved(session):
    session.feature_states.restore({"test-counter": 7})
    session.document.replace(MeasuredMesh.of(grid(3)), None)
    counter = Counter()
    session.feature_states.add(counter.part())
    assert counter.number == 0
    assert session.feature_states.to_data() == {"test-counter": 0}


def test_a_part_is_saved_after_changes(qapp):
    session, counter, changes = Session(), Counter(), []
    session.feature_states.add(counter.part())
    session.data_changed.connect(lambda: changes.append(counter.number))
    counter.changed.emit()
    assert changes == [0]
