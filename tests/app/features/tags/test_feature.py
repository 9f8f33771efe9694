"""Tagging hexes in the window by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QInputDialog, QLabel

from hexmend import LocalSteepestDescent, StoppingCriteria, io
from hexmend_app.features.tags.feature import FeatureTags
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, named, press, type_text
from tests.app.hosting import action
from tests.core.grids import grid, scrambled


@pytest.fixture
def strip(window):
    window.action("tags").trigger()
    return window.features["tags"].strip


def about(strip):
    strip.window().refresh()
    return named(strip, QLabel, "About the tag").text()


def write_name(strip, name):
    type_text(strip.findChild(QComboBox).lineEdit(), name)


def seen(window):
    window.refresh()
    return [label.text() for label in window.features["hex_inspector"].panel.findChildren(QLabel)]


def tags(window):
    return {name: members.tolist() for name, members in window.session.document.now.mesh.hex_sets.items()}


def test_a_hex_is_tagged_and_untagged_by_key_undone_and_saved(window, tmp_path):
    strip = window.features["tags"].strip
    assert not strip.isVisible()
    key(window, Qt.Key.Key_T)
    assert tags(window) == {}
    assert strip.isVisible()
    key(window, Qt.Key.Key_N)
    first = window.session.selection.hex
    key(window, Qt.Key.Key_T)
    key(window, Qt.Key.Key_N)
    second = window.session.selection.hex
    key(window, Qt.Key.Key_T)
    assert tags(window) == {"tagged": sorted([first, second])}
    least = window.session.document.now.quality.q[[first, second]].min()
    assert about(strip) == f"2 hexes, 2 inverted, q min {least:.4f}"
    key(window, Qt.Key.Key_T)
    assert tags(window) == {"tagged": [first]}
    assert f"Hex {second}" in seen(window)
    window.session.commands.undo()
    assert tags(window) == {"tagged": sorted([first, second])}
    assert f"Hex {second}: tagged" in seen(window)
    assert window.session.document.redo_title == "untag"
    assert window.features["save"].save_and_wait(tmp_path / "tagged.vtk")
    kept = io.read(tmp_path / "tagged.vtk")
    assert kept.hex_sets["tagged"].tolist() == sorted([first, second])


@pytest.mark.slow
def test_shown_or_listed_hexes_are_tagged_and_isolated(window, strip):
    write_name(strip, "bad ones")
    window.session.view.change(show={"peel": 2})
    press(strip.shown_button)
    layers = window.session.document.now.mesh.topology.layers
    assert tags(window) == {"bad ones": np.flatnonzero(layers >= 2).tolist()}
    write_name(strip, "worst")
    press(strip.listed_button)
    assert tags(window)["worst"] == sorted(window.features["hex_inspector"].worst_list.hexes.tolist())
    press(strip.isolate_button)
    assert sorted(window.session.view.look.show.isolate.hexes) == tags(window)["worst"]
    press(strip.remove_button)
    assert list(tags(window)) == ["bad ones"]


def test_a_tag_is_renamed_unless_the_name_exists(window, strip, monkeypatch):
    window.session.commands.tag("one", [1, 2])
    window.session.commands.tag("two", [3])
    strip.set_name("one")
    for name in ("two", "three"):
        monkeypatch.setattr(QInputDialog, "getText", lambda *_, name=name: (name, True))
        press(strip.rename_button)
    assert tags(window) == {"three": [1, 2], "two": [3]}
    assert strip.name == "three"


# The strip and the shortcut tell why a hex cannot be tagged.


@pytest.fixture
def host(hosted):
    return hosted(scrambled(grid(4), 0.3))


@pytest.mark.parametrize(("name", "word"), [("bad", "No hex selected"), (" ", "Enter a tag name")])
def test_a_refused_tag_has_a_reason(host, name, word):
    feature = FeatureTags(host)
    feature.strip.set_name(name)
    feature.refresh()
    action(feature, "tag").handle()
    assert word in " ".join(host.messages.messages()[-1])
    assert word in named(feature.strip, QLabel, "About the tag").text()


def test_the_shortcut_reports_that_a_run_is_paused(host, qtbot):
    feature = FeatureTags(host)
    tag = action(feature, "tag")
    smoothing = host.session.run
    host.session.selection.choose(5)
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0), 1)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)
    feature.refresh()
    assert tag.enabled()
    tag.handle()
    assert "during a run" in " ".join(host.messages.messages()[-1])
    assert host.session.document.now.mesh.hex_sets == {}
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
    feature.refresh()
    tag.handle()
    assert host.session.document.now.mesh.hex_sets["tagged"].tolist() == [5]
