"""Files that version 0.1 wrote are read: a session with everything set, a scene, a picture and the settings."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QSettings

from hexmend.errors import FileError
from hexmend.io.archive.archive import read_archive, write_archive
from hexmend.io.formats.session.session_file import VERSION
from hexmend_app.picture import Colours, Isolate, Plane, Range, Show, read_scene
from hexmend_app.picture.appearance import Arrows, Since, Structure, Traces
from hexmend_app.picture.cut import Cut, CutKind, CutStyle
from hexmend_app.state.session import session_data
from hexmend_app.state.settings import settings
from tests.app.conftest import close, separate_settings, window_with_mesh
from tests.app.driving import open_and_wait
from tests.app.state.session.former_look import former_look

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
    assert look.cut.box is not None
    assert look.cut.notch
    assert (look.show.peel, look.show.shrink, look.show.isolate.hexes, look.show.isolate.rings) == (1, 0.21, (7,), 9)
    colours = look.colours
    assert (colours.metric, colours.map, colours.range) == ("surface-distance", "cividis", Range.FITTED)
    assert colours.reverse
    assert (look.movement.since, look.movement.arrows, look.movement.factor) == (Since.ITERATION, Arrows.ALL, 1.1)
    assert features["histogram"].panel.head.bins.value() == 50
    assert features["histogram"].panel.head.log
    charts = features["convergence"].panel.head.settings()
    assert charts.shown == ("objective", "quality", "inverted")
    assert (charts.logarithmic, charts.from_zero, charts.by_time) == (True, False, True)
    compare = features["compare"].panel.settings()
    assert compare.ticked == {"laplacian", "local-sd", "getme", "mend", "getme-sequential"}
    assert (compare.sorted_by, compare.descending) == ("q_min", True)
    assert features["cut"].panel.settings().kind is CutKind.BOX
    assert not features["hex_inspector"].worst_list.settings().isolates
    assert features["hex_inspector"].panel.corners_in_view
    assert (features["smooth"].panel.steps, features["tags"].panel.name) == (2, "7")
    pose = window.canvas.pose
    assert (round(pose.position[1], 2), pose.parallel) == (-110.16, True)
    assert window.canvas.can_go_back
    assert not window.session.modified


def test_the_look_of_a_session_of_version_5_is_read():
    data = session_data.read(FILES / "version_5.hexmend")
    view = data.view
    look, mesh = view.look, data.document.now.mesh
    assert (view.dug, view.plane_at, view.rings, view.counted) == ((40, 3, 12), 1, 3, "scaled-jacobian")
    assert look.show == Show(
        quality=(0.05, math.inf),
        metric="scaled-jacobian",
        inverted=True,
        peel=1,
        isolate=Isolate((7, 2, 40), 3),
        hidden=frozenset({3, 12, 40}),
        shrink=0.13,
        outline=False,
    )
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    planes = Plane((1, 1, 0), point=tuple((low + high) / 2)), Plane((0, 0, 1), point=tuple((low + 3 * high) / 4))
    assert look.cut.with_hexes(None) == Cut(planes, style=CutStyle.CRINKLE, notch=True)
    assert np.flatnonzero(~look.cut.listed(mesh.n_hexes))[:4].tolist() == [7, 9, 10, 359]
    assert look.colours == Colours("edge-ratio", "plasma", (1.25, 4.0), reverse=True, neutral=True)
    assert look.structure == Structure(frozenset({"irregular", "sharp", "fixed", "locked", "curved"}))
    assert look.movement == Traces(Since.ITERATION, Arrows.ALL, 1.1)
    assert (look.lines.shown, look.page.shading) == (False, False)
    assert data.features["cut"]["cuts"][0] == data.features["cut"]["cuts"][0] | {"style": "crinkle", "notch": True}


@pytest.mark.parametrize("version", [4, 5])
def test_what_is_read_of_it_is_written_anew(tmp_path, version):
    data = session_data.read(FILES / f"version_{version}.hexmend")
    assert data.features["tag"] == "7"
    session_data.write(tmp_path / "again.hexmend", data)
    again = session_data.read(tmp_path / "again.hexmend")
    assert again.features == data.features
    assert again.view == data.view
    assert VERSION > 5


def test_a_scene_of_version_0_1_is_read():
    scene = read_scene(FILES / "scene-0.1.toml")
    assert scene.cut.style is CutStyle.SMOOTH
    assert scene.cut.notch
    assert scene.cut.planes[0].position == 0.4
    assert (scene.colours.metric, scene.colours.map, scene.colours.range) == ("edge-ratio", "cividis", (1.0, 4.0))
    assert scene.structure.is_on("sharp")
    assert scene.structure.is_on("fixed")
    assert (scene.camera.from_, scene.page.size, scene.page.shading) == ("-y", (160, 120), False)


def test_a_picture_of_version_0_1_opens_its_mesh_as_it_shows_it(fresh_window, qtbot, tmp_path):
    window = fresh_window
    for name, copy in (("picture-0.1.png", "picture.png"), ("picture-0.1.vtu", "bridge.vtu")):
        shutil.copy(FILES / name, tmp_path / copy)
    open_and_wait(qtbot, window, tmp_path / "picture.png")
    window.refresh()
    look = window.session.view.look
    assert window.session.document.now.mesh.n_hexes == 108
    assert (look.colours.metric, look.colours.map, look.colours.range) == ("edge-ratio", "cividis", (1.0, 4.0))
    assert look.cut.notch
    assert (look.structure.is_on("sharp"), look.structure.is_on("fixed")) == (True, True)


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


@pytest.mark.parametrize("damage", [
    {"look": former_look(scale=3)},
    {"look": former_look(clip={"Sphere": {}})},
    {"look": former_look(isolation={"hexes": "all"})},
    {"look": former_look(structure={"sharp": 1})},
    {"look": former_look(dug=[-1])},
    {"look": []},
    {"dug": [10**9]},
])  # fmt: skip
def test_a_damaged_view_of_version_5_is_rejected(tmp_path, damage):
    version, content = read_archive(FILES / "version_5.hexmend", "Hexmend session", VERSION)
    content["window"]["view"] |= damage
    write_archive(tmp_path / "damaged.hexmend", "Hexmend session", version, content)
    with pytest.raises(FileError, match="inconsistent"):
        session_data.read(tmp_path / "damaged.hexmend")
