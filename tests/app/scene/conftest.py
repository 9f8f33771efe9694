"""Views in off-screen windows."""

from contextlib import ExitStack

import pytest

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.viewport import Viewport


@pytest.fixture
def off_screen():
    """A function that makes a viewport in a window of a size; its attribute `pixels` returns what is drawn."""
    with ExitStack() as stages:

        def make(width, height, axes=True):
            stage = stages.enter_context(Stage((width, height)))
            viewport = Viewport(Pane(stage.window), axes=axes)
            viewport.pixels = lambda: stage.picture().astype(int)
            return viewport

        yield make
