"""Cuts by whole hexes made before the mesh moved: scenes, pictures and sessions restore the same hexes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from hexmend import io
from hexmend.cli.main import main
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture import Cut, Page, write_scene
from tests.app.driving import open_and_wait
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow

CUT = Cut.at((1, 0.3, 0), (2.1, 2.0, 2.0))


@pytest.fixture
def moved(window, qtbot, tmp_path):
    """Cut and then smooth a mesh; return a mask of the visible hexes, which differ from those of a new cut."""
    io.write(tmp_path / "mesh.vtu", scrambled(grid(4), 0.9))
    open_and_wait(qtbot, window, tmp_path / "mesh.vtu")
    window.session.view.set_cut(CUT)
    window.refresh()
    kept = window.canvas.viewport.kept()
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=5, tolerance=0)))
    window.refresh()
    np.testing.assert_array_equal(window.canvas.viewport.kept(), kept)
    window.features["save"].save_and_wait(tmp_path / "mesh.vtu")
    return kept


def rendered(tmp_path, scene, *meshes):
    write_scene(tmp_path / "scene.toml", scene)
    out = tmp_path / "rendered.png"
    assert main(["render", *map(str, meshes), "--scene", str(tmp_path / "scene.toml"), "-o", str(out)]) == 0
    return np.asarray(Image.open(out)).astype(int)


def test_the_command_line_draws_the_same_hexes_as_the_window(window, moved, tmp_path):
    scene = window.canvas.scene(Page(pixels=(400, 300)))
    assert window.features["save"].picture(tmp_path / "p.png", (400, 300))
    seen = np.asarray(Image.open(tmp_path / "p.png")).astype(int)
    drawn = rendered(tmp_path, scene, tmp_path / "mesh.vtu")
    assert np.abs(drawn - seen).mean() < 0.2
    anew = rendered(tmp_path, replace(scene, cut=CUT), tmp_path / "mesh.vtu")
    assert np.abs(anew - seen).mean() > 1


def test_pictures_and_sessions_restore_the_cut_hexes(window, moved, qtbot, tmp_path):
    assert window.features["save"].picture(tmp_path / "p.png", (200, 150))
    assert window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    for name in ("p.png", "work.hexmend"):
        open_and_wait(qtbot, window, tmp_path / "mesh.vtu")
        window.session.view.set_cut(CUT)
        window.refresh()
        assert (window.canvas.viewport.kept() != moved).any()
        open_and_wait(qtbot, window, tmp_path / name)
        window.refresh()
        np.testing.assert_array_equal(window.canvas.viewport.kept(), moved)
    window.session.view.set_cut(CUT)  # a new cut
    window.refresh()
    assert (window.canvas.viewport.kept() != moved).any()
