"""Opening a picture of several meshes restores all of them, or reports which are missing."""

import numpy as np
import pytest
from PIL import Image
from PySide6.QtWidgets import QFileDialog

from hexmend import METHODS, Mesh, Stage, StoppingCriteria, io
from hexmend.cli.main import main
from hexmend_app.picture import Cut, PicturePanel, Scene, WipeLayout, write_scene
from hexmend_app.picture.appearance import Structure
from hexmend_app.state.view.side_views import Wipe
from tests.app.driving import button, open_and_wait, smooth
from tests.core.grids import grid, scrambled

MESHES = {name: scrambled(grid(4), share) for name, share in (("one", 0.5), ("two", 0.3), ("three", 0.1))}


@pytest.fixture
def files(tmp_path):
    for name, mesh in MESHES.items():
        io.write(tmp_path / f"{name}.vtu", mesh)
    return {name: tmp_path / f"{name}.vtu" for name in MESHES}


def render(tmp_path, *paths, scene=None):
    write_scene(tmp_path / "scene.toml", scene or Scene())
    arguments = ["render", *map(str, paths), "-o", str(tmp_path / "p.png"), "--scene", str(tmp_path / "scene.toml")]
    assert main([*arguments, "--size", "300x150"]) == 0
    return tmp_path / "p.png"


def message(window):
    return window.messages.messages()[-1]


def test_other_meshes_are_shown_next_to_the_first(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, render(tmp_path, *files.values()))
    window.refresh()
    views = window.session.side_views.all
    assert window.session.document.path == files["one"]
    assert [view.name for view in views] == ["two", "three"]
    for view in views:
        np.testing.assert_array_equal(view.state.mesh.points, MESHES[view.name].points)
    expected = "one.vtu is shown with the camera and appearance of p.png. “two” and “three” are shown next to it."
    assert message(window)[1] == expected
    assert window.features["session"].save_and_wait(tmp_path / "work.hexmend")  # all have the hexes of the first
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    assert [view.name for view in window.session.side_views.all] == ["two", "three"]


@pytest.mark.slow
def test_a_wipe_is_restored_with_its_edge(window, qtbot, files, tmp_path):
    scene = Scene(panels=(PicturePanel(mesh=3, wipe=WipeLayout(1, 0.3, "now")),))
    open_and_wait(qtbot, window, render(tmp_path, *files.values(), scene=scene))
    window.refresh()
    assert window.session.document.path == files["three"]
    assert [view.name for view in window.session.side_views.all] == ["now (2)"]
    assert window.session.side_views.wipe == Wipe(0, 1, 0.3)
    assert "“now (2)” is shown with a wipe." in message(window)[1]


@pytest.mark.slow
def test_results_that_no_file_stores_are_reported(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, files["one"])
    session = window.session
    session.side_views.show("before", session.document.start)
    smooth(qtbot, session)
    session.side_views.show("a result", session.document.now)
    smooth(qtbot, session)
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 150))
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert [view.name for view in session.side_views.all] == ["before"]
    np.testing.assert_array_equal(session.side_views.all[0].state.mesh.points, MESHES["one"].points)
    kind, text, _ = message(window)
    assert kind == "info"
    assert "in which it was smoothed by “Laplacian" in text
    assert "“before” is shown next to it." in text
    assert "“a result” is not shown: it is an iteration or a result of a run on one.vtu" in text


@pytest.mark.slow
def test_results_stored_in_a_session_are_restored(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, files["one"])
    session = window.session
    smooth(qtbot, session)
    session.side_views.show("a result", session.document.now)
    smooth(qtbot, session)
    now, result = session.document.now.mesh.points, session.side_views.all[0].state.mesh.points
    assert window.features["save"].save_and_wait(tmp_path / "work.hexmend")
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 150))
    open_and_wait(qtbot, window, files["two"])
    open_and_wait(qtbot, window, tmp_path / "p.png")
    np.testing.assert_array_equal(session.document.now.mesh.points, now)
    (view,) = session.side_views.all
    np.testing.assert_array_equal(view.state.mesh.points, result)
    kind, text, _ = message(window)
    assert kind == "info"
    assert "appearance of p.png. To restore its runs, open work.hexmend." in text
    assert "“a result” is shown next to it." in text


def deleted(path):
    path.unlink()


def renumbered(path):
    mesh = MESHES["two"]
    io.write(path, Mesh(mesh.points, mesh.hexes[::-1].copy()))


def moved(path):
    io.write(path, scrambled(grid(4), 0.05))


def damaged(path):
    path.write_text("<VTKFile")


@pytest.mark.slow
@pytest.mark.parametrize(("change", "shown", "expected"), [
    (deleted, ["three"], "“two” is not shown: two.vtu was not found."),
    (renumbered, ["three"], "“two” is not shown: two.vtu has other hexes"),
    (damaged, ["three"], "“two” is not shown: "),
    (moved, ["two", "three"], "“two” differs from the picture: two.vtu has other node positions."),
])  # fmt: skip
def test_a_mesh_that_differs_from_the_picture_is_reported(window, qtbot, files, tmp_path, change, shown, expected):
    path = render(tmp_path, *files.values())
    change(files["two"])
    open_and_wait(qtbot, window, path)
    assert [view.name for view in window.session.side_views.all] == shown
    kind, title, text = message(window)
    assert (kind, title) == ("warning", "Part of p.png was not restored")
    assert expected in text


# Opening a picture restores its mesh, appearance and camera.


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
    qtbot.waitUntil(lambda: window.canvas.viewport.frame.look == session.view.look)
    window.canvas.roll(15)
    return session.view.look, window.canvas.pose


@pytest.fixture
def mesh(tmp_path):
    io.write(tmp_path / "mesh.vtu", scrambled(grid(4), 0.5))
    return tmp_path / "mesh.vtu"


@pytest.mark.slow
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
    smooth(qtbot, window.session)
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    window.session.commands.reset()
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "in which it was smoothed by “Laplacian" in messages(window)[-1]
    (stage,) = window.session.recipe_draft.stages
    assert stage == Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3, tolerance=0))


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
    with qtbot.waitSignal(window.session.opener.mesh_missing):
        window.features["open"].open(tmp_path / "p.png")
    assert window.session.document.now is before
    assert "The mesh of p.png was not found" in messages(window)[-1]
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(moved), ""))
    with qtbot.waitSignal(window.session.opener.ended):
        button(window, "Locate mesh…").click()
    assert window.session.document.path == moved
    assert window.session.view.look == look


@pytest.mark.slow
def test_a_picture_with_hexes_that_the_mesh_does_not_have_is_rejected(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    window.session.view.change(show={"hidden": frozenset({60})})
    window.refresh()
    assert window.features["save"].picture(tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(2))
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(tmp_path / "p.png")
    assert "names hex 60" in messages(window)[-1]
