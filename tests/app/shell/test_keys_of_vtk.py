"""Keys of VTK do nothing in the view."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtTest import QTest

from tests.app.driving import pixels


@pytest.mark.slow
def test_keys_of_vtk_do_nothing(window):
    view = window.canvas.interactor
    view.setFocus()
    before = pixels(window)
    for typed in "wsrquj":
        QTest.keyClicks(view, typed)
    assert (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() < 0.01
    assert window.isVisible()
