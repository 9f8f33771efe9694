"""Pictures that are opened show again what they show."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtWidgets import QFileDialog, QPushButton

from hexmend import io
from hexmend.cli.main import main
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture.appearance import ColourScale, Structure
from hexmend_app.picture.cut_planes import PlaneClip
from tests.app.driving import open_and_wait
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


def said(window):
    return [" ".join(message[1:]) for message in window.messages.messages()]


def looked_at(window, qtbot):
    session = window.session
    session.view.change(
        clip=PlaneClip.at((1, 0.2, 0), (0.5, 0.5, 0.5)),
        structure=Structure(sharp=True),
        scale=ColourScale("scaled-jacobian", "plasma"),
        dug=frozenset({3, 5}),
    )
    window.refresh()
    qtbot.waitUntil(lambda: window.canvas.viewport.frame.look == session.view.look, timeout=PATIENCE)
    window.canvas.roll(15)
    return session.view.look, window.canvas.pose


@pytest.fixture
def mesh(tmp_path):
    io.write(tmp_path / "mesh.vtu", scrambled(grid(4), 0.5))
    return tmp_path / "mesh.vtu"


@pytest.mark.slow
def test_a_picture_brings_back_mesh_look_and_camera(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    look, pose = looked_at(window, qtbot)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    open_and_wait(qtbot, window, mesh)
    assert window.session.view.look != look
    open_and_wait(qtbot, window, tmp_path / "p.png")
    window.refresh()
    assert window.session.document.path == mesh
    assert window.session.view.look == look
    assert window.canvas.pose == pose
    assert "mesh.vtu is looked at as in p.png." in said(window)[-1]
    assert window.features["save"].picture(tmp_path / "again.png", (300, 200))
    one, other = (np.asarray(Image.open(tmp_path / name)) for name in ("p.png", "again.png"))
    assert np.abs(one.astype(int) - other).mean() < 0.2


@pytest.mark.slow
def test_what_ran_comes_back_as_a_recipe(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    stage = Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(stage)
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    window.session.commands.reset()
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "shows it after “Laplacian" in said(window)[-1]
    assert window.session.recipe_draft.stages == (stage,)


def test_a_picture_of_the_command_line_is_opened_too(window, qtbot, mesh, tmp_path):
    assert main(["render", str(mesh), "-o", str(tmp_path / "p.png"), "--size", "200x150", "--view", "-y"]) == 0
    open_and_wait(qtbot, window, tmp_path / "p.png")
    window.refresh()
    pose = window.canvas.pose
    assert pose.position[1] < pose.focal[1]


def test_another_mesh_of_the_name_is_said(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(4))
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "This is not the mesh of p.png" in said(window)[-1]


@pytest.mark.slow
def test_a_mesh_that_is_gone_is_asked_for(window, qtbot, mesh, tmp_path, monkeypatch):
    open_and_wait(qtbot, window, mesh)
    look, _ = looked_at(window, qtbot)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    (tmp_path / "elsewhere").mkdir()
    moved = mesh.rename(tmp_path / "elsewhere" / "renamed.vtu")
    before = window.session.document.now
    with qtbot.waitSignal(window.session.opener.wanting, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "p.png")
    assert window.session.document.now is before
    assert "Where is the mesh of p.png?" in said(window)[-1]
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(moved), ""))
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        next(one for one in window.findChildren(QPushButton) if one.text() == "Choose the mesh…").click()
    assert window.session.document.path == moved
    assert window.session.view.look == look


def test_a_picture_without_a_scene_is_refused(window, qtbot, tmp_path):
    Image.new("RGB", (4, 4)).save(tmp_path / "p.png")
    before = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "p.png")
    assert "p.png cannot be opened this picture contains no scene" in said(window)[-1]
    assert window.session.document.now is before


def test_hexes_that_the_mesh_has_not_are_refused(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    window.session.view.change(dug=frozenset({60}))
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(2))
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(tmp_path / "p.png")
    assert "names hex 60" in said(window)[-1]
