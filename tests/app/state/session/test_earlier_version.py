"""Files that version 0.1 wrote are read: a session with everything set, a scene, a picture and the settings."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QSettings

from hexmend.io.formats.session.session_file import VERSION
from hexmend_app.picture import read_scene
from hexmend_app.picture.appearance import Arrows, RangeMode, Since
from hexmend_app.picture.cut import CutStyle
from hexmend_app.picture.cut_planes import BoxClip
from hexmend_app.state.session import session_data
from hexmend_app.state.settings import settings
from tests.app.conftest import close, separate_settings, window_with_mesh
from tests.app.driving import open_and_wait

FILES = Path(__file__).parent / "files"


@pytest.mark.parametrize("version", [3, 4])
def test_all_of_a_session_is_restored(fresh_window, qtbot, version):
    window = fresh_window
    open_and_wait(qtbot, window, FILES / f"version_{version}.hexmend")
    window.refresh()
    session, features = window.session, window.features
    mesh = session.document.now.mesh
    assert mesh.hex_sets["bad"].tolist() == [7]
    assert np.count_nonzero(mesh.pinned) == 1
    (record,) = session.history.records
    assert (record.newest, record.plotted) == (2, False)
    assert (session.selection.hex, session.selection.node) == (7, None)
    assert "kept" in {snapshot.name for snapshot in session.snapshots.all}
    assert [view.name for view in session.side_views.all] == ["start"]
    assert set(session.saved_cameras.all) == {"kept"}
    look = session.view.look
    assert isinstance(look.clip, BoxClip)
    assert look.clip.notch
    assert (look.peel, look.shrink, look.isolation.hexes, look.isolation.rings) == (1, 0.21, (7,), 9)
    scale = look.scale
    assert (scale.metric, scale.map, scale.mode) == ("surface-distance", "cividis", RangeMode.FITTED)
    assert scale.reverse
    assert (look.traces.since, look.traces.arrows, look.traces.factor) == (Since.ITERATION, Arrows.ALL, 1.1)
    assert features["histogram"].panel.head.bins.value() == 50
    assert features["histogram"].panel.head.log
    charts = features["convergence"].panel.head.settings()
    assert charts.shown == ("objective", "quality", "inverted")
    assert (charts.logarithmic, charts.from_zero, charts.by_time) == (True, False, True)
    compare = features["compare"].panel.settings()
    assert compare.ticked == {"laplacian", "local-sd", "getme", "mend", "getme-sequential"}
    assert (compare.sorted_by, compare.descending) == ("q_min", True)
    assert features["cut"].panel.settings().boxed
    assert not features["hex_inspector"].worst_list.settings().isolates
    assert features["hex_inspector"].panel.corners_in_view
    assert (features["smooth"].panel.steps, features["tags"].panel.name) == (2, "7")
    pose = window.canvas.pose
    assert (round(pose.position[1], 2), pose.parallel) == (-110.16, True)
    assert window.canvas.can_go_back
    assert not window.session.modified


def test_what_is_read_of_it_is_written_anew(tmp_path):
    data = session_data.read(FILES / "version_4.hexmend")
    assert data.features["tag"] == "7"
    session_data.write(tmp_path / "again.hexmend", data)
    again = session_data.read(tmp_path / "again.hexmend")
    assert again.features == data.features
    assert again.view == data.view
    assert VERSION > 4


def test_a_scene_of_version_0_1_is_read():
    scene = read_scene(FILES / "scene-0.1.toml")
    assert scene.cut.style is CutStyle.SMOOTH
    assert scene.cut.notch
    assert scene.cut.planes[0].position == 0.4
    assert (scene.colours.metric, scene.colours.map, scene.colours.range) == ("edge-ratio", "cividis", (1.0, 4.0))
    assert scene.structure.sharp
    assert scene.structure.fixed
    assert (scene.camera.from_, scene.page.size, scene.page.shading) == ("-y", (160, 120), False)


def test_a_picture_of_version_0_1_opens_its_mesh_as_it_shows_it(fresh_window, qtbot, tmp_path):
    window = fresh_window
    for name, copy in (("picture-0.1.png", "picture.png"), ("picture-0.1.vtu", "bridge.vtu")):
        shutil.copy(FILES / name, tmp_path / copy)
    open_and_wait(qtbot, window, tmp_path / "picture.png")
    window.refresh()
    look = window.session.view.look
    assert window.session.document.now.mesh.n_hexes == 108
    assert (look.scale.metric, look.scale.map, look.scale.pinned) == ("edge-ratio", "cividis", (1.0, 4.0))
    assert look.clip.notch
    assert (look.structure.sharp, look.structure.fixed) == (True, True)


@pytest.fixture
def window_with_old_settings(qtbot, tmp_path, mesh_file):
    """A window whose settings version 0.1 wrote."""
    with separate_settings(tmp_path / "settings"):
        file = Path(QSettings().fileName())
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(FILES / "settings-0.1.conf", file)
        QSettings().sync()
        window = window_with_mesh(qtbot, mesh_file)
        yield window
        close(window)


def test_settings_of_version_0_1_are_read(window_with_old_settings):
    window = window_with_old_settings
    assert (settings.HISTORY_MEGABYTES.get(), settings.ITERATIONS_PLAYED.get()) == (1024, 20)
    assert settings.THEME.get() == "dark"
    assert Path("/tmp/sessions/bridge.vtu") in settings.RECENT.get()
    assert window.session.history.limit == 1024 << 20
    assert window.session.timeline.speed == 20
    assert {"run", "cut", "histogram", "compare"} <= set(window.docks.ids())
