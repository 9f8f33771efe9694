"""Start of the window: mesh first, then all panels."""

import pytest

from hexmend_app.shell.features import FIRST, feature_names
from hexmend_app.shell.start.program import WindowStart

pytestmark = pytest.mark.slow


def test_the_mesh_is_drawn_before_the_other_features_are_built(bare_window, qtbot, mesh_file):
    window, drawn_by = bare_window, []
    native = window.windowHandle().winId()
    WindowStart(window, mesh_file)
    assert window.session is None  # it is imported in a thread
    qtbot.waitUntil(lambda: window.canvas is not None)
    window.canvas.interactor.frameSwapped.connect(
        lambda: window.canvas.colouring is not None and drawn_by.append(tuple(window.features))
    )
    with qtbot.waitSignal(window.ready):
        pass
    assert drawn_by[0] == FIRST
    assert set(window.features) == set(feature_names())
    assert window.session.document.path == mesh_file
    qtbot.waitUntil(lambda: window.canvas.isVisible())
    assert window.windowHandle().winId() == native  # adding the view does not make the window again


def test_panels_are_built_and_an_error_is_shown_if_the_mesh_cannot_be_opened(bare_window, qtbot, tmp_path):
    path = tmp_path / "none.vtk"
    with qtbot.waitSignal(bare_window.ready):
        WindowStart(bare_window, path)
    assert not bare_window.session.document.is_open
    assert bare_window.messages.isVisible()
    assert bare_window.features["open"].welcome.isVisible()
