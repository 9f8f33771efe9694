"""Outcome of a run in the window, by mouse clicks and keys."""

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
from tests.core.smoothers.mend.test_mend import with_locked_corner
from tests.patience import PATIENCE


def run(window, qtbot, method, **stop):
    """Run a method by its button, wait for its end and show the panel of the outcome."""
    choose(window, method, StoppingCriteria(**stop))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.show_panel("outcome")


def texts(window):
    window.refresh()
    return " ".join(
        label.text() for label in window.features["outcome"].panel.findChildren(QLabel) if label.isVisible()
    )


def button(window, name):
    """Return a button by its name; deleted buttons are hidden before they disappear."""
    panel = window.features["outcome"].panel
    return next(b for b in panel.findChildren(QPushButton) if b.accessibleName() == name and not b.isHidden())


def press(window, name):
    window.refresh()
    QApplication.sendPostedEvents()  # lays out the new buttons
    assert button(window, name).isVisible()
    press_button(button(window, name))


@pytest.fixture
def locked(window, qtbot, tmp_path):
    """Open a mesh with a hex that its fixed nodes lock, and return the number of the hex."""
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    io.write(tmp_path / "locked.vtu", mesh)
    open_and_wait(qtbot, window, tmp_path / "locked.vtu")
    return int(mesh.topology.node_corners.items[0] // 8)


def test_the_key_shows_why_the_run_stopped(window, qtbot):
    assert not window.features["outcome"].panel.isVisible()
    choose(window, "laplacian", StoppingCriteria(keep_last=True))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    key(window, Qt.Key.Key_Y)
    qtbot.waitUntil(window.features["outcome"].panel.isVisible, timeout=PATIENCE)
    assert "Why Laplacian stopped" in texts(window)
    assert "no node moved further than 0.0001 mean edge lengths" in texts(window)
    inverted = window.session.document.now.summary.inverted
    assert f"{inverted} of {window.session.document.now.mesh.n_hexes:,} hexes are inverted" in texts(window)


@pytest.mark.slow
def test_a_suggestion_is_selected_without_a_run_and_improves_the_mesh(window, qtbot):
    run(window, qtbot, "laplacian", max_iterations=1)
    assert window.session.document.now.summary.inverted > 0
    press(window, "Select: Mend")
    assert window.session.run_setup.method == "mend"
    assert window.session.run_setup.stage.stop == StoppingCriteria()  # the limit of one iteration is reset
    assert window.features["smooth"].panel.stage.stop.values() == StoppingCriteria().values()
    assert window.session.run.phase is Phase.FINISHED
    click(window, "Run")
    qtbot.waitUntil(lambda: window.session.run.busy, timeout=PATIENCE)
    window.refresh()
    assert not button(window, "Select: Mend").isEnabled()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now.summary.inverted == 0
    assert "Why Mend stopped" in texts(window)


@pytest.mark.slow
def test_a_suggestion_that_undoes_the_run_restores_the_mesh_before_it(window, qtbot, tmp_path):
    io.write(tmp_path / "sound.vtu", gallery.make("bridge-sharp", size=864))
    open_and_wait(qtbot, window, tmp_path / "sound.vtu")
    start = window.session.document.now.mesh.points
    run(window, qtbot, "laplacian", keep_last=True)
    assert window.session.document.now.summary.inverted > 0
    assert "Worse than at the start: inverted 0 → 12" in texts(window)
    press(window, "Select: Undo, then Smart Laplacian")
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start)
    assert window.session.run_setup.method == "smart-laplacian"
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.document.now.summary.inverted == 0


@pytest.mark.slow
def test_locked_hexes_are_listed_and_isolated(window, qtbot, locked):
    run(window, qtbot, "mend")
    assert f'<a href="{locked}">{locked}</a>' in texts(window)
    press(window, "Show the locked hexes")
    assert window.session.view.look.show.isolate.hexes == (locked,)
    assert window.session.selection.hex == locked
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.show.isolate is None
    button(window, "Show the locked hexes").setFocus()
    QTest.keyClick(button(window, "Show the locked hexes"), Qt.Key.Key_Space)
    assert window.session.view.look.show.isolate is not None
