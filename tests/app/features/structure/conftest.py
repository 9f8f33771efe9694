"""Fixture with a window that shows a mesh of five blocks."""

import pytest

from hexmend import gallery, io
from tests.app.features.structure.layers import open_and_know


@pytest.fixture
def five(window, qtbot, tmp_path):
    """The window with a mesh of five blocks."""
    io.write(tmp_path / "five.vtu", gallery.make("five-side", size=500))
    open_and_know(qtbot, window, tmp_path / "five.vtu")
    window.messages.clear()  # the first key would remove that of the opened mesh, and the view would grow
    window.session.view.change(page={"shading": False})  # shading is drawn later, at an unknown time
    window.refresh()
    return window
