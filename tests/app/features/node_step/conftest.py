"""Window that shows the step of a node."""

import pytest
from PySide6.QtCore import Qt

from tests.app.driving import choose_by_keys, key
from tests.app.features.node_step.step_display import wait_for_step


@pytest.fixture
def node_window(window, qtbot):
    """Return the window with a local method, and a node of the worst hex selected by key."""
    choose_by_keys(window, "local-sd")
    key(window, Qt.Key.Key_D)
    wait_for_step(window, qtbot, "local-sd")
    return window
