"""The structure of the open mesh is found in the background."""

from __future__ import annotations

import pytest

from hexmend import gallery, io
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.layer_switch import EDGE_LAYERS
from hexmend_app.scene.layers.optional.structure import SHARP, VALENCES
from hexmend_app.state.mesh.document import State
from hexmend_app.state.tasks.task import running
from tests.app.driving import open_and_wait, turn
from tests.app.features.structure.layers import count, pixels, press_key, texts
from tests.core.grids import grid
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def begin_searching(window):
    """Not waited for: a small mesh's search may be over between two looks at it."""
    window.session.structure_finder.search()
    assert window.session.structure_finder.busy


@pytest.mark.parametrize("searching", [False, True])
def test_closing_during_the_search_leaves_no_thread(fresh_window, qtbot, mesh_file, searching):
    window = fresh_window
    if window.session.structure_finder.structure is None:
        qtbot.waitSignal(window.session.structure_finder.found, timeout=PATIENCE).wait()
    window.session.document.replace(window.session.document.start, mesh_file)
    if searching:
        begin_searching(window)
    window.close()
    qtbot.waitUntil(lambda: running() == (), timeout=PATIENCE)
    turn()
    assert window.session.structure_finder.structure is None


def test_the_structure_of_the_last_opened_mesh_is_found(window, qtbot):
    first, last = State.of(gallery.make("five-side", size=30_000)), State.of(grid(2))
    window.session.document.replace(first, None)
    begin_searching(window)
    window.session.document.replace(last, None)
    qtbot.waitUntil(lambda: window.session.structure_finder.structure is not None, timeout=PATIENCE)
    assert len(window.session.structure_finder.structure.sharp) == 24


def test_a_layer_stays_on_for_the_next_mesh(five, qtbot, tmp_path):
    press_key(five, "sharp")
    press_key(five, "irregular")
    io.write(tmp_path / "cube.vtu", grid(3))
    open_and_wait(qtbot, five, tmp_path / "cube.vtu")
    assert five.session.structure_finder.structure is None
    assert five.canvas.viewport.frame.look.structure.on.isdisjoint(EDGE_LAYERS)  # the view does not wait for them
    qtbot.waitUntil(lambda: five.session.structure_finder.structure is not None, timeout=PATIENCE)
    five.refresh()
    assert five.canvas.viewport.frame.look.structure == Structure.of("irregular", "sharp")
    assert texts(five.features["structure"].panel, "sharp") == ["36"]
    assert five.features["structure"].panel.layers["irregular"].box.isEnabled()  # to be switched off
    assert count(pixels(five), SHARP) > 300
    assert count(pixels(five), VALENCES[5]) == 0
