"""The script of the changes of a mesh runs without the window and makes the same mesh."""

import re

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QFileDialog, QPlainTextEdit, QPushButton

from hexmend import METHODS, Mesh, MotionRules, Recipe, Stage, StoppingCriteria, io
from hexmend.gallery import make
from hexmend_app.features.reproduce.script import script_of
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.session import Session
from hexmend_app.state.tasks.mesh_change import PaddingChoice
from tests.app.driving import brought, named, press, run_to_end
from tests.programs import run_python

SHORT = StoppingCriteria(max_iterations=6, tolerance=0)
ENDLESS = StoppingCriteria(max_iterations=100_000, tolerance=0, keep_last=True)


def stage(method, stop=SHORT, **values):
    return Stage(METHODS[method](**values), stop)


@pytest.fixture
def path(tmp_path):
    """File of two bridges, the second inside out: the doctor can repair it."""
    mesh = make("bridge-sharp", size=100, scramble=0.3, seed=1)
    turned = mesh.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]] + mesh.n_nodes
    points = np.vstack([mesh.points, mesh.points + [2 * np.ptp(mesh.points[:, 0]), 0, 0]])
    path = tmp_path / "it's two bridges.vtu"
    io.write(path, Mesh(points, np.vstack([mesh.hexes, turned])))
    return path


@pytest.fixture
def session(qtbot, path):
    session = Session()
    open_file(qtbot, session, path)
    yield session
    session.close()


def open_file(qtbot, session, path):
    with qtbot.waitSignal(session.opener.ended):
        session.commands.open(path)


def save(qtbot, session, path):
    with qtbot.waitSignal(session.saver.ended):
        session.commands.save_in_background(path)


def run(qtbot, session, work):
    with qtbot.waitSignal(session.run.ended):
        (session.commands.run_recipe if isinstance(work, Recipe) else session.commands.run)(work)


def pause(qtbot, session, work, iterations):
    session.commands.step(work, iterations)
    qtbot.waitUntil(lambda: session.run.phase is Phase.PAUSED)


def executed(qtbot, session, tmp_path):
    """Save the mesh, run the script, compare the meshes, and return the script."""
    out, script = tmp_path / "out.vtu", tmp_path / "script.py"
    save(qtbot, session, out)
    out.unlink()
    text = script_of(session)
    script.write_text(text)
    done = run_python("-W", "error", script)
    assert done.returncode == 0, f"{done.stderr}\n{text}"
    made, mesh = io.read(out), session.document.now.mesh
    np.testing.assert_allclose(made.points, mesh.points, atol=1e-6)
    np.testing.assert_array_equal(made.hexes, mesh.hexes)
    np.testing.assert_array_equal(made.pinned, mesh.pinned)
    assert {name: set(hexes) for name, hexes in made.hex_sets.items()} == {
        name: set(hexes) for name, hexes in mesh.hex_sets.items()
    }
    return text


def test_edits_and_runs_are_repeated(session, qtbot, tmp_path):
    commands = session.commands
    with qtbot.waitSignal(session.repairer.ended):
        commands.repair()
    commands.tag("ends", [0, 1, *range(20, 60)])
    commands.free_only([3, 4], 2)
    commands.pin(np.array([5, 6]), True)
    run(qtbot, session, stage("laplacian", boundary="slide"))
    commands.mark_curve([0, 1])
    run(qtbot, session, Recipe.of(stage("local-sd"), stage("mend"), rules=MotionRules(interfaces="slide")))
    commands.undo()
    pause(qtbot, session, stage("local-sd", ENDLESS), 3)
    session.run.change(stage("laplacian", ENDLESS))
    session.run.step(2)
    qtbot.waitUntil(lambda: session.run.record.newest == 5)
    with qtbot.waitSignal(session.run.ended):
        session.run.stop()
    text = executed(qtbot, session, tmp_path)
    assert [text.count(call) for call in ("hx.smooth(", "hx.Recipe.of(", "hx.read(")] == [2, 1, 1]


def test_a_layer_is_laid_again(session, qtbot, tmp_path):
    with qtbot.waitSignal(session.padder.ended):
        session.commands.pad(PaddingChoice())
    assert "hx.pad(mesh_0, " in executed(qtbot, session, tmp_path)


def test_a_branch_starts_from_an_iteration(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    session.timeline.go(session.timeline.record, 2)
    session.commands.pin(7, True)
    run(qtbot, session, stage("laplacian", StoppingCriteria(max_iterations=1, keep_last=True)))
    session.timeline.go(session.history.records[0], 4)
    assert "max_iterations=2, tolerance=0.0, keep_last=True" in executed(qtbot, session, tmp_path)


def test_a_compared_result_and_a_reset(session, qtbot, tmp_path):
    compared = session.comparison
    compared.start([stage("laplacian").smoother], SHORT, MotionRules())
    qtbot.waitUntil(lambda: not compared.busy)
    session.commands.pin(7, True)
    session.commands.adopt_positions("take Laplacian", compared.results[0].state)
    executed(qtbot, session, tmp_path)
    session.commands.reset()
    assert "# Reset\nmesh_3 = mesh_2.with_points(mesh_0.points)\n" in executed(qtbot, session, tmp_path)


def test_the_journal_is_in_a_session_file(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    run(qtbot, session, stage("local-sd"))
    save(qtbot, session, tmp_path / "work.hexmend")
    open_file(qtbot, session, tmp_path / "work.hexmend")
    run(qtbot, session, stage("laplacian", StoppingCriteria(max_iterations=1, keep_last=True)))
    text = executed(qtbot, session, tmp_path)
    assert [text.count(call) for call in ("two bridges", "hx.fix(", "hx.smooth(")] == [1, 1, 2]


def test_a_mesh_in_no_file_has_to_be_saved_first(session):
    session.document.replace(MeasuredMesh.of(make("cube", size=8)), None)
    assert re.search(r"mesh_0 = hx.read\(.*cube-8.vtu.*  # Save the mesh", script_of(session))


def test_without_a_mesh_the_script_does_nothing(qtbot):
    session = Session()
    exec(script_of(session), {})
    session.close()


# The script in the window: shown, copied and saved.


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "reproduce")


def test_the_script_is_shown_copied_and_saved(window, panel, qtbot, tmp_path, monkeypatch):
    run_to_end(window, qtbot, "local-sd", max_iterations=2, tolerance=0)
    text = named(panel, QPlainTextEdit, "Script").toPlainText()
    assert "mesh_1 = hx.smooth(mesh_0, hx.LocalSteepestDescent(), " in text
    assert "[camera]" in text
    press(named(panel, QPushButton, "Copy the script"))
    assert QApplication.clipboard().text().startswith(text.partition("# Current view")[0])
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *asked: (str(tmp_path / "again"), "Python script (*.py)")
    )
    press(named(panel, QPushButton, "Save the script"))
    assert "hx.smooth(" in (tmp_path / "again.py").read_text()
    assert not window.features["reproduce"].save(tmp_path / "nowhere" / "script.py")
