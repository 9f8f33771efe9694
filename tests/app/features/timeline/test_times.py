"""Times of a case in the window: the timeline names them, and a message names those that are left out."""

import pytest
from PySide6.QtWidgets import QLabel

from tests.app.driving import named, open_and_wait
from tests.app.state.tasks.test_time_reader import write_case

pytestmark = pytest.mark.slow


@pytest.fixture
def case(tmp_path):
    """Folder of a case with two times, and a damaged one between them."""
    write_case(tmp_path / "case")
    (tmp_path / "case/0.5/polyMesh/points").write_bytes(b"broken")
    return tmp_path / "case"


@pytest.fixture
def opened(window, qtbot, case):
    """Window with the case and its times."""
    open_and_wait(qtbot, window, case)
    qtbot.waitUntil(lambda: not window.session.time_reader.busy)
    window.refresh()
    return window


def test_times_are_stepped_through_by_name(opened):
    panel, texts = opened.features["timeline"].panel, []
    for name in ("first", "on", "on", "newest", "back"):
        panel.button(name).click()
        opened.refresh()
        texts.append(named(panel, QLabel, "Iteration shown").text())
    assert texts == ["constant", "t = 0.002", "t = 10", "t = 10", "t = 0.002"]


def test_a_message_names_the_times_left_out(opened):
    assert opened.messages.title == "1 time of the case skipped"
    assert opened.messages.text.startswith("t = 0.5: ")
