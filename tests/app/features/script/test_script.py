"""What is done to a mesh is done again by the script, by Python alone and to the bit."""

import os
import subprocess
import sys

import numpy as np
import pytest

from hexmend import io
from hexmend.doctor import examine
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.bench.windows import save_and_wait
from hexmend_app.features.script.script import Script
from hexmend_app.state.run import Phase
from hexmend_app.state.scene import Scene
from hexmend_app.state.session import Session
from tests.patience import PATIENCE

SHORT = StoppingCriteria(max_iterations=6, tolerance=0)
ENDLESS = StoppingCriteria(max_iterations=100_000, tolerance=0)


def stage(method, stop=SHORT, **values):
    return Stage(METHODS[method](**values), stop)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "it's a bridge.vtu"
    io.write(path, make("bridge-sharp", size=1000, scramble=0.4, seed=1))
    return path


@pytest.fixture
def session(qtbot, path):
    session = Session()
    session.script = Script(session, session)
    opened(qtbot, session, path)
    yield session
    session.shut_down()


def opened(qtbot, session, path):
    with qtbot.waitSignal(session.opener.ended, timeout=PATIENCE):
        session.commands.open(path)


def run(qtbot, session, what):
    with qtbot.waitSignal(session.smoothing.ended, timeout=PATIENCE):
        if isinstance(what, Recipe):
            session.commands.run_recipe(what)
        else:
            session.commands.run(what)


def paused(qtbot, session, what, iterations):
    session.commands.step(what, iterations)
    held = session.smoothing
    qtbot.waitUntil(lambda: held.phase is Phase.PAUSED and held.record.newest >= iterations, timeout=PATIENCE)


def stop(qtbot, session):
    with qtbot.waitSignal(session.smoothing.ended, timeout=PATIENCE):
        session.smoothing.stop()


def same_again(session, tmp_path):
    """Save the mesh, let the script do everything again, and compare what it has saved."""
    out, script = tmp_path / "out.vtu", tmp_path / "script.py"
    save_and_wait(session, out)
    before = io.read(out)
    out.unlink()
    session.script.write(script)
    env = os.environ | {"PYTHONWARNINGS": "error"}
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, env=env, cwd=tmp_path)
    assert done.returncode == 0, f"{done.stderr}\n{session.script.text}"
    assert done.stdout == ""
    after = io.read(out)
    assert np.array_equal(before.points, after.points), session.script.text
    assert np.array_equal(before.hexes, after.hexes)
    assert np.array_equal(before.pinned, after.pinned)
    assert {k: v.tolist() for k, v in before.hex_sets.items()} == {k: v.tolist() for k, v in after.hex_sets.items()}
    return session.script.text


def test_a_run_is_one_line(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    text = same_again(session, tmp_path)
    assert (
        "mesh_1 = hx.smooth(mesh_0, hx.LocalSteepestDescent(), hx.StoppingCriteria(max_iterations=6, tolerance=0.0)).mesh"
        in text
    )
    assert "hx.write(" in text


def test_what_was_pinned_tagged_undone_and_reset_is_so_again(session, qtbot, tmp_path):
    commands = session.commands
    commands.pin(np.arange(40, 400), True)
    commands.pin(50, False)
    run(qtbot, session, stage("getme", relaxation=0.75))
    commands.undo()
    commands.redo()
    commands.undo()
    run(qtbot, session, stage("laplacian"))
    commands.tag('a "name"', [1, 2, 3, 7])
    commands.tag("other", [5, 9])
    commands.tag("other", [9], on=False)
    commands.rename_tag("other", "{mesh}")
    commands.tag("gone", range(3, 90))
    commands.remove_tag("gone")
    before = session.document.now.mesh.points
    commands.reset()
    assert not np.array_equal(session.document.now.mesh.points, before)
    commands.free_only(range(100), 1)
    run(qtbot, session, stage("local-sd"))
    text = same_again(session, tmp_path)
    assert text.count("# Undo GETMe") == 2
    assert "np.r_[40:400]" in text


def test_a_run_that_was_stopped_ends_where_it_did(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 4)
    stop(qtbot, session)
    assert "watch=lambda it: it.number < 4" in same_again(session, tmp_path)


def test_a_run_that_was_changed_on_the_way_is_changed_again(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 3)
    session.smoothing.change(stage("laplacian", ENDLESS))
    paused(qtbot, session, None, 2)
    session.smoothing.change(stage("laplacian", StoppingCriteria(max_iterations=9, tolerance=0)))
    with qtbot.waitSignal(session.smoothing.ended, timeout=PATIENCE):
        session.smoothing.resume()
    text = same_again(session, tmp_path)
    assert text.count("run.switch_method(hx.Laplacian()") == 2


@pytest.mark.slow
def test_what_ended_by_the_clock_has_a_limit_of_iterations(session, qtbot, tmp_path):
    timed = StoppingCriteria(max_iterations=100_000, tolerance=0, max_seconds=0.05)
    run(qtbot, session, Recipe.of(stage("local-sd", timed), stage("laplacian")))
    run(qtbot, session, stage("local-sd", timed))
    assert "max_seconds" not in same_again(session, tmp_path)


def test_a_mesh_that_is_saved_in_a_pause_is_that_of_the_iteration(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 4)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_an_iteration_that_was_gone_back_to_is_where_a_branch_begins(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    session.commands.pin(3, True)
    session.timeline.go(session.timeline.record, 2)
    session.commands.branch(stage("laplacian"))
    qtbot.waitUntil(lambda: not session.smoothing.busy, timeout=PATIENCE)
    assert 'astype("f4")' in same_again(session, tmp_path)
    session.timeline.go(session.history.records[0], 0)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_sweep_node_by_node_is_made_again(session, tmp_path):
    smoother = METHODS["local-sd"]()
    session.stepping.advance(smoother, 12)
    session.stepping.finish(smoother)
    session.stepping.advance(smoother, 5)
    text = same_again(session, tmp_path)
    assert text.count("sweep = Sweep(") == 2


@pytest.mark.slow
def test_what_the_doctor_mends_is_mended_again(session, qtbot, tmp_path):
    one = make("cube", size=27)
    other = one.points + [np.ptp(one.points[:, 0]), 0, 0]
    turned = one.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]]
    path = tmp_path / "blocks.vtu"
    io.write(path, Mesh(np.vstack([one.points, other]), np.vstack([one.hexes, turned + one.n_nodes])))
    opened(qtbot, session, path)
    first, *_ = (one for one in examine(session.document.now.mesh) if one.mendable)
    for kinds in ([first.kind], ()):
        with qtbot.waitSignal(session.repairer.ended, timeout=PATIENCE):
            assert session.commands.repair(kinds)
    session.commands.pin(5, True)
    text = same_again(session, tmp_path)
    assert f"repair(mesh_1, ('{first.kind}',))[0].keeping_surface()" in text


@pytest.mark.slow
def test_a_method_that_was_compared_and_taken_is_run_again(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    session.comparison.start([METHODS["laplacian"](), METHODS["getme"](relaxation=0.75)], SHORT)
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    session.commands.take("GETMe", session.comparison.of("getme").state)
    same_again(session, tmp_path)
    session.commands.take("back", session.comparison.initial)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_session_that_is_opened_is_gone_on_from_with_its_way_back(session, qtbot, tmp_path):
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
def test_what_a_session_calls_a_run_ends_no_comment(session, qtbot, tmp_path, name):
    session.script.scene = Scene
    run(qtbot, session, stage("laplacian"))
    session.history.records[0].name = name
    same_again(session, tmp_path)
    save_and_wait(session, tmp_path / "named.hexmend")
    opened(qtbot, session, tmp_path / "named.hexmend")
    assert session.history.records[0].name.isprintable()
    same_again(session, tmp_path)


@pytest.mark.slow
def test_begun_anew_after_a_run_it_goes_on_from_what_the_run_made(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    session.script.begin_anew()
    run(qtbot, session, stage("laplacian"))
    same_again(session, tmp_path)
    session.script.begin_anew()
    session.commands.undo()
    run(qtbot, session, stage("getme"))
    same_again(session, tmp_path)


def test_begun_anew_after_runs_from_one_start_it_goes_on_from_there(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    for method in ("local-sd", "laplacian"):
        run(qtbot, session, stage(method))
        session.commands.undo()
    session.commands.redo()
    session.script.begin_anew()
    session.commands.tag("a", [4])
    assert session.script.text.count("hx.smooth(") == 0  # nobody has the mesh that the run began with
    assert "save it under this name first" in session.script.text


@pytest.mark.slow
def test_a_comparison_that_a_session_holds_is_read_from_it(session, qtbot, tmp_path):
    session.comparison.start([METHODS["local-sd"](), METHODS["laplacian"]()], SHORT)
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    run(qtbot, session, stage("mend"))
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    opened(qtbot, session, kept)
    assert not session.opener.busy
    session.commands.take("Laplacian", session.comparison.of("laplacian").state)
    assert "compare(" not in same_again(session, tmp_path).partition("kept.hexmend")[2]
    save_and_wait(session, kept)
    assert "overwritten" not in same_again(session, tmp_path).partition("kept.hexmend")[2]
    session.commands.take("steepest descent", session.comparison.of("local-sd").state)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_session_that_is_saved_over_is_read_by_its_new_numbers(session, qtbot, tmp_path):
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
    session.commands.take("back", end)
    same_again(session, tmp_path)


def test_what_reads_a_file_that_was_saved_over_says_so(session, qtbot, path):
    run(qtbot, session, stage("laplacian"))
    assert "overwritten" not in session.script.text
    save_and_wait(session, path)
    save_and_wait(session, path)
    assert session.script.text.count("the file was overwritten since") == 1
    assert "overwritten" in session.script.entries[0]


def test_without_a_mesh_there_is_nothing_to_do(qtbot, tmp_path):
    session = Session()
    script = tmp_path / "script.py"
    Script(session, session).write(script)
    subprocess.run([sys.executable, script], check=True)
    session.shut_down()
