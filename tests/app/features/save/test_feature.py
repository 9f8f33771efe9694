"""Meshes and pictures saved from the window."""

import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox

from benchmarks.window.windows import save_and_wait
from hexmend import io
from hexmend.gallery import make
from hexmend_app.features.save.feature import FeatureSave
from hexmend_app.picture import Cut, CutStyle, Page, write_scene
from hexmend_app.picture.appearance import Structure
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, open_and_wait, phase


def test_saving_writes_the_displayed_mesh(window, qtbot, tmp_path):
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    window.session.run.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    window.refresh()
    assert window.isWindowModified()
    assert window.features["save"].save_and_wait(tmp_path / "out.vtk")
    np.testing.assert_array_equal(io.read(tmp_path / "out.vtk").points, window.session.document.now.mesh.points)
    window.refresh()
    assert not window.isWindowModified()
    assert not window.features["save"].save_and_wait(tmp_path / "missing" / "out.vtk")
    assert window.messages.messages()[-1][0] == "error"


@pytest.mark.slow
def test_a_mesh_is_saved_in_any_format_after_a_session_was_opened(window, qtbot, tmp_path, monkeypatch):
    assert window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    offered = []
    out = str(tmp_path / "out.vtk")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: offered.append(given[3]) or (out, ""))
    with qtbot.waitSignal(window.session.saver.ended):
        window.action("save").trigger()
    assert all(f"(*{suffix})" in offered[0] for suffix in io.writable_suffixes())
    np.testing.assert_array_equal(io.read(out).points, window.session.document.now.mesh.points)


@pytest.fixture
def deck(qtbot, hosted, tmp_path):
    """Feature of a host with an open Abaqus deck that has a comment, and its file."""
    path = tmp_path / "deck.inp"
    io.write(path, make("cube", size=27, scramble=0.2))
    path.write_text(f"{path.read_text()}** a comment\n")
    host = hosted(make("cube", size=8))
    feature = FeatureSave(host)
    with qtbot.waitSignal(host.session.opener.ended):
        host.session.commands.open(path)
    return feature, path


@pytest.mark.parametrize(("button", "kept"), [("Replace coordinates", True), ("Rewrite file", False), ("Cancel", None)])
def test_saving_in_the_format_of_the_file_asks_whether_to_write_it_anew(deck, qtbot, monkeypatch, button, kept):
    feature, path = deck
    out, said, proposed = path.with_name("out.inp"), [], []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: proposed.append(given[2]) or (str(out), ""))

    def answer(box):
        said.append(box.informativeText())
        next(one for one in box.buttons() if one.text().replace("&", "") == button).click()

    monkeypatch.setattr(QMessageBox, "exec", answer)
    feature.ask_mesh()
    qtbot.waitUntil(lambda: not feature.session.saver.busy)
    assert proposed[0].endswith("mesh-smoothed.inp")
    assert "are lost" in said[0]
    assert out.exists() is (kept is not None)
    if kept is not None:
        assert ("a comment" in out.read_text()) is kept


def test_saving_in_another_format_asks_nothing(deck, qtbot, monkeypatch):
    feature, path = deck
    out = path.with_name("out.vtu")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: (str(out), ""))
    monkeypatch.setattr(QMessageBox, "exec", lambda box: pytest.fail(box.text()))
    feature.ask_mesh()
    qtbot.waitUntil(lambda: not feature.session.saver.busy)
    assert out.exists()


@pytest.mark.slow
def test_the_same_scene_is_the_same_picture_without_a_window(window, tmp_path):
    session = window.session
    window.action("cut").trigger()
    session.view.change(structure=Structure.of("sharp"), show={"shrink": 0.1})
    session.side_views.show("as it was", session.document.now)
    session.side_views.set_wiping(True)
    window.refresh()
    window.canvas.roll(10)
    save_and_wait(session, tmp_path / "mesh.vtu")
    scene = window.canvas.scene(Page(85, 60, dpi=200, background="#20262e"))
    write_scene(tmp_path / "scene.toml", scene)
    assert window.features["export"].write_picture(tmp_path / "here.png", scene)
    meshes = [str(tmp_path / "mesh.vtu")] * 2
    words = ["render", *meshes, "--scene", str(tmp_path / "scene.toml"), "-o", str(tmp_path / "there.png")]
    bare = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-m", "hexmend", *words], env=bare, check=True, capture_output=True)
    here, there = (np.asarray(Image.open(tmp_path / name)).astype(int) for name in ("here.png", "there.png"))
    assert here.shape == there.shape == (*scene.page.size[::-1], 3)
    assert np.abs(here - there).mean() < 0.5
    assert (np.ptp(here, axis=2) > 60).mean() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("style", [CutStyle.CRINKLE, CutStyle.SMOOTH])
def test_the_visible_hexes_are_saved_as_a_mesh(window, qtbot, tmp_path, monkeypatch, style):
    mesh = window.session.document.now.mesh
    window.session.commands.tag("some", [3, 5, 8])
    centres = mesh.points[mesh.hexes].mean(axis=1)
    middle = centres.mean(axis=0)
    window.session.view.set_cut(Cut.at((1, 0, 0), tuple(middle.tolist()), style))
    window.session.view.dig(int(centres[:, 0].argmin()))
    window.refresh()
    out, said = tmp_path / "out.vtu", []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: said.append(given[2]) or (str(out), ""))
    window.action("save_visible").trigger()
    qtbot.waitUntil(lambda: not window.session.saver.busy)
    assert said[0].endswith("-visible.vtu")
    corners = mesh.points[mesh.hexes][:, :, 0]
    shown = centres[:, 0] <= middle[0] if style is CutStyle.CRINKLE else corners.min(axis=1) < middle[0]
    shown[centres[:, 0].argmin()] = False
    part = io.read(out)
    np.testing.assert_allclose(part.points[part.hexes], mesh.points[mesh.hexes[shown]])
    assert set(part.hex_sets["some"]) == set((np.cumsum(shown) - 1)[[h for h in (3, 5, 8) if shown[h]]])
    assert window.session.modified  # the tag: the mesh itself is not saved


@pytest.mark.slow
@pytest.mark.parametrize(("tagged", "warned"), [((0,), True), ((1,), False)], ids=["in the part", "elsewhere"])
def test_only_data_of_the_visible_hexes_is_missed(window, qtbot, tmp_path, tagged, warned):
    window.session.commands.tag("far", tagged)
    window.session.view.dig(1)  # hides it
    window.refresh()
    window.features["save"].save_visible(tmp_path / "out.su2")
    qtbot.waitUntil(lambda: not window.session.saver.busy)
    missed = " ".join(text for _, title, text in window.messages.messages() if title == "Some data was not saved")
    assert ("element sets (far)" in missed) is warned
