"""Pictures of several meshes bring all of them back, or say of which they cannot."""

from __future__ import annotations

import numpy as np
import pytest

from hexmend import io
from hexmend.cli.main import main
from hexmend.mesh.mesh import Mesh
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture import PicturePanel, Scene, WipeLayout, write_scene
from hexmend_app.state.view.side_views import Wipe
from tests.app.driving import open_and_wait
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE

MESHES = {name: scrambled(grid(4), share) for name, share in (("one", 0.5), ("two", 0.3), ("three", 0.1))}


@pytest.fixture
def files(tmp_path):
    for name, mesh in MESHES.items():
        io.write(tmp_path / f"{name}.vtu", mesh)
    return {name: tmp_path / f"{name}.vtu" for name in MESHES}


def drawn(tmp_path, *paths, scene=None):
    write_scene(tmp_path / "scene.toml", scene or Scene())
    words = ["render", *map(str, paths), "-o", str(tmp_path / "p.png"), "--scene", str(tmp_path / "scene.toml")]
    assert main([*words, "--size", "300x150"]) == 0
    return tmp_path / "p.png"


def message(window):
    return window.messages.messages()[-1]


def test_others_stand_beside_the_first_each_from_its_file(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, drawn(tmp_path, *files.values()))
    window.refresh()
    views = window.session.side_views.all
    assert window.session.document.path == files["one"]
    assert [one.name for one in views] == ["two", "three"]
    for one in views:
        np.testing.assert_array_equal(one.state.mesh.points, MESHES[one.name].points)
    assert message(window)[1] == "one.vtu is looked at as in p.png. “two” and “three” are shown next to it."
    assert window.features["session"].save_and_wait(tmp_path / "work.hexmend")  # they are states of the one mesh
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    assert [one.name for one in window.session.side_views.all] == ["two", "three"]


def test_a_wipe_comes_back_with_its_edge(window, qtbot, files, tmp_path):
    scene = Scene(panels=(PicturePanel(mesh=3, wipe=WipeLayout(1, 0.3, "now")),))
    open_and_wait(qtbot, window, drawn(tmp_path, *files.values(), scene=scene))
    window.refresh()
    assert window.session.document.path == files["three"]
    assert [one.name for one in window.session.side_views.all] == ["now (2)"]
    assert window.session.side_views.wipe == Wipe(0, 1, 0.3)
    assert "“now (2)” is wiped over it." in message(window)[1]


def run(window, qtbot):
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3, tolerance=0)))
    window.refresh()


@pytest.mark.slow
def test_what_no_file_gives_is_said(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, files["one"])
    session = window.session
    session.side_views.show("before", session.document.start)
    run(window, qtbot)
    session.side_views.show("a result", session.document.now)
    run(window, qtbot)
    assert window.features["save"].picture(tmp_path / "p.png", (300, 150))
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert [one.name for one in session.side_views.all] == ["before"]
    np.testing.assert_array_equal(session.side_views.all[0].state.mesh.points, MESHES["one"].points)
    kind, text, _ = message(window)
    assert kind == "info"
    assert text.startswith("one.vtu is looked at as in p.png, which shows it after “Laplacian”")
    assert "“before” is shown next to it." in text
    assert (
        "“a result” is not shown: it is an iteration or a result of a run on one.vtu, which that file does not hold"
        in text
    )


@pytest.mark.slow
def test_of_a_session_results_come_back_too(window, qtbot, files, tmp_path):
    open_and_wait(qtbot, window, files["one"])
    session = window.session
    run(window, qtbot)
    session.side_views.show("a result", session.document.now)
    run(window, qtbot)
    now, beside = session.document.now.mesh.points, session.side_views.all[0].state.mesh.points
    assert window.features["save"].save_and_wait(tmp_path / "work.hexmend")
    assert window.features["save"].picture(tmp_path / "p.png", (300, 150))
    open_and_wait(qtbot, window, files["two"])
    open_and_wait(qtbot, window, tmp_path / "p.png")
    np.testing.assert_array_equal(session.document.now.mesh.points, now)
    (view,) = session.side_views.all
    np.testing.assert_array_equal(view.state.mesh.points, beside)
    kind, text, _ = message(window)
    assert kind == "info"
    assert "looked at as in p.png. Its runs are not: open work.hexmend itself for them." in text
    assert "“a result” is shown next to it." in text


def gone(path):
    path.unlink()


def other_hexes(path):
    io.write(path, grid(3))


def renumbered(path):
    mesh = MESHES["two"]
    io.write(path, Mesh(mesh.points, mesh.hexes[::-1].copy()))


def moved(path):
    io.write(path, scrambled(grid(4), 0.05))


def damaged(path):
    path.write_text("<VTKFile")


@pytest.mark.parametrize(("change", "shown", "words"), [
    (gone, ["three"], "“two” is not shown: two.vtu is not there."),
    (other_hexes, ["three"], "“two” is not shown: two.vtu has other hexes"),
    (renumbered, ["three"], "“two” is not shown: two.vtu has other hexes"),
    (damaged, ["three"], "“two” is not shown: "),
    (moved, ["two", "three"], "“two” is another than in the picture: two.vtu has its nodes elsewhere."),
])  # fmt: skip
def test_another_mesh_than_in_the_picture_is_said(window, qtbot, files, tmp_path, change, shown, words):
    path = drawn(tmp_path, *files.values())
    change(files["two"])
    open_and_wait(qtbot, window, path)
    assert [one.name for one in window.session.side_views.all] == shown
    kind, title, text = message(window)
    assert (kind, title) == ("warning", "This is not all that p.png shows")
    assert words in text


def test_of_many_there_are_as_many_as_the_window_has_room_for(window, qtbot, files, tmp_path):
    path = drawn(tmp_path, *[files["one"]] * 2, *[files["two"]] * 2, files["three"])
    open_and_wait(qtbot, window, path)
    assert [one.name for one in window.session.side_views.all] == ["one (2)", "two", "two (2)"]
    assert "“three” is not shown: the window shows at most 4 views." in message(window)[1]
