"""The boundary slides on the surface of a file that the user chooses."""

import re

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel

from hexmend.boundary import SkinSurface
from hexmend.iteration import StoppingCriteria
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, click_until, open_and_wait, open_mesh
from tests.core.boundary.solids import ball, slid
from tests.core.smoothers.test_sliding_smoother import skin_of, write_stl

SKIN = skin_of(ball(8))


@pytest.fixture
def stl(window, qtbot, tmp_path):
    """Open a coarse ball, and return the file of a fine surface of it."""
    write_stl(tmp_path / "fine.stl", SKIN)
    open_mesh(qtbot, window, tmp_path / "ball.vtu", slid(ball(3), 0.2))
    choose(window, "laplacian", StoppingCriteria(max_iterations=2, keep_last=True))
    return tmp_path / "fine.stl"


def target(window):
    return window.session.document.now.mesh.target


def test_runs_slide_on_a_chosen_surface(window, qtbot, stl):
    assert not window.action("slide_on_boundary").isEnabled()
    assert window.features["target_surface"].choose(stl)
    window.refresh()
    assert target(window).name == "fine.stl"
    assert window.session.run_setup.smoother.boundary == "slide"
    click_until(window, qtbot, "Run", Phase.FINISHED)
    mesh = window.session.document.now.mesh
    assert target(window).distances(mesh.points[mesh.topology.boundary]).max() < 1e-6
    assert "from fine.stl" in window.session.timeline.record.advice.surface
    assert re.search(rf"sliding_on_file\(\w+, {re.escape(repr(str(stl)))}\)", window.features["reproduce"].text)


@pytest.mark.slow
def test_it_is_shown_as_a_ghost_until_it_is_removed(window, stl):
    window.features["target_surface"].choose(stl)
    window.refresh()
    assert window.session.view.look.structure.is_on("target")
    ghost = window.canvas.viewport.overlay_layers.optional["target"]
    np.testing.assert_allclose(ghost.places, target(window).points, atol=1e-6)
    window.show_panel("show")
    window.refresh()
    row = window.features["structure"].panel.layers["target"].entries
    assert "fine.stl" in " ".join(label.text() for label in row.findChildren(QLabel))
    window.action("slide_on_boundary").trigger()
    window.refresh()
    assert target(window) is None
    assert not window.session.view.look.structure.is_on("target")
    assert not ghost.shown


@pytest.mark.slow
def test_the_choice_is_undone_and_kept_in_sessions(window, qtbot, stl, tmp_path):
    window.features["target_surface"].choose(stl)
    assert window.features["save"].save_and_wait(tmp_path / "ball.hexmend")
    window.session.commands.undo()
    assert target(window) is None
    window.session.commands.redo()
    assert target(window).name == "fine.stl"
    open_and_wait(qtbot, window, tmp_path / "ball.hexmend")
    assert target(window).name == "fine.stl"


@pytest.mark.slow
def test_a_surface_that_does_not_fit_is_refused(window, stl, tmp_path):
    write_stl(tmp_path / "far.stl", SkinSurface(1000 * SKIN.points, SKIN.faces))
    before = window.session.document.now
    for name, problem in (("far.stl", "mean edge lengths or more from it"), ("none.stl", "no such file")):
        assert not window.features["target_surface"].choose(tmp_path / name)
        assert problem in window.messages.text
        assert window.session.document.now is before
