"""Windows in which methods are compared."""

from __future__ import annotations

import pytest

from tests.app.driving import press
from tests.app.features.compare.table import button, choose_methods, prepared
from tests.patience import PATIENCE


@pytest.fixture
def comparing(window, qtbot):
    """The panel in front and short runs asked for."""
    return prepared(window, qtbot)


@pytest.fixture
def compared(comparing, qtbot):
    """Three methods' results in the table."""
    choose_methods(comparing, "laplacian", "getme", "local-sd")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    return comparing
