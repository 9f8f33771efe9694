"""Scripts read from a session what they cannot repeat, also after a restart."""

import subprocess
import sys

import pytest

from benchmarks.window.windows import save_and_wait
from hexmend import io
from hexmend.smoothers import METHODS
from hexmend_app.features.script.script import Script
from hexmend_app.picture import Scene
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.user_events import FileExported
from tests.app.features.script.recording import SHORT, opened, run, same_again, stage
from tests.patience import PATIENCE


@pytest.mark.slow
def test_an_opened_session_continues_with_its_undo_history(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    run(qtbot, session, stage("laplacian"))
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    opened(qtbot, session, kept)
    run(qtbot, session, stage("local-sd"))
    same_again(session, tmp_path)
    session.commands.undo()
    session.commands.undo()
    session.commands.tag("a", [4])
    assert "read_session(" in same_again(session, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["x\nraise SystemExit(3) #", "x\rraise SystemExit(3) #", "x\0"])
def test_the_name_of_a_run_cannot_end_a_comment(session, qtbot, tmp_path, name):
    session.script.scene = Scene
    run(qtbot, session, stage("laplacian"))
    session.history.records[0].name = name
    same_again(session, tmp_path)
    save_and_wait(session, tmp_path / "named.hexmend")
    opened(qtbot, session, tmp_path / "named.hexmend")
    assert session.history.records[0].name.isprintable()
    same_again(session, tmp_path)


@pytest.mark.slow
def test_restarted_after_a_run_it_continues_from_the_result(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    session.script.restart()
    run(qtbot, session, stage("laplacian"))
    same_again(session, tmp_path)
    session.script.restart()
    session.commands.undo()
    run(qtbot, session, stage("getme"))
    same_again(session, tmp_path)


def test_restarted_after_runs_from_one_start_it_continues_from_there(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    for method in ("local-sd", "laplacian"):
        run(qtbot, session, stage(method))
        session.commands.undo()
    session.commands.redo()
    session.script.restart()
    session.commands.tag("a", [4])
    assert session.script.text.count("hx.smooth(") == 0  # nobody has the mesh that the run began with
    assert "save it under this name first" in session.script.text


@pytest.mark.slow
def test_a_comparison_is_read_from_the_session(session, qtbot, tmp_path):
    session.comparison.start([METHODS["local-sd"](), METHODS["laplacian"]()], SHORT)
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    run(qtbot, session, stage("mend"))
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    opened(qtbot, session, kept)
    assert not session.opener.busy
    session.commands.adopt_positions("Laplacian", session.comparison.of("laplacian").state)
    assert "compare(" not in same_again(session, tmp_path).partition("kept.hexmend")[2]
    save_and_wait(session, kept)
    assert "overwritten" not in same_again(session, tmp_path).partition("kept.hexmend")[2]
    session.commands.adopt_positions("steepest descent", session.comparison.of("local-sd").state)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_an_overwritten_session_is_read_by_its_new_numbers(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    run(qtbot, session, stage("laplacian"))
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    opened(qtbot, session, kept)
    end = session.history.records[0].end
    session.commands.undo()
    session.commands.undo()
    run(qtbot, session, stage("mend"))
    save_and_wait(session, kept)
    session.commands.adopt_positions("back", end)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_snapshot_of_a_session_is_read_from_it(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    (record,) = session.history.records
    session.timeline.go(record, 2)
    session.snapshots.add("iteration 2", session.document.now)
    session.timeline.go(record, record.newest)
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    opened(qtbot, session, kept)
    session.script.restart()
    mesh = session.document.now.mesh.with_points(session.snapshots.all[0].points)
    session.commands.export(FileExported("mesh", io.write, (tmp_path / "snapshot.vtu", mesh)))
    assert ".snapshots[0].points" in same_again(session, tmp_path)


def test_entries_that_read_an_overwritten_file_are_marked(session, qtbot, path):
    run(qtbot, session, stage("laplacian"))
    assert "overwritten" not in session.script.text
    save_and_wait(session, path)
    save_and_wait(session, path)
    assert session.script.text.count("the file was overwritten since") == 1
    assert "overwritten" in session.script.entries[0]


def test_without_a_mesh_the_script_is_empty(qtbot, tmp_path):
    session = Session()
    script = tmp_path / "script.py"
    Script(session, session).write(script)
    subprocess.run([sys.executable, script], check=True)
    session.close()
