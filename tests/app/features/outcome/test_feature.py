"""The end of a run explained in the window: by real clicks."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton

from hexmend import gallery, io
from hexmend.iteration import StoppingCriteria
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, click, key, open_and_wait, phase
from tests.app.driving import press as press_button
from tests.core.boundary.solids import slid, wavy
from tests.core.grids import grid, scrambled
from tests.core.smoothers.mend.test_mend import with_locked_corner
from tests.patience import PATIENCE


def run(window, qtbot, method, **stop):
    """Run a method from its button to its end, and bring what explains it to the front."""
    choose(window, method, StoppingCriteria(**stop))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.show_panel("outcome")


def said(window):
    window.refresh()
    return " ".join(
        label.text() for label in window.features["outcome"].panel.findChildren(QLabel) if label.isVisible()
    )


def button(window, name):
    """A button that there is, not one that is about to go."""
    panel = window.features["outcome"].panel
    return next(b for b in panel.findChildren(QPushButton) if b.accessibleName() == name and not b.isHidden())


def press(window, name):
    window.refresh()
    QApplication.sendPostedEvents()  # laid out
    chosen = button(window, name)
    assert chosen.isVisible()
    press_button(chosen)


@pytest.fixture
def locked(window, qtbot, tmp_path):
    """The window with a mesh of which fixed nodes lock one element."""
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    io.write(tmp_path / "locked.vtu", mesh)
    open_and_wait(qtbot, window, tmp_path / "locked.vtu")
    return int(mesh.topology.node_corners.items[0] // 8)


def test_before_a_run_it_says_what_it_is_for(window, qtbot):
    window.show_panel("outcome")
    qtbot.waitUntil(window.features["outcome"].panel.isVisible)
    assert "No run has ended yet" in said(window)


def test_a_run_that_ends_is_explained_before_everything_else(window, qtbot):
    assert not window.features["outcome"].panel.isVisible()
    choose(window, "laplacian", StoppingCriteria(keep_last=True))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    key(window, Qt.Key.Key_Y)
    qtbot.waitUntil(window.features["outcome"].panel.isVisible)
    assert "Why Laplacian stopped" in said(window)
    assert "no node moved further than 0.0001 mean edge lengths" in said(window)
    inverted = window.session.document.now.summary.inverted
    assert f"{inverted} of {window.session.document.now.mesh.n_hexes:,} hexes are inverted" in said(window)


@pytest.mark.slow
def test_a_suggestion_is_chosen_not_run_and_helps(window, qtbot):
    run(window, qtbot, "laplacian", max_iterations=1)
    left = window.session.document.now.summary.inverted
    assert left > 0
    press(window, "Choose: Mend")
    assert window.session.run_setup.method == "mend"
    assert window.session.run_setup.stage.stop == StoppingCriteria()  # or one iteration would not help either
    assert window.features["smooth"].panel.stage.stop.values() == StoppingCriteria().values()
    assert window.session.run.phase is Phase.FINISHED
    click(window, "Run")
    qtbot.waitUntil(lambda: window.session.run.busy, timeout=PATIENCE)
    window.refresh()
    assert not button(window, "Choose: Mend").isEnabled()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now.summary.inverted == 0
    assert "Why Mend stopped" in said(window)


def test_while_a_run_goes_on_it_says_so(window, qtbot):
    window.show_panel("outcome")
    choose(window, "laplacian", StoppingCriteria(tolerance=0, max_iterations=1_000_000))
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    assert "A run is under way" in said(window)
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert "Stopped by you after 1 iteration" in said(window)


@pytest.mark.slow
def test_the_run_that_is_gone_through_is_the_one_explained(window, qtbot):
    run(window, qtbot, "laplacian", max_iterations=3)
    run(window, qtbot, "mend", max_iterations=2)
    assert "Why Mend stopped" in said(window)
    first = window.session.history.records[0]
    window.session.timeline.choose(first)
    assert "Why Laplacian stopped" in said(window)
    press(window, "Choose: Mend")  # from where that run ended
    assert window.session.timeline.moment.record is first


@pytest.mark.parametrize("back", ["undo", "reset"])
def test_a_run_that_is_taken_back_is_explained_as_one_whose_result_is_not_shown(window, qtbot, back):
    run(window, qtbot, "laplacian", max_iterations=3)
    assert "The mesh is shown as it was" not in said(window)
    window.action(back).trigger()
    assert "Why Laplacian stopped" in said(window)
    assert "The mesh is shown as it was before the run." in said(window)
    window.action("redo" if back == "undo" else "undo").trigger()
    assert "The mesh is shown as it was" not in said(window)


@pytest.mark.slow
def test_what_begins_before_the_run_goes_back_there(window, qtbot, tmp_path):
    io.write(tmp_path / "sound.vtu", gallery.make("bridge-sharp", size=864))
    open_and_wait(qtbot, window, tmp_path / "sound.vtu")
    start = window.session.document.now.mesh.points
    run(window, qtbot, "laplacian", keep_last=True)
    assert window.session.document.now.summary.inverted > 0
    assert "Worse than at the start: inverted 0 → 12" in said(window)
    press(window, "Choose: Undo, then Smart Laplacian")
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start)
    assert window.session.run_setup.method == "smart-laplacian"
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now.summary.inverted == 0


def test_what_is_kept_is_said_and_shown(window, qtbot, tmp_path):
    io.write(tmp_path / "sound.vtu", gallery.make("bridge-sharp", size=864))
    open_and_wait(qtbot, window, tmp_path / "sound.vtu")
    run(window, qtbot, "laplacian")
    assert window.session.document.now.summary.inverted == 0
    assert window.session.timeline.moment.number == 3
    kept = "Iteration 3 was kept: later ones were worse."
    assert kept in said(window)
    assert "Worse than" not in said(window)
    panel = window.features["smooth"].panel
    assert any(kept in label.text() for label in panel.findChildren(QLabel))


@pytest.mark.slow
def test_locked_elements_are_listed_and_shown(window, qtbot, locked):
    run(window, qtbot, "mend")
    assert f'<a href="{locked}">{locked}</a>' in said(window)
    press(window, "Show the locked hexes")
    assert window.session.view.look.isolation.hexes == (locked,)
    assert window.session.selection.hex == locked
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.isolation is None
    button(window, "Show the locked hexes").setFocus()
    QTest.keyClick(button(window, "Show the locked hexes"), Qt.Key.Key_Space)
    assert window.session.view.look.isolation is not None


@pytest.mark.slow
def test_hexes_whose_corners_limit_the_least_are_shown_before_the_camera(window, qtbot, tmp_path):
    io.write(tmp_path / "wavy.vtu", wavy(scrambled(grid(3), 0.3, 1), 0.2, 2))
    open_and_wait(qtbot, window, tmp_path / "wavy.vtu")
    ended = []
    window.session.run.ended.connect(ended.append)
    choose(window, "mend", goal="scaled-jacobian")
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.show_panel("outcome")
    limiting = np.unique(ended[0].limits.hexes).tolist()
    assert "Limiting: " in said(window)
    assert f'<a href="{limiting[0]}">{limiting[0]}</a>' in said(window)
    assert f"the least scaled Jacobian is {ended[0].after.scaled_jacobian_min:.4f}" in said(window)
    with qtbot.waitSignal(window.session.selection.visited) as visited:
        press(window, "Show the limiting hexes")
    assert visited.args == [tuple(limiting)]
    assert window.session.view.look.isolation.hexes == tuple(limiting)
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.isolation is None
    assert "The boundary slid" not in said(window)


@pytest.mark.slow
def test_how_far_the_boundary_has_slid_is_said(window, qtbot, tmp_path):
    io.write(tmp_path / "slid.vtu", slid(grid(4), 0.3, seed=3))
    open_and_wait(qtbot, window, tmp_path / "slid.vtu")
    choose(window, "mend", boundary="slide")
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.show_panel("outcome")
    assert "The boundary slid: " in said(window)
    assert "of the diagonal) from where it was" in said(window)
    assert "48 of 48 sharp edges are kept." in said(window)
    assert "Limiting" not in said(window)


@pytest.mark.slow
def test_pins_that_hold_elements_are_taken_out_in_one_step(window, qtbot, tmp_path):
    from tests.core.advice.test_advice import pinned_tangle

    mesh = pinned_tangle()
    io.write(tmp_path / "pinned.vtu", mesh.replace(pinned=None))
    open_and_wait(qtbot, window, tmp_path / "pinned.vtu")
    window.session.commands.pin(int(np.flatnonzero(mesh.pinned)[0]), True)
    run(window, qtbot, "mend")
    assert window.session.document.now.summary.inverted > 0
    press(window, "Choose: Unpin, then Mend")
    assert window.session.document.undo_title == "unpin"
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now.summary.inverted == 0


@pytest.mark.slow
def test_a_run_with_nothing_to_do_is_explained_too(window, qtbot, tmp_path):
    run(window, qtbot, "laplacian", max_iterations=1)
    io.write(tmp_path / "one.vtu", grid(1))
    window.session.document.saved(tmp_path / "one.vtu")
    open_and_wait(qtbot, window, tmp_path / "one.vtu")
    run(window, qtbot, "mend")
    qtbot.waitUntil(window.features["outcome"].panel.isVisible)
    assert "Why Mend stopped Nothing to do: every node is fixed." in said(window)
    run(window, qtbot, "laplacian")
    assert "Why Laplacian stopped" in said(window)


def test_another_mesh_is_unexplained(window, qtbot, mesh_file):
    run(window, qtbot, "laplacian", max_iterations=1)
    window.session.document.saved(mesh_file)
    open_and_wait(qtbot, window, mesh_file)
    window.show_panel("outcome")
    qtbot.waitUntil(window.features["outcome"].panel.isVisible)
    assert "No run has ended yet" in said(window)
