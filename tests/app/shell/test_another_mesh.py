"""Opening another mesh: it is shown without remains of the previous mesh, whatever was done with that."""

import sys

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from hexmend import METHODS, MotionRules, Stage, StoppingCriteria, gallery, io
from hexmend_app.picture.appearance import Arrows, Structure, Traces
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, key, open_and_wait, phase, pixels, smooth


@pytest.fixture(scope="module")
def small_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("small") / "small.vtu"
    io.write(path, gallery.make("five-side", size=40))
    return path


def everything(window, qtbot):
    """Do everything that is possible without a run, then begin a run and a comparison."""
    session, mesh = window.session, window.session.document.now.mesh
    last_hex, last_node = mesh.n_hexes - 1, mesh.n_nodes - 1
    key(window, Qt.Key.Key_N)
    session.selection.visit(last_hex)
    session.selection.choose(last_hex, last_node)
    window.features["hex_inspector"].panel.corners_box.setChecked(True)
    window.show_panel("hex")
    session.view.isolate([last_hex, last_hex - 1], 2)
    session.view.dig(last_hex)
    window.action("cut").trigger()
    session.view.change(show={"peel": 1, "quality": (0.0, 0.5), "inverted": True})
    choose(window, "local-sd")
    key(window, Qt.Key.Key_D)
    qtbot.waitUntil(lambda: window.canvas.viewport.overlay_layers.selection.node_step is not None)
    key(window, Qt.Key.Key_F11)
    assert session.node_sweep.sweep is not None
    smooth(qtbot, session)
    session.timeline.go(session.history.records[-1], 1)
    structure = Structure.of("irregular", "sharp", "boundary", "kinds", "locked", "original")
    session.view.change(movement=Traces(arrows=Arrows.ALL), structure=structure, colours={"metric": "q-change"})
    session.run.set_breakpoints(Breakpoints(hex=last_hex, node=last_node))
    for letter in (Qt.Key.Key_V, Qt.Key.Key_W):  # beside, and the wipe
        key(window, letter)
    assert len(window.canvas.panes.all) == 2
    session.commands.tag("last", [last_hex])
    session.commands.pin(last_node, True)
    window.action("tags").trigger()
    qtbot.waitUntil(lambda: session.structure_finder.result is not None)
    window.show_panel("doctor")
    qtbot.waitUntil(lambda: session.mesh_checker.of(session.document.now.mesh) is not None)
    choose(window, "laplacian", StoppingCriteria(max_iterations=50, tolerance=0))
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    with qtbot.waitSignal(session.comparison.changed):
        session.comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=40))
    window.show_panel("compare")
    session.selection.choose(last_hex, 0)
    window.refresh()


@pytest.mark.slow
def test_a_smaller_mesh_is_shown_after_a_larger_one(window, qtbot, small_file):
    everything(window, qtbot)
    window.refresh()
    open_and_wait(qtbot, window, small_file)
    is_shown(window)
    for letter in (Qt.Key.Key_N, Qt.Key.Key_D, Qt.Key.Key_V, Qt.Key.Key_T, Qt.Key.Key_Escape):
        key(window, letter)
    is_shown(window)


def test_settings_for_the_mesh_before_are_reset(window, qtbot, small_file):
    session = window.session
    choose(window, "mend", StoppingCriteria(max_iterations=7), boundary="slide")
    session.run_setup.set_rules(MotionRules(interfaces="slide"))
    session.run.set_breakpoints(Breakpoints(inverts=True))
    session.view.change(colours={"metric": "material"}, structure=Structure.of("interfaces"))
    open_and_wait(qtbot, window, small_file)
    assert session.run_setup.stage == Stage(METHODS["mend"](), StoppingCriteria())
    assert (session.run_setup.rules, session.run.breakpoints) == (MotionRules(), Breakpoints())
    assert session.view.look.colours.metric == "q"
    assert not session.view.look.structure.is_on("interfaces")


@pytest.mark.slow
@pytest.mark.parametrize("layer", ["structure", "selection"])
def test_a_failing_layer_is_omitted(window, small_file, qtbot, layer, monkeypatch):
    overlay_layers, failures = window.canvas.viewport.overlay_layers, []
    window.session.view.change(structure=Structure.of("original"))
    window.refresh()

    def fail(*_):
        raise RuntimeError(f"{layer} has failed")

    for name in ("draw", "show", "choose", "set_mesh"):
        kind = type(overlay_layers.optional.get(layer) or getattr(overlay_layers, layer))
        if hasattr(kind, name):
            monkeypatch.setattr(kind, name, fail)
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: failures.append(str(error)))
    open_and_wait(qtbot, window, small_file)
    is_shown(window)
    window.session.view.change(lines={"edges": None if not window.session.view.look.lines.shown else 0.0})
    is_shown(window)
    assert failures == [f"{layer} has failed"]


@pytest.mark.slow
@pytest.mark.parametrize("part", ["set_mesh", "rebuild"])
def test_no_mesh_is_shown_if_its_hexes_cannot_be_drawn(window, small_file, mesh_file, qtbot, part, monkeypatch):
    def fail(*_):
        raise RuntimeError("there is no skin")

    failures = []
    with monkeypatch.context() as failing:
        failing.setattr(type(window.canvas.viewport.mesh_layer), part, fail)
        failing.setattr(sys, "excepthook", lambda kind, error, trace: failures.append(str(error)))
        open_and_wait(qtbot, window, small_file)
        window.refresh()
        for letter in (Qt.Key.Key_N, Qt.Key.Key_F, Qt.Key.Key_E, Qt.Key.Key_Escape):
            key(window, letter)
        assert window.windowTitle().startswith("small.vtu")
        assert not window.canvas.shows(window.session.document.now.mesh)
        colours = pixels(window)
        assert (np.ptp(colours, axis=2) > 60).mean() < 0.005  # the axes alone
    assert set(failures) == {"there is no skin"}
    open_and_wait(qtbot, window, mesh_file)
    is_shown(window)


def test_numbers_of_the_previous_mesh_select_and_hide_nothing(window, qtbot, small_file):
    last = window.session.document.now.mesh.n_hexes - 1
    session = window.session
    open_and_wait(qtbot, window, small_file)
    session.selection.visit(last)
    session.selection.choose(last, 3)
    session.view.isolate([last])
    session.view.dig(last)
    assert (session.selection.hex, session.selection.node) == (None, None)
    assert session.view.look.show.isolate is None
    assert not session.view.look.show.hidden
    is_shown(window)


def is_shown(window):
    """Check that the view shows the open mesh only, without errors."""
    window.refresh()
    QApplication.processEvents()
    mesh, drawn = window.session.document.now.mesh, window.canvas.viewport
    assert drawn.frame.mesh is mesh
    assert all(view.frame.mesh.hexes is mesh.hexes for view in window.canvas.panes.all)
    assert drawn.mesh_layer.faces.hexes.max() < mesh.n_hexes
    low, high = np.min(drawn.places, axis=0), np.max(drawn.places, axis=0)
    assert (low >= mesh.points.min(axis=0) - 1e-6).all()
    assert (high <= mesh.points.max(axis=0) + 1e-6).all()
    assert [kind for kind, *_ in window.messages.messages() if kind == "error"] == []
    window.canvas.draw_still()
    window.canvas.interactor.grabFramebuffer()
