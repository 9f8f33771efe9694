"""Opening another mesh: it is shown without remains of the previous mesh, whatever was done with that."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from hexmend import gallery, io
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture.appearance import Arrows, Structure, Traces
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, open_and_wait, phase, pixels
from tests.patience import PATIENCE


@pytest.fixture(scope="module")
def small_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("small") / "small.vtu"
    io.write(path, gallery.make("five-side", size=40))
    return path


def select(window, qtbot):
    key(window, Qt.Key.Key_N)
    assert window.session.selection.hex is not None


def select_the_last(window, qtbot):
    mesh = window.session.document.now.mesh
    window.session.selection.visit(mesh.n_hexes - 1)
    window.session.selection.choose(mesh.n_hexes - 1, mesh.n_nodes - 1)
    window.features["hex_inspector"].panel.set_corners_in_view(True)
    window.show_panel("hex")


def isolate_and_dig(window, qtbot):
    last = window.session.document.now.mesh.n_hexes - 1
    window.session.view.isolate([last, last - 1], 2)
    window.session.view.dig(last)


def cut(window, qtbot):
    window.action("cut").trigger()
    window.refresh()
    assert window.session.view.look.cut.active


def filter_and_peel(window, qtbot):
    window.session.view.change(show={"peel": 1, "quality": (0.0, 0.5), "inverted": True})


def explain_a_node(window, qtbot):
    window.session.run_setup.choose(Stage(METHODS["local-sd"](), StoppingCriteria()))
    key(window, Qt.Key.Key_D)
    qtbot.waitUntil(lambda: window.canvas.viewport.overlay_layers.selection.node_step is not None, timeout=PATIENCE)


def begin_a_sweep(window, qtbot):
    window.session.run_setup.choose(Stage(METHODS["local-sd"](), StoppingCriteria()))
    key(window, Qt.Key.Key_F11)
    assert window.session.node_sweep.sweep is not None


def run_and_pause(window, qtbot):
    window.session.run_setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=50, tolerance=0)))
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)


def run_and_go_back(window, qtbot):
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3, tolerance=0)))
    window.session.timeline.go(window.session.history.records[-1], 1)
    window.session.view.change(
        movement=Traces(arrows=Arrows.ALL), structure=Structure.of("original"), colours={"metric": "q-change"}
    )


def break_at_the_last(window, qtbot):
    mesh = window.session.document.now.mesh
    window.session.run.break_at(Breakpoints(hex=mesh.n_hexes - 1, node=mesh.n_nodes - 1))


def compare(window, qtbot):
    with qtbot.waitSignal(window.session.comparison.changed, timeout=PATIENCE):
        window.session.comparison.start(
            [METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=40)
        )
    window.show_panel("compare")


def keep_beside_and_wipe(window, qtbot):
    key(window, Qt.Key.Key_V)
    key(window, Qt.Key.Key_W)
    assert len(window.canvas.panes.all) == 2


def tag_and_pin(window, qtbot):
    mesh = window.session.document.now.mesh
    window.session.commands.tag("last", [mesh.n_hexes - 1])
    window.session.commands.pin(mesh.n_nodes - 1, True)
    window.show_panel("tags")


def show_the_structure(window, qtbot):
    window.session.view.change(structure=Structure.of("irregular", "sharp", "boundary", "kinds", "locked", "original"))
    qtbot.waitUntil(lambda: window.session.structure_finder.structure is not None, timeout=PATIENCE)


def examine(window, qtbot):
    window.show_panel("doctor")
    qtbot.waitUntil(
        lambda: window.session.mesh_checker.of(window.session.document.now.mesh) is not None, timeout=PATIENCE
    )


WORKS = (
    select, select_the_last, isolate_and_dig, cut, filter_and_peel, explain_a_node, begin_a_sweep, run_and_go_back,
    run_and_pause, break_at_the_last, compare, keep_beside_and_wipe, tag_and_pin, show_the_structure, examine,
)  # fmt: skip


def everything(window, qtbot):
    """Do everything that is possible without a run, then begin a run."""
    for work in (*(one for one in WORKS if one is not run_and_pause), run_and_pause):
        if work is not compare:
            work(window, qtbot)
            window.refresh()
    compare(window, qtbot)
    window.session.selection.choose(window.session.document.now.mesh.n_hexes - 1, 0)
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


@pytest.mark.slow
def test_a_session_of_a_smaller_mesh_is_shown_after_a_larger_one(window, qtbot, small_file, mesh_file, tmp_path):
    open_and_wait(qtbot, window, small_file)
    window.session.selection.choose(7, window.session.document.now.mesh.hexes[7, 0])
    assert window.features["session"].save_and_wait(tmp_path / "small.hexmend")
    open_and_wait(qtbot, window, mesh_file)
    everything(window, qtbot)
    open_and_wait(qtbot, window, tmp_path / "small.hexmend")
    is_shown(window)
    assert window.session.selection.hex == 7


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


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cut", "histogram"])
def test_a_failing_panel_does_not_keep_the_previous_mesh_in_the_view(window, small_file, qtbot, name, monkeypatch):
    failures = []

    def fail(*_):
        raise RuntimeError("this panel has failed")

    with monkeypatch.context() as failing:
        failing.setattr(window.features[name], "refresh", fail)
        failing.setattr(sys, "excepthook", lambda kind, error, trace: failures.append(str(error)))
        open_and_wait(qtbot, window, small_file)
        is_shown(window)
    assert set(failures) == {"this panel has failed"}


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
