"""A viewport that shows a grid from above."""

import pytest

from tests.app.scene.showing import MESH, show


@pytest.fixture
def seen(off_screen):
    """A viewport that shows a grid from above, and a function that returns its pixels."""
    viewport = off_screen(200, 150)
    show(viewport, MESH)
    viewport.view("+z")
    return viewport, viewport.pixels
