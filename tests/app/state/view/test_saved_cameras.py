"""Saved cameras, and their data in session files."""

import threading

import pytest

from benchmarks.window.windows import save_and_wait
from hexmend.errors import FileError, ParameterError
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.picture import Camera
from hexmend_app.picture.named_cameras import cameras_of, merged
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session import Session
from hexmend_app.state.view.saved_cameras import SavedCameras
from tests.core.grids import grid
from tests.patience import PATIENCE

X, Y = Camera("+x"), Camera(position=(1.0, 2.0, 3.0), focal=(0.0, 0.0, 0.0), view_up=(0.0, 0.0, 1.0), scale=2.0)


@pytest.fixture
def cameras(qtbot):
    return SavedCameras()


def test_a_camera_replaces_one_with_the_same_name(cameras):
    changes = []
    cameras.changed.connect(lambda: changes.append(dict(cameras.all)))
    cameras.add("front", X)
    cameras.add("side", X)
    cameras.add("front", Y)
    cameras.add("front", Y)
    assert changes == [{"front": X}, {"front": X, "side": X}, {"front": Y, "side": X}]
    cameras.rename("front", "in front")
    assert list(cameras.all) == ["in front", "side"]
    cameras.rename("in front", "side")
    assert cameras.all == {"side": Y}
    cameras.remove("side")
    assert cameras.all == {}


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
def session(qtbot, tmp_path):
    session = Session()
    session.document.replace(State.of(grid(2)), tmp_path / "mesh.vtu")
    yield session
    session.close()


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
    session.document.replace(State.of(grid(3)), tmp_path / "mesh.vtu")
    session.saved_cameras.add("front", X)
    opened, write = threading.Event(), session_data.write

    def slow(*values):
        assert opened.wait(PATIENCE / 1000)
        write(*values)

    monkeypatch.setattr(session_data, "write", slow)
    saving = session.commands.save_in_background(tmp_path / "work.hexmend")
    with qtbot.waitSignal(session.opener.ended, timeout=PATIENCE):
        session.commands.open(tmp_path / "other.hexmend")
    assert not session.modified
    opened.set()
    qtbot.waitUntil(lambda: saving.over, timeout=PATIENCE)
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
    data["window"]["cameras"]["named"]["front"]["from"] = "beneath"
    write_archive(path, "Hexmend session", VERSION, data)
    with pytest.raises(FileError, match=r"work\.hexmend: has invalid cameras: .*front.* from = 'beneath' is unknown"):
        cameras_of(path)
