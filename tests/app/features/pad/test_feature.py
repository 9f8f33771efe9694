"""Padding in the window: the dialog, the layer, undo, cancelling, and errors."""

import numpy as np
import pytest

from hexmend.mesh.mesh import Mesh
from hexmend_app.features.pad.feature import PadDialog
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.tasks.mesh_change import PaddingChoice
from tests.core.grids import grid


def dented():
    """Return a block of which a corner is pushed through the plane of its neighbours."""
    mesh = grid(3)
    points = mesh.points.copy()
    points[0] = [0.9, 0.9, 0.9]
    sides = {"bottom": np.array([[h, 4] for h in range(9)])}
    return Mesh(points, mesh.hexes, name="dented", side_sets=sides, pinned=np.arange(64) == 21)


@pytest.fixture
def session(window):
    window.session.document.replace(MeasuredMesh.of(dented()), None)
    return window.session


def pad(qtbot, session, choice):
    with qtbot.waitSignal(session.padder.ended):
        session.commands.pad(choice)
    return session.document.now


@pytest.mark.parametrize("choice", [PaddingChoice(), PaddingChoice(around="locked", thickness=0.2)])
def test_the_mesh_is_padded_and_undone(window, session, qtbot, choice):
    before = session.document.now
    assert before.summary.locked_inverted == 1
    now = pad(qtbot, session, choice)
    assert now.summary.inverted == 0
    assert session.document.undo_title == "pad"
    assert window.messages.title == "1 → 0 inverted"
    assert "The layer has" in window.messages.text
    np.testing.assert_array_equal(
        now.mesh.points[: before.mesh.n_nodes][before.mesh.fixed], before.mesh.points[before.mesh.fixed]
    )
    session.commands.undo()
    assert session.document.now is before
    session.commands.redo()
    assert session.document.now is now


@pytest.mark.slow
def test_a_layer_that_cannot_be_closed_is_reported(window, session, qtbot):
    mesh = session.document.now.mesh.replace(side_sets={"one": np.array([[4, 4]])})
    session.document.replace(MeasuredMesh.of(mesh), None)
    before = session.document.now
    with qtbot.waitSignal(session.padder.failed):
        session.commands.pad(PaddingChoice("one"))
    assert session.document.now is before
    assert "cannot be closed" in window.messages.text


@pytest.mark.slow
def test_a_cancelled_layer_leaves_the_mesh(window, session, qtbot):
    before = session.document.now
    session.commands.pad(PaddingChoice())
    assert not session.editable
    session.padder.cancel()
    assert session.editable
    assert session.document.now is before
    assert not session.padder.busy


@pytest.mark.slow
def test_the_dialog_offers_what_the_mesh_has(window, session, qtbot, monkeypatch):
    mesh = session.document.now.mesh
    dialog = PadDialog(mesh, 1, 1)
    qtbot.addWidget(dialog)
    where = dialog.form.editors["where"]
    choices = []
    for at in range(where.count()):
        where.setCurrentIndex(at)
        choices.append(dialog.choice())
    assert choices == [
        PaddingChoice(*of) for of in ((None, None), (None, "locked"), (None, "inverted"), ("bottom", None))
    ]
    dialog.form.set_values({"rings": 2, "thickness": 0.25})
    assert dialog.choice() == PaddingChoice("bottom", None, 2, 0.25)
    monkeypatch.setattr(PadDialog, "exec", lambda dialog: False)
    window.action("pad").trigger()
    assert not session.padder.busy
    monkeypatch.setattr(PadDialog, "exec", lambda dialog: dialog.form.editors["where"].setCurrentIndex(1) or True)
    with qtbot.waitSignal(session.padder.ended) as ended:
        window.action("pad").trigger()
    assert len(ended.args[0].layer) < 54
