"""Windows with a comparison."""

import pytest

from tests.app.driving import brought, choose, press
from tests.app.features.compare.table import SHORT, button, choose_methods


@pytest.fixture
def comparing(window, qtbot):
    """Return a window with the panel in front and short runs."""
    brought(window, qtbot, "compare")
    choose(window, "mend", SHORT)
    return window


@pytest.fixture
def compared(comparing, qtbot):
    """Return a window with the results of three methods."""
    choose_methods(comparing, "laplacian", "getme", "local-sd")
    press(button(comparing, "Compare methods"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy)
    return comparing
