"""Saved cameras, and their data in session files."""

import threading

import pytest

from benchmarks.window.windows import save_and_wait
from hexmend import FileError, ParameterError, gallery
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.picture import Camera
from hexmend_app.picture.camera import cameras_of, merged
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.session import session_data
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.state.view.side_views import SideViews, Snapshots, Wipe
from tests.core.grids import grid
from tests.patience import PATIENCE

X, Y = Camera("+x"), Camera(position=(1.0, 2.0, 3.0), focal=(0.0, 0.0, 0.0), view_up=(0.0, 0.0, 1.0), scale=2.0)


@pytest.fixture
def cameras(qtbot):
    return SavedCameras()


@pytest.mark.parametrize("name", ["", " front", "a\nb", "x" * 300])
def test_an_invalid_name_is_an_error(cameras, name):
    with pytest.raises(ParameterError):
        cameras.add(name, X)
    assert cameras.all == {}


def test_cameras_of_a_scene_are_added_under_free_names(cameras):
    cameras.add("front", X)
    for _ in range(2):  # equal cameras are not added again
        cameras.add_all({"front": Y, "top": Y})
        assert cameras.all == {"front": X, "front (2)": Y, "top": Y}
    assert merged({}, {"front": Y}) == {"front": Y}


@pytest.fixture
def session(hosted, tmp_path):
    return hosted(grid(2), tmp_path / "mesh.vtu").session


def test_a_session_is_modified_if_its_cameras_differ_from_its_file(session, tmp_path):
    session.saved_cameras.add("front", X)
    assert not session.modified  # a mesh file has no cameras
    save_and_wait(session, tmp_path / "work.hexmend")
    assert not session.modified
    session.saved_cameras.add("top", Y)
    assert session.modified
    assert session.document.undo_title is None
    save_and_wait(session, tmp_path / "work.hexmend")
    assert not session.modified


def test_saving_a_session_while_another_is_opened_does_not_modify_the_other(session, tmp_path, qtbot, monkeypatch):
    save_and_wait(session, tmp_path / "other.hexmend")
    session.document.replace(MeasuredMesh.of(grid(3)), tmp_path / "mesh.vtu")
    session.saved_cameras.add("front", X)
    opened, write = threading.Event(), session_data.write

    def slow(*values):
        assert opened.wait(PATIENCE / 1000)
        write(*values)

    monkeypatch.setattr(session_data, "write", slow)
    saving = session.commands.save_in_background(tmp_path / "work.hexmend")
    with qtbot.waitSignal(session.opener.ended):
        session.commands.open(tmp_path / "other.hexmend")
    assert not session.modified
    opened.set()
    qtbot.waitUntil(lambda: saving.over)
    assert saving.error is None
    assert session.document.path == tmp_path / "other.hexmend"
    assert not session.modified
    assert cameras_of(tmp_path / "work.hexmend") == {"front": X}


def test_cameras_are_read_from_a_file_and_errors_name_the_camera(session, tmp_path):
    session.saved_cameras.add("front", X)
    session.saved_cameras.add("top", Y)
    path = tmp_path / "work.hexmend"
    save_and_wait(session, path)
    assert cameras_of(path) == {"front": X, "top": Y}
    data = read_archive(path, "Hexmend session", VERSION)
    data["window"]["saved_cameras"]["named"]["front"]["from"] = "beneath"
    write_archive(path, "Hexmend session", VERSION, data)
    with pytest.raises(FileError, match=r"work\.hexmend: has invalid cameras: .*front.* from = 'beneath' is unknown"):
        cameras_of(path)


# Side views: their number, their names and their arrangement.


@pytest.fixture
def document(qapp):
    document = Document()
    document.replace(MeasuredMesh.of(gallery.make("cube", size=8)), None)
    return document


@pytest.fixture
def views(document):
    return SideViews(document, Snapshots(document))


@pytest.fixture
def states(document):
    mesh = document.now.mesh
    return [MeasuredMesh.of(mesh.with_points(mesh.points * scale)) for scale in (1.0, 2.0, 3.0, 4.0)]


def test_a_wipe_needs_two_views_and_ends_with_the_second(views, states):
    views.set_wiping(True)
    assert views.wipe is None
    views.show("a", states[0])
    views.show("b", states[1])
    views.set_wiping(True)
    assert views.wipe == Wipe(0, 2)
    views.close_view(1)
    assert views.wipe == Wipe(0, 1)
    views.close_view(1)
    assert views.wipe is None


def test_choosing_one_view_for_both_sides_swaps_the_sides(views, states):
    for k, state in enumerate(states[:2]):
        views.show(str(k), state)
    views.set_wiping(True)
    views.choose_wiped(1, 2)
    assert (views.wipe.left, views.wipe.right) == (1, 2)
    views.choose_wiped(2, 2)
    assert (views.wipe.left, views.wipe.right) == (2, 1)


@pytest.mark.parametrize(("requested", "low", "high"), [(-3.0, 0.01, 0.1), (0.4, 0.4, 0.4), (7.0, 0.9, 0.99)])
def test_the_edge_stays_within_the_view(views, states, requested, low, high):
    views.show("a", states[0])
    views.move_wipe(0.2)
    assert views.wipe is None
    views.set_wiping(True)
    positions = []
    views.wiped.connect(lambda: positions.append(views.wipe.at))
    views.move_wipe(requested)
    assert low <= views.wipe.at <= high
    assert positions == [views.wipe.at]


def test_a_view_has_a_snapshot_as_long_as_it_is_open(document, states):
    snapshots = Snapshots(document)
    views = SideViews(document, snapshots)
    views.show("first", states[0])
    views.show("second", states[1])
    assert [snapshot.name for snapshot in snapshots.all] == ["first", "second"]
    views.show("first", states[2])
    assert [snapshot.name for snapshot in snapshots.all] == ["second", "first"]
    assert snapshots.of(states[0]) is None
    views.close_view(1)
    assert [snapshot.name for snapshot in snapshots.all] == ["second"]
    views.close_all()
    assert snapshots.all == ()
