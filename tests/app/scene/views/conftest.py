"""An off-screen window, its pane, and a viewport that shows a grid from above."""

import pytest

from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.pane import Pane
from hexmend_app.scene.views.viewport import Viewport
from tests.app.scene.views.showing import MESH, show


@pytest.fixture
def stage():
    with Stage((200, 150)) as stage:
        yield stage


@pytest.fixture
def pane(stage):
    return Pane(stage.window)


@pytest.fixture
def seen(stage, pane):
    """A viewport that shows a grid from above, and a function that returns its pixels."""
    viewport = Viewport(pane)
    show(viewport, MESH)
    viewport.view("+z")
    return viewport, lambda: stage.picture().astype(int)
