"""Opening meshes in the window: by menu, drag and drop and the welcome page; errors; cancelling."""

import shutil
import threading

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QPushButton

from hexmend import METHODS, Mesh, Stage, StoppingCriteria, gallery, io
from hexmend.cli.main import main
from hexmend.gallery import make
from hexmend.io.storage.file_progress import FileAction, file_operation, report
from hexmend_app.features.open.welcome import RecentMenu, card
from hexmend_app.picture import Cut, PicturePanel, Scene, WipeLayout, write_scene
from hexmend_app.picture.appearance import Structure
from hexmend_app.resources import demo_mesh
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.settings.settings import MAX_RECENT_FILES
from hexmend_app.state.tasks import file_watcher, mesh_opener
from hexmend_app.state.tasks.task import running
from hexmend_app.state.view.side_views import Wipe
from tests.app.driving import LEFT, button, key, named, open_and_wait, press, smooth, write_picture
from tests.app.invalid_hexes import INSIDE, THREE
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid, scrambled
from tests.core.smoothers.mend.test_mend import with_locked_corner
from tests.patience import PATIENCE


@pytest.fixture
def recent(window, qtbot, mesh_file):
    """Return the recent files: that of the mesh."""
    open_and_wait(qtbot, window, mesh_file)
    return window.features["open"].recent


@pytest.fixture
def menu(window):
    """Return the menu of recent files."""
    (menu,) = window.findChildren(RecentMenu)
    return menu


@pytest.mark.slow
def test_recent_files_are_listed_once_each_newest_first(window, qtbot, recent, menu, tmp_path, mesh_file):
    assert recent.files() == [mesh_file]
    other = tmp_path / "R&D" / "other.vtu"
    other.parent.mkdir()
    shutil.copy(mesh_file, other)
    open_and_wait(qtbot, window, other)
    open_and_wait(qtbot, window, demo_mesh())
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(tmp_path / "nowhere.vtu")
    assert recent.files() == [other, mesh_file]
    with qtbot.waitSignal(window.session.opener.ended) as ended:
        menu.popup(QPoint(50, 50))
        QTest.keyClick(menu, Qt.Key.Key_2)
    assert ended.args == [mesh_file]
    assert recent.files() == [mesh_file, other]
    assert menu.isHidden()


@pytest.mark.slow
def test_a_missing_file_is_disabled_and_the_list_can_be_cleared(recent, menu, tmp_path):
    for k in range(MAX_RECENT_FILES + 2):
        recent.add(tmp_path / f"mesh{k}.vtu")
    assert len(recent.files()) == MAX_RECENT_FILES
    menu.popup(QPoint(50, 50))
    missing = menu.actions()[0]
    assert "not found" in missing.text()
    assert not missing.isEnabled()
    QTest.keyClick(menu, Qt.Key.Key_C)
    assert recent.files() == []
    assert not menu.menuAction().isEnabled()


@pytest.mark.slow
def test_the_welcome_page_opens_recent_files(window, recent, qtbot, mesh_file):
    welcome = window.features["open"].welcome
    assert not welcome.isVisible()
    welcome.show()
    link = next(b for b in welcome.findChildren(QPushButton) if mesh_file.name in b.text())
    with qtbot.waitSignal(window.session.opener.ended):
        QTest.mouseClick(link, LEFT)


def drop(window, qtbot, path):
    """Drag a file or folder into the window, drop it, and wait until it is open."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    drag = Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier
    entered, dropped = QDragEnterEvent(QPoint(50, 50), *drag), QDropEvent(QPointF(50, 50), *drag)
    QApplication.sendEvent(window, entered)
    assert entered.isAccepted()
    with qtbot.waitSignal(window.session.opener.ended):
        QApplication.sendEvent(window, dropped)
    window.refresh()


def test_a_dropped_file_is_opened(window, qtbot, tmp_path):
    io.write(tmp_path / "five.mesh", gallery.make("five-side", size=500))
    drop(window, qtbot, tmp_path / "five.mesh")
    assert window.windowTitle().startswith("five.mesh")


@pytest.mark.slow
def test_a_dropped_folder_of_a_case_is_opened_and_saved(window, qtbot, tmp_path):
    mesh = gallery.make("five-side", size=500)
    io.write(tmp_path / "case" / "case.foam", mesh)
    drop(window, qtbot, tmp_path / "case" / "constant" / "polyMesh")
    assert window.windowTitle().startswith("case[*] ")
    assert window.features["open"].recent.files()[0] == tmp_path / "case"
    (tmp_path / "case/system").mkdir()
    (tmp_path / "copy").mkdir()
    with qtbot.waitSignal(window.session.saver.ended):
        window.session.commands.save_in_background(tmp_path / "copy" / "copy.foam")
    window.refresh()
    assert window.windowTitle().startswith("copy[*] ")
    assert window.features["open"].recent.files()[0] == tmp_path / "copy"
    assert (tmp_path / "copy/system").is_dir()
    assert io.read(tmp_path / "copy").n_hexes == mesh.n_hexes


def test_an_unreadable_file_shows_an_error_and_the_open_mesh_stays(window, qtbot, tmp_path):
    bad = tmp_path / "cut.vtk"
    bad.write_text("# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0\n")
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(bad)
    assert window.session.document.now is now
    ((kind, title, text),) = window.messages.messages()
    assert kind == "error"
    assert "cut.vtk" in title
    assert "POINTS ends after 1 of 8 rows" in text
    assert "bridge.vtu stays open" in text
    assert window.messages.isVisible()
    key(window, Qt.Key.Key_Escape)
    assert not window.messages.isVisible()


# Cancelling


@pytest.fixture
def slow_read(monkeypatch):
    """Block reading until the yielded event is set."""
    proceed, read = threading.Event(), mesh_opener.read

    def blocked_read(path):
        proceed.wait(PATIENCE / 1000)
        return read(path)

    monkeypatch.setattr(mesh_opener, "read", blocked_read)
    yield proceed
    proceed.set()


@pytest.mark.slow
def test_opening_shows_its_progress_and_is_cancelled(window, qtbot, recent, slow_read, mesh_file, tmp_path):
    other = tmp_path / "slow.vtu"
    shutil.copy(mesh_file, other)
    before = window.session.document.now
    window.session.selection.choose(3)
    window.features["open"].open(other)
    assert window.busy.isVisible()
    assert "Reading slow.vtu" in window.busy.text()
    key(window, Qt.Key.Key_Escape)
    assert not window.session.opener.busy
    assert not window.busy.isVisible()
    assert window.session.selection.hex == 3  # Esc cancelled the opening only
    assert "Opening slow.vtu was cancelled" in window.messages.messages()[-1][1]
    slow_read.set()
    qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()))
    assert window.session.document.now is before
    assert recent.files() == [mesh_file]
    open_and_wait(qtbot, window, other)
    assert window.session.document.name == "slow.vtu"


@pytest.mark.slow
def test_a_cancelled_file_is_read_no_further(window, qtbot, monkeypatch, mesh_file, tmp_path):
    """The thread ends although the file would take for ever."""
    monkeypatch.setattr(file_watcher, "INTERVAL", 0.0)
    failed = threading.Event()

    def endless_read(path):
        with file_operation(path, FileAction.READING):
            while not failed.wait(0.01):
                report(0.4)

    monkeypatch.setattr(mesh_opener, "read", endless_read)
    before = window.session.document.now
    window.features["open"].open(tmp_path / "endless.vtu")
    qtbot.waitUntil(lambda: window.busy.text().startswith("Reading endless.vtu: 40%"))
    press(named(window.busy, QPushButton, "Cancel"))
    try:
        qtbot.waitUntil(lambda: not any(task.name.startswith("reading") for task in running()))
    finally:
        failed.set()  # otherwise the thread would be left
    assert window.session.document.now is before
    assert "Opening endless.vtu was cancelled" in window.messages.messages()[-1][1]
    assert not any("cannot be opened" in title for title, *_ in window.messages.messages())


# Card after opening: what the mesh is, what is wrong with it, and what to do next.


def text_of(mesh):
    return card("a.vtu", MeasuredMesh.of(mesh), ())[1]


def test_it_counts_and_says_what_to_do():
    title, text = card("a.vtu", MeasuredMesh.of(make("bridge-sharp", size=864, scramble=0.6)), ())
    assert title.startswith("a.vtu: 864 hexes, ")
    assert "Run Mend to untangle them" in text
    assert text_of(make("cube", size=27)) == "No hex is invalid. Minimum scaled Jacobian 1.0000."
    flat = make("cube", size=27)
    assert "some have a low quality" in text_of(
        flat.with_points(flat.points * [1, 1, 1] + 1.3 * np.sin(flat.points[:, ::-1] * 7) / 7)
    )


def test_it_says_that_hexes_are_invalid_inside():
    inside = Mesh(THREE.points[THREE.hexes[INSIDE]], [range(8)])
    title, text = card("a.vtu", MeasuredMesh.of(inside), ())
    assert title == "a.vtu: 1 hex, 0 inverted, 1 invalid"
    assert text.startswith("Solvers may reject 1 hex invalid inside, between valid corners.")


def test_it_says_what_fixed_nodes_hold():
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    assert "Fixed nodes" in text_of(mesh)


def test_it_counts_materials_and_tells_the_order():
    assert "2 materials." in text_of(make("materials", size=300))
    assert "second order" in text_of(curved_shell(20))
    assert "second order" not in text_of(make("cube", size=27))


@pytest.mark.slow
def test_the_doctor_is_heard_on_the_card(window, qtbot, tmp_path):
    mesh = make("cube", size=27)
    twice = Mesh(np.concatenate([mesh.points, mesh.points + [mesh.points[:, 0].max(), 0, 0]]),
                 np.concatenate([mesh.hexes, mesh.hexes + mesh.n_nodes]))  # fmt: skip
    io.write(tmp_path / "blocks.vtu", twice)
    open_and_wait(qtbot, window, tmp_path / "blocks.vtu")
    assert window.messages.title.startswith("blocks.vtu: 54 hexes, 0 inverted, 0 invalid")
    qtbot.waitUntil(lambda: "The doctor found" in window.messages.text)


# Opening a picture of several meshes restores all of them, or reports which are missing.


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
    assert window.features["save"].save_and_wait(tmp_path / "work.hexmend")  # all have the hexes of the first
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
    assert write_picture(window, tmp_path / "p.png", (300, 150))
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
    assert write_picture(window, tmp_path / "p.png", (300, 150))
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
    assert write_picture(window, tmp_path / "p.png", (300, 200))
    open_and_wait(qtbot, window, mesh)
    assert window.session.view.look != look
    open_and_wait(qtbot, window, tmp_path / "p.png")
    window.refresh()
    assert window.session.document.path == mesh
    assert window.session.view.look == look
    assert window.canvas.pose == pose
    assert "mesh.vtu is shown with the camera and appearance of p.png." in " ".join(message(window))
    assert write_picture(window, tmp_path / "again.png", (300, 200))
    first, second = (np.asarray(Image.open(tmp_path / name)) for name in ("p.png", "again.png"))
    assert np.abs(first.astype(int) - second).mean() < 0.2


@pytest.mark.slow
def test_the_runs_of_a_picture_are_restored_as_a_recipe(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    smooth(qtbot, window.session)
    window.refresh()
    assert write_picture(window, tmp_path / "p.png", (300, 200))
    window.session.commands.reset()
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "in which it was smoothed by “Laplacian" in " ".join(message(window))
    (stage,) = window.session.recipe_draft.stages
    assert stage == Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3, tolerance=0))


@pytest.mark.slow
def test_a_changed_mesh_file_is_reported(window, qtbot, mesh, tmp_path):
    open_and_wait(qtbot, window, mesh)
    assert write_picture(window, tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(4))
    open_and_wait(qtbot, window, tmp_path / "p.png")
    assert "The mesh differs from p.png" in " ".join(message(window))


@pytest.mark.slow
def test_a_missing_mesh_is_located_by_the_user(window, qtbot, mesh, tmp_path, monkeypatch):
    open_and_wait(qtbot, window, mesh)
    look, _ = change_appearance(window, qtbot)
    assert write_picture(window, tmp_path / "p.png", (300, 200))
    (tmp_path / "elsewhere").mkdir()
    moved = mesh.rename(tmp_path / "elsewhere" / "renamed.vtu")
    before = window.session.document.now
    with qtbot.waitSignal(window.session.opener.mesh_missing):
        window.features["open"].open(tmp_path / "p.png")
    assert window.session.document.now is before
    assert "The mesh of p.png was not found" in " ".join(message(window))
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
    assert write_picture(window, tmp_path / "p.png", (300, 200))
    io.write(mesh, grid(2))
    with qtbot.waitSignal(window.session.opener.failed):
        window.features["open"].open(tmp_path / "p.png")
    assert "names hex 60" in " ".join(message(window))
