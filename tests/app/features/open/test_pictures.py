"""Opening a picture restores its mesh, appearance and camera."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtWidgets import QFileDialog, QPushButton

from hexmend import io
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.cut import Cut
from tests.app.driving import open_and_wait
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


def messages(window):
    return [" ".join(message[1:]) for message in window.messages.messages()]


def change_appearance(window, qtbot):
    """Change appearance and camera, and return them."""
    session = window.session
    session.view.change(
        cut=Cut.at((1, 0.2, 0), (0.5, 0.5, 0.5)),
        structure=Structure.of("sharp"),
        colours={"metric": "scaled-jacobian", "map": "plasma"},
        show={"hidden": frozenset({3, 5})},
    )
    window.refresh()
    qtbot.waitUntil(lambda: window.canvas.viewport.frame.look == session.view.look, timeout=PATIENCE)
    window.canvas.roll(15)
    return session.view.look, window.canvas.pose


@pytest.fixture
def mesh(tmp_path):
    io.write(tmp_path / "mesh.vtu", scrambled(grid(4), 0.5))
    return tmp_path / "mesh.vtu"


def test_a_picture_restores_mesh_appearance_and_camera(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    look, pose = change_appearance(window, qtbot)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    open_and_wait(qtbot, window, mesh)
    assert window.session.view.look != look
    open_and_wait(qtbot, window, tmp_path / "p.png")
    window.refresh()
    assert window.session.document.path == mesh
    assert window.session.view.look == look
    assert window.canvas.pose == pose
    assert "mesh.vtu is shown with the camera and appearance of p.png." in messages(window)[-1]
    assert window.features["save"].picture(tmp_path / "again.png", (300, 200))
    first, second = (np.asarray(Image.open(tmp_path / name)) for name in ("p.png", "again.png"))
    assert np.abs(first.astype(int) - second).mean() < 0.2


@pytest.mark.slow
def test_the_runs_of_a_picture_are_restored_as_a_recipe(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    stage = Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(stage)
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    window.session.commands.reset()
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "in which it was smoothed by “Laplacian" in messages(window)[-1]
    assert window.session.recipe_draft.stages == (stage,)


@pytest.mark.slow
def test_a_changed_mesh_file_is_reported(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(4))
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "The mesh differs from p.png" in messages(window)[-1]


@pytest.mark.slow
def test_a_missing_mesh_is_located_by_the_user(window, qtbot, mesh, tmp_path, monkeypatch):
    open_and_wait(qtbot, window, mesh)
    look, _ = change_appearance(window, qtbot)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    (tmp_path / "elsewhere").mkdir()
    moved = mesh.rename(tmp_path / "elsewhere" / "renamed.vtu")
    before = window.session.document.now
    with qtbot.waitSignal(window.session.opener.mesh_missing, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "p.png")
    assert window.session.document.now is before
    assert "The mesh of p.png was not found" in messages(window)[-1]
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(moved), ""))
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        next(button for button in window.findChildren(QPushButton) if button.text() == "Locate mesh…").click()
    assert window.session.document.path == moved
    assert window.session.view.look == look


@pytest.mark.slow
def test_a_picture_with_hexes_that_the_mesh_does_not_have_is_rejected(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    window.session.view.change(show={"hidden": frozenset({60})})
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(2))
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "p.png")
    assert "names hex 60" in messages(window)[-1]
