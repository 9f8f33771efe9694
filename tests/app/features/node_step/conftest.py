"""A window in which a node's step is looked at."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

from tests.app.driving import choose_by_keys, key
from tests.app.features.node_step.looking import wait_for_step


@pytest.fixture
def at_work(window, qtbot):
    """The window with a local method, and a node of the worst element chosen by key."""
    choose_by_keys(window, "local-sd")
    key(window, Qt.Key.Key_D)
    wait_for_step(window, qtbot, "local-sd")
    return window
