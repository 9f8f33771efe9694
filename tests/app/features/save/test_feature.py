"""Meshes and pictures saved from the window."""

import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QPushButton

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


@pytest.fixture
def chosen(monkeypatch):
    """Answer of the dialog for a file to save to; its other arguments are recorded."""
    answer = SimpleNamespace(path="", asked=[])
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: answer.asked.append(given) or (answer.path, ""))
    return answer


@pytest.mark.slow
def test_a_session_is_saved_in_place_and_its_mesh_in_any_format(window, qtbot, tmp_path, chosen):
    session = window.session
    assert window.features["save"].save_and_wait(tmp_path / "work.hexmend")
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    session.commands.pin(0, True)
    window.refresh()
    with qtbot.waitSignal(session.saver.ended):
        window.action("save").trigger()
    assert not chosen.asked
    assert not session.document.modified
    chosen.path = str(tmp_path / "out.vtk")
    window.refresh()
    with qtbot.waitSignal(session.saver.ended):
        window.action("save_as").trigger()
    assert all(f"(*{suffix})" in chosen.asked[0][3] for suffix in io.writable_suffixes())
    np.testing.assert_array_equal(io.read(chosen.path).points, session.document.now.mesh.points)


def test_the_file_chosen_first_is_saved_in_place_and_recent(window, qtbot, tmp_path, chosen):
    chosen.path = str(tmp_path / "out.vtu")
    for pinned in (False, True):
        window.session.commands.pin(0, pinned)
        with qtbot.waitSignal(window.session.saver.ended):
            key(window, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
        assert len(chosen.asked) == 1
        assert not window.session.document.modified
    assert window.features["open"].recent.files()[0] == tmp_path / "out.vtu"
    assert {"Open", "Show folder"} <= {one.text() for one in window.messages.findChildren(QPushButton)}
    open_and_wait(qtbot, window, tmp_path / "out.vtu")
    with qtbot.waitSignal(window.session.saver.ended):
        window.action("save").trigger()
    assert len(chosen.asked) == 2  # a file that was opened is not replaced unasked


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
def test_replacing_a_file_asks_once_whether_to_write_it_anew(deck, qtbot, monkeypatch, chosen, button, kept):
    feature, path = deck
    out, said = path.with_name("out.inp"), []
    chosen.path = str(out)
    out.write_text("another")

    def answer(box):
        said.append(box.informativeText())
        next(one for one in box.buttons() if one.text().replace("&", "") == button).click()

    monkeypatch.setattr(QMessageBox, "exec", answer)
    feature.save()
    qtbot.waitUntil(lambda: not feature.session.saver.busy)
    assert chosen.asked[0][2].endswith("mesh-smoothed.inp")
    assert "are lost" in said[0]
    assert (out.read_text() == "another") is (kept is None)
    if kept is not None:
        feature.save()
        qtbot.waitUntil(lambda: not feature.session.saver.busy)
        assert len(said) == 1
        assert ("a comment" in out.read_text()) is kept


@pytest.mark.parametrize("name", ["out.vtu", "out.inp"])
def test_a_new_file_is_written_unasked_and_keeps_what_it_can(deck, qtbot, monkeypatch, chosen, name):
    feature, path = deck
    chosen.path = str(path.with_name(name))
    monkeypatch.setattr(QMessageBox, "exec", lambda box: pytest.fail(box.text()))
    feature.ask_mesh()
    qtbot.waitUntil(lambda: not feature.session.saver.busy)
    assert (b"a comment" in path.with_name(name).read_bytes()) is name.endswith(".inp")


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
def test_the_visible_hexes_are_saved_as_a_mesh(window, qtbot, tmp_path, chosen, style):
    mesh = window.session.document.now.mesh
    window.session.commands.tag("some", [3, 5, 8])
    centres = mesh.points[mesh.hexes].mean(axis=1)
    middle = centres.mean(axis=0)
    window.session.view.set_cut(Cut.at((1, 0, 0), tuple(middle.tolist()), style))
    window.session.view.dig(int(centres[:, 0].argmin()))
    window.refresh()
    out = tmp_path / "out.vtu"
    chosen.path = str(out)
    window.action("save_visible").trigger()
    qtbot.waitUntil(lambda: not window.session.saver.busy)
    assert chosen.asked[0][2].endswith("-visible.vtu")
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
