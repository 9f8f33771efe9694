"""Outcome of a run in the window, by mouse clicks and keys."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QPushButton

from hexmend import METHODS, MotionRules, Stage, StoppingCriteria, advise, gallery, iterate, smooth
from hexmend.advice import Suggestion
from hexmend.gallery import make
from hexmend_app.features.outcome.feature import FeatureOutcome, notice
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import button, click, click_until, key, named, open_mesh, phase, press, run_to_end, texts
from tests.core.grids import displaced, grid
from tests.core.smoothers.mend.test_mend import with_locked_corner


def run(window, qtbot, method, **stop):
    """Run a method by its button, wait for its end and show the panel of the outcome."""
    run_to_end(window, qtbot, method, **stop)
    window.show_panel("outcome")


def outcome_texts(window):
    window.refresh()
    return " ".join(texts(window.features["outcome"].panel))


def press_choice(window, name):
    window.refresh()
    QApplication.sendPostedEvents()  # lays out the new buttons
    press(named(window.features["outcome"].panel, QPushButton, name))


@pytest.fixture
def locked(window, qtbot, tmp_path):
    """Open a mesh with a hex that its fixed nodes lock, and return the number of the hex."""
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    open_mesh(qtbot, window, tmp_path / "locked.vtu", mesh)
    return int(mesh.topology.node_corners.items[0] // 8)


@pytest.mark.slow
def test_the_key_shows_why_the_run_stopped(window, qtbot):
    assert not window.features["outcome"].panel.isVisible()
    run_to_end(window, qtbot, "laplacian", keep_last=True)
    key(window, Qt.Key.Key_Y, Qt.KeyboardModifier.ShiftModifier)
    qtbot.waitUntil(window.features["outcome"].panel.isVisible)
    assert "Why Laplacian stopped" in outcome_texts(window)
    assert "no node moved further than 0.0001 mean edge lengths" in outcome_texts(window)
    inverted = window.session.document.now.summary.inverted
    assert f"{inverted} of {window.session.document.now.mesh.n_hexes:,} hexes are inverted" in outcome_texts(window)


@pytest.mark.slow
def test_a_suggestion_is_selected_without_a_run_and_improves_the_mesh(window, qtbot):
    run(window, qtbot, "laplacian", max_iterations=1)
    assert window.session.document.now.summary.inverted > 0
    press_choice(window, "Select: Mend")
    assert window.session.run_setup.method == "mend"
    assert window.session.run_setup.stage.stop == StoppingCriteria()  # the limit of one iteration is reset
    assert window.features["smooth"].panel.stage.stop.values() == StoppingCriteria().values()
    assert window.session.run.phase is Phase.FINISHED
    click(window, "Run")
    qtbot.waitUntil(lambda: window.session.run.busy)
    assert "A run is in progress" in outcome_texts(window)
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    assert window.session.document.now.summary.inverted == 0
    assert "Why Mend stopped" in outcome_texts(window)


@pytest.mark.slow
def test_a_suggestion_that_undoes_the_run_restores_the_mesh_before_it(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "sound.vtu", gallery.make("bridge-sharp", size=864))
    start = window.session.document.now.mesh.points
    run(window, qtbot, "laplacian", keep_last=True)
    assert window.session.document.now.summary.inverted > 0
    assert "Worse than at the start: inverted 0 → 12" in outcome_texts(window)
    press_choice(window, "Select: Undo, then Smart Laplacian")
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start)
    assert window.session.run_setup.method == "smart-laplacian"
    click_until(window, qtbot, "Run", Phase.FINISHED)
    assert window.session.document.now.summary.inverted == 0


@pytest.mark.slow
def test_locked_hexes_are_listed_and_isolated(window, qtbot, locked):
    run(window, qtbot, "mend")
    assert f'<a href="{locked}">{locked}</a>' in outcome_texts(window)
    assert '<a href="locked">Show</a>' in outcome_texts(window)
    window.features["outcome"].panel.text.linkActivated.emit("locked")
    assert window.session.view.look.show.isolate.hexes == (locked,)
    assert window.session.selection.hex == locked
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.show.isolate is None


# Notice at the end of a run, whatever panel is open.


def test_it_says_what_a_run_has_changed_and_undoes_it(window, qtbot):
    start = window.session.document.now
    run_to_end(window, qtbot, "mend")
    title, text = window.messages.title, window.messages.text
    counts = rf"{start.summary.inverted} → 0 inverted · {start.summary.invalid} → 0 invalid"
    pattern = rf"{counts} · q min 0\.\d{{4}} · scaled Jacobian min 0\.\d{{4}}"
    assert re.fullmatch(pattern, title)
    assert re.fullmatch(r"\d+ iterations · [\d.]+ s · Converged.*", text)
    press(button(window.messages, "Undo"))
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    assert not window.messages.isVisible()


@pytest.mark.slow
def test_it_is_removed_when_its_result_is_undone_by_other_means(window, qtbot):
    run_to_end(window, qtbot, "local-sd", max_iterations=2)
    window.messages.show_error("Other")
    assert sorted(kind for kind, *_ in window.messages.messages()) == ["error", "info"]
    window.action("undo").trigger()
    window.refresh()
    assert [title for _, title, _ in window.messages.messages()] == ["Other"]
    window.action("redo").trigger()
    window.refresh()
    assert [title for _, title, _ in window.messages.messages()] == ["Other"]


@pytest.mark.slow
def test_its_undo_leaves_later_changes_alone(window, qtbot):
    run_to_end(window, qtbot, "local-sd", max_iterations=2)
    undo = button(window.messages, "Undo")
    window.session.commands.reset()
    reset = window.session.document.now
    press(undo)
    assert window.session.document.now is reset


def test_a_run_that_helps_nothing_keeps_the_mesh_and_says_so():
    record = SimpleNamespace(result=0, message="Iteration 0 was kept: later ones were worse.")
    title, text = notice(record, None, None)
    assert title == "Initial mesh kept: no iteration was better"
    assert text == record.message


# Suggestions that release nodes: without rules of motion, and on a larger part of the mesh.


def tangled():
    """Return a grid of which an inner node lies outside, the number of that node, and a set with it."""
    mesh = grid(5)
    (node,) = np.flatnonzero((mesh.points == [2, 2, 2]).all(axis=1))
    return displaced(mesh, node, 4).replace(node_sets={"bolt": np.array([node])}), int(node)


@pytest.fixture
def host(hosted):
    host = hosted(tangled()[0])
    host.feature = FeatureOutcome(host)
    return host


def run_chosen(host, qtbot):
    session = host.session
    session.commands.run(session.run_setup.stage)
    qtbot.waitUntil(lambda: session.run.phase is Phase.FINISHED)
    host.feature.refresh()


def apply(host, title):
    """Select the suggestion with this title."""
    suggestions = host.session.run.advice.suggestions
    index = next(at for at, suggestion in enumerate(suggestions) if suggestion.title == title)
    host.feature.panel.suggestion_chosen.emit(index)


@pytest.mark.slow
def test_a_suggestion_without_the_rules_that_fix_sets_changes_the_rules_of_the_next_run(host, qtbot):
    session = host.session
    session.run_setup.set_rules(MotionRules(interfaces="slide", fix=("bolt",)))
    run_chosen(host, qtbot)
    assert session.document.now.summary.inverted > 0
    apply(host, "Mend without the fixed sets")
    assert session.run_setup.rules == MotionRules(interfaces="slide")
    run_chosen(host, qtbot)
    assert session.document.now.summary.inverted == 0


def test_a_larger_part_is_free_around_the_hexes_that_are_still_inverted(host, qtbot):
    session, node = host.session, tangled()[1]
    mesh = session.document.now.mesh
    corner = int(np.flatnonzero((mesh.points == [4, 4, 4]).all(axis=1))[0])
    session.commands.pin(np.setdiff1d(np.arange(mesh.n_nodes), corner), True)
    session.run_setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(1, keep_last=True)))
    run_chosen(host, qtbot)
    suggestion = Suggestion("Mend on a larger part", "", "inverted", METHODS["mend"](), widen=True)
    record = session.timeline.record
    record.advice = replace(record.advice, suggestions=(suggestion,))
    host.feature.refresh()
    host.feature.panel.suggestion_chosen.emit(0)
    pinned = session.document.now.mesh.pinned
    assert not pinned[node]
    inverted = session.document.now.quality.inverted
    around = mesh.topology.hexes_around(np.flatnonzero(inverted), 2)
    assert not pinned[mesh.hexes[around]].any()


@pytest.mark.parametrize(
    ("change", "text"),
    [({"rules": MotionRules()}, "rules of motion"), ({"widen": True}, "around the inverted hexes")],
)
def test_the_help_of_a_suggestion_says_what_it_changes(shown, qtbot, host, change, text):
    host.session.run_setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(1)))
    run_chosen(host, qtbot)
    panel, advice = shown(OutcomePanel(), 400, 300), host.session.run.advice
    suggestion = Suggestion("Mend", "", "inverted", METHODS["mend"](), **change)
    panel.show_advice("", replace(advice, suggestions=(suggestion,)))
    assert text in named(panel, QPushButton, "Select: Mend").toolTip()


# Panel of the outcome of a run.


@pytest.fixture
def panel(shown):
    return shown(OutcomePanel(), 400, 300)


def test_a_run_stopped_before_its_first_iteration_gets_no_suggestions(panel):
    run = iterate(make("cube", size=27, scramble=0.0), "mend")
    run.close()
    panel.show_advice("Why mend stopped", advise(run.result()))
    assert any("before its first iteration" in text for text in texts(panel))
    assert not any("No further suggestions" in text or "<b>Suggestions</b>" in text for text in texts(panel))
    panel.show_advice("Why mend stopped", advise(smooth(make("cube", size=27), "mend")))
    assert any("No further suggestions." in text and "<b>Suggestions</b>" in text for text in texts(panel))


def test_hexes_left_inverted_have_the_numbers_of_the_file_too(panel):
    result = smooth(make("cube", size=125, scramble=2.0), "laplacian", max_iterations=0)
    advice = advise(result)
    assert advice.unlocked.size
    panel.show_advice("Why Laplacian stopped", advice, np.arange(125) + 501)
    listed = ", ".join(str(number + 501) for number in advice.unlocked[:24])
    assert any("Inverted (not locked): " in text and f" (in the file {listed})" in text for text in texts(panel))


def test_a_stopped_run_keeps_what_is_shown_and_offers_the_better_iteration(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "bridge.vtu", gallery.make("bridge-sharp", size=864))
    session = window.session
    session.run.start(METHODS["laplacian"](), StoppingCriteria(tolerance=0), iterations=12)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    with qtbot.waitSignal(session.run.ended):
        session.run.stop()
    record = session.run.record
    assert session.timeline.shown_iteration.number == record.result == 12
    press(button(window.messages, f"Go to {record.better}"))
    assert session.timeline.shown_iteration.number == record.better < 12


def test_a_branch_begins_at_the_iteration_shown(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "bridge.vtu", gallery.make("bridge-sharp", size=864))
    session = window.session
    session.run.start(METHODS["laplacian"](), StoppingCriteria(tolerance=0), iterations=12)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    shown = session.document.now.mesh.points
    with qtbot.waitSignal(session.run.ended):
        session.commands.branch(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=1)))
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    np.testing.assert_array_equal(session.run.record.start.mesh.points, shown)
