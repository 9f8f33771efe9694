"""The doctor in the window: findings with their locations, repairs and undo."""

import re

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.mesh.document import MeasuredMesh
from tests.app.driving import texts


def unmerged():
    """Return two unmerged blocks, one of them mirrored."""
    block = make("cube", size=27)
    points = block.points + [np.ptp(block.points[:, 0]), 0, 0]
    mirrored = block.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]]
    return Mesh(np.vstack([block.points, points]), np.vstack([block.hexes, mirrored + block.n_nodes]), name="blocks")


@pytest.fixture
def panel(window, qtbot):
    window.session.document.replace(MeasuredMesh.of(unmerged()), None)
    window.show_panel("doctor")
    panel = window.features["doctor"].panel
    qtbot.waitUntil(panel.isVisible)
    window.refresh()
    qtbot.waitUntil(lambda: len(repairs(panel)) == 2)
    return panel


def repairs(panel):
    """Return the links that repair."""
    return re.findall('<a href="(repair [^"]*)"', panel.text.text())


def test_findings_are_listed_with_their_locations(window, panel):
    shown = " ".join(texts(panel))
    assert all(text in shown for text in ("Left-handed hexes", "blocks that are not merged", "Hexes 27, 28, 29"))


def repair(qtbot, session, panel):
    """Follow the first link that repairs, and wait until the mesh is repaired."""
    with qtbot.waitSignal(session.repairer.ended):
        panel.text.linkActivated.emit(repairs(panel)[0])


@pytest.mark.slow
def test_each_finding_is_repaired_by_a_click_and_undone(window, panel, qtbot):
    session = window.session
    before = session.document.now.mesh
    repair(qtbot, session, panel)
    assert session.document.now.summary.inverted == 0
    assert session.document.undo_title == "repair left-handed hexes"
    qtbot.waitUntil(lambda: len(repairs(panel)) == 1)
    repair(qtbot, session, panel)
    assert session.document.now.mesh.n_nodes == 2 * 64 - 16
    session.commands.undo()
    session.commands.undo()
    assert session.document.now.mesh is before
    session.commands.redo()
    assert session.document.now.summary.inverted == 0


@pytest.mark.slow
def test_changes_on_reading_are_remembered(window, panel):
    mesh = unmerged().replace(notes=("8 hexes were renumbered.",))
    window.session.document.replace(MeasuredMesh.of(mesh), None)
    window.refresh()
    assert "Changed on reading: 8 hexes were renumbered." in " ".join(texts(panel))
    window.session.document.replace(MeasuredMesh.of(unmerged()), None)
    window.refresh()
    assert "Changed on reading" not in " ".join(texts(panel))


def test_inverted_hexes_are_named_with_what_helps(window, panel):
    assert "27 hexes are inverted: " in panel.text.text()
    panel.text.linkActivated.emit("smooth")
    assert window.is_visible("run")
    window.session.document.replace(MeasuredMesh.of(make("cube", size=27)), None)
    window.refresh()
    assert "inverted" not in panel.text.text()
