"""The script repeats changes of a mesh bit for bit."""

import numpy as np
import pytest

from benchmarks.window.windows import save_and_wait
from hexmend import io
from hexmend.doctor import examine
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import METHODS
from tests.app.features.script.recording import ENDLESS, SHORT, opened, paused, run, same_again, stage, stop
from tests.patience import PATIENCE


def test_a_run_is_one_line(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    text = same_again(session, tmp_path)
    assert (
        "mesh_1 = hx.smooth(mesh_0, hx.LocalSteepestDescent(), hx.StoppingCriteria(max_iterations=6, tolerance=0.0)).mesh"
        in text
    )
    assert "hx.write(" in text


def test_pins_tags_undo_and_reset_are_repeated(session, qtbot, tmp_path):
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


def test_a_stopped_run_ends_at_the_same_iteration(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 4)
    stop(qtbot, session)
    assert "watch=lambda it: it.number < 4" in same_again(session, tmp_path)


def test_changes_during_a_run_are_repeated(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 3)
    session.run.change(stage("laplacian", ENDLESS))
    paused(qtbot, session, None, 2)
    session.run.change(stage("laplacian", StoppingCriteria(max_iterations=9, tolerance=0)))
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        session.run.resume()
    text = same_again(session, tmp_path)
    assert text.count("run.switch_method(hx.Laplacian()") == 2


@pytest.mark.slow
def test_time_limits_become_iteration_limits(session, qtbot, tmp_path):
    timed = StoppingCriteria(max_iterations=100_000, tolerance=0, max_seconds=0.05)
    run(qtbot, session, Recipe.of(stage("local-sd", timed), stage("laplacian")))
    run(qtbot, session, stage("local-sd", timed))
    assert "max_seconds" not in same_again(session, tmp_path)


def test_a_mesh_saved_during_a_pause_is_the_iteration(session, qtbot, tmp_path):
    paused(qtbot, session, stage("local-sd", ENDLESS), 4)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_branch_starts_at_the_displayed_iteration(session, qtbot, tmp_path):
    run(qtbot, session, stage("local-sd"))
    session.commands.pin(3, True)
    session.timeline.go(session.timeline.record, 2)
    session.commands.branch(stage("laplacian"))
    qtbot.waitUntil(lambda: not session.run.busy, timeout=PATIENCE)
    assert 'astype("f4")' in same_again(session, tmp_path)
    session.timeline.go(session.history.records[0], 0)
    same_again(session, tmp_path)


@pytest.mark.slow
def test_a_sweep_node_by_node_is_repeated(session, tmp_path):
    smoother = METHODS["local-sd"]()
    session.node_sweep.advance(smoother, 12)
    session.node_sweep.finish(smoother)
    session.node_sweep.advance(smoother, 5)
    text = same_again(session, tmp_path)
    assert text.count("sweep = Sweep(") == 2


@pytest.mark.slow
def test_repairs_of_the_doctor_are_repeated(session, qtbot, tmp_path):
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
def test_a_compared_method_is_run_again(session, qtbot, tmp_path):
    session.commands.pin(7, True)
    session.comparison.start([METHODS["laplacian"](), METHODS["getme"](relaxation=0.75)], SHORT)
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    session.commands.adopt_positions("GETMe", session.comparison.of("getme").state)
    same_again(session, tmp_path)
    session.commands.adopt_positions("back", session.comparison.initial)
    same_again(session, tmp_path)


def test_a_deck_is_saved_with_all_that_it_holds_and_so_by_the_script(session, qtbot, path, tmp_path):
    deck, out = tmp_path / "deck.inp", tmp_path / "out.inp"
    io.write(deck, io.read(path))
    deck.write_text("** our deck\n" + deck.read_text() + "*MATERIAL, NAME=Steel\n*STEP\n*END STEP\n")
    opened(qtbot, session, deck)
    run(qtbot, session, stage("local-sd"))
    save_and_wait(session, out)
    before, after = (file.read_text().split("\n") for file in (deck, out))
    assert len(before) == len(after)
    assert before[0] == after[0]
    assert before[-4:] == after[-4:]
    written = out.read_bytes()
    same_again(session, tmp_path)
    assert out.read_bytes() == written
    save_and_wait(session, out)  # again, on a file that was written before
    run(qtbot, session, stage("local-sd"))
    save_and_wait(session, out)
    assert out.read_text().startswith("** our deck")
    save_and_wait(session, tmp_path / "other.vtu")
    save_and_wait(session, deck)
    assert deck.read_text().startswith("** our deck")
    run(qtbot, session, stage("local-sd"))
    save_and_wait(session, deck)
    assert deck.read_text().startswith("** our deck")


def test_runs_with_rules_are_repeated_and_the_next_run_has_none(session, qtbot, tmp_path):
    setup = session.run_setup
    setup.set_rules(MotionRules(fix=("bad",)))
    session.commands.tag("bad", [7, 8])
    run(qtbot, session, stage("local-sd"))
    setup.set_rules(MotionRules())
    run(qtbot, session, Recipe.of(stage("getme"), rules=MotionRules(fix=("bad",))))
    run(qtbot, session, stage("local-sd"))
    text = same_again(session, tmp_path)
    assert text.count("fix=['bad']") == 2
