"""State parts of features: restored late, closed, saved automatically, and of one mesh only."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QObject, Signal

from hexmend_app.codec.codec import DecodeError
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.earlier_versions import _with_features
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.state_part import StatePart
from tests.core.grids import grid


class Counter(QObject):
    """A feature's state: a number."""

    changed = Signal()

    def __init__(self):
        super().__init__()
        self.number, self.closed = 0, False

    def restore(self, number):
        self.number = number

    def close(self):
        self.closed = True

    def part(self):
        return StatePart(name="test-counter", data=int, to_data=lambda: self.number, restore=self.restore,
                         close=self.close, changed=self.changed)  # fmt: skip


@pytest.fixture
def session(qapp):
    session = Session()
    session.document.replace(State.of(grid(2)), None)
    yield session
    session.close()


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
    session.document.replace(State.of(grid(3)), None)
    counter = Counter()
    session.feature_states.add(counter.part())
    assert counter.number == 0
    assert session.feature_states.to_data() == {"test-counter": 0}


def test_a_part_is_saved_after_changes_and_closed_with_the_session(qapp):
    session, counter, changes = Session(), Counter(), []
    session.feature_states.add(counter.part())
    session.data_changed.connect(lambda: changes.append(counter.number))
    counter.changed.emit()
    assert changes == [0]
    session.close()
    assert counter.closed


@pytest.mark.slow
@pytest.mark.parametrize("window", [3, None, {"choices": 3}, {"choices": ["charts"]}])
def test_damaged_data_of_earlier_versions_are_named(window):
    with pytest.raises(DecodeError, match="not a table"):
        _with_features(window)
