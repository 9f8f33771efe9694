"""A window with a mesh of five blocks."""

from __future__ import annotations

import pytest

from hexmend import gallery, io
from tests.app.features.structure.layers import open_and_know


@pytest.fixture
def five(window, qtbot, tmp_path):
    """The window with a mesh of five blocks in it."""
    io.write(tmp_path / "five.vtu", gallery.make("five-side", size=500))
    open_and_know(qtbot, window, tmp_path / "five.vtu")
    window.session.view.change(shading=False)  # shades come when the view has rested, whenever that is
    window.refresh()
    return window
