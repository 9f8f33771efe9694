"""Times of a case in the window: the timeline names them, and a message names those that are left out."""

import pytest
from PySide6.QtWidgets import QLabel

from hexmend import io
from hexmend.io.formats.openfoam.foam_text import replaced_points
from tests.app.driving import named, open_and_wait
from tests.core.grids import grid

pytestmark = pytest.mark.slow


@pytest.fixture
def case(tmp_path):
    """Folder of a case with two times, and a damaged one between them."""
    folder = tmp_path / "case"
    io.write(folder / "case.foam", grid(3))
    points = io.read(folder).points
    for time in ("0.002", "0.01", "10"):
        (folder / time / "polyMesh").mkdir(parents=True)
        content = replaced_points(folder / "constant/polyMesh/points", points * (1, 1, 1 + float(time)))
        (folder / time / "polyMesh/points").write_bytes(content if time != "0.01" else b"broken")
    return folder


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
    assert opened.messages.text.startswith("t = 0.01: ")
