"""Windows with a comparison."""

from __future__ import annotations

import pytest

from tests.app.driving import press
from tests.app.features.compare.table import button, choose_methods, prepared
from tests.patience import PATIENCE


@pytest.fixture
def comparing(window, qtbot):
    """Return a window with the panel in front and short runs."""
    return prepared(window, qtbot)


@pytest.fixture
def compared(comparing, qtbot):
    """Return a window with the results of three methods."""
    choose_methods(comparing, "laplacian", "getme", "local-sd")
    press(button(comparing, "Run comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    return comparing
