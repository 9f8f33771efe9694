"""Runs in the window: started, paused, stepped, stopped and reset, by mouse and keys."""

import threading

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QMessageBox

from hexmend import METHODS, MotionRules, Recipe, Stage, StoppingCriteria, read_recipe, write_recipe
from hexmend import smooth as smoothed
from hexmend.gallery import make
from hexmend_app.features.smooth.feature import FeatureSmooth
from hexmend_app.features.smooth.rule_form import RuleForm, rules_of_set, with_set_rules
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.run import worker
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.state.session import commands, session_data
from hexmend_app.state.settings import settings
from hexmend_app.widgets.section import Section
from tests.app.driving import (
    choose,
    click,
    click_until,
    heard_from,
    key,
    named,
    phase,
    run_to_end,
    sentence,
    smooth,
    type_text,
)
from tests.patience import PATIENCE

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def counts(window):
    """Return the text of the counts below the view."""
    window.refresh()
    return named(window, QLabel, "Counts").text()


@pytest.mark.slow
@pytest.mark.parametrize("back", [Qt.Key.Key_Z, Qt.Key.Key_R], ids=["undo", "reset"])
def test_the_outcome_of_a_run_follows_undo_and_redo(window, qtbot, back):
    panel, before = window.features["smooth"].panel, counts(window)
    run_to_end(window, qtbot, "laplacian", tolerance=0.0, max_iterations=3)
    after, said, progress = counts(window), sentence(window), named(panel, QLabel, "Progress").text()
    assert after != before
    assert said
    assert "iteration" in progress
    key(window, back, CONTROL)
    assert (counts(window), sentence(window)) == (before, "")
    assert named(panel, QLabel, "Progress").text() != progress
    key(window, Qt.Key.Key_Z, CONTROL, *([SHIFT] if back == Qt.Key.Key_Z else []))
    assert (counts(window), sentence(window)) == (after, said)
    assert named(panel, QLabel, "Progress").text() == progress


@pytest.fixture
def slow_method(monkeypatch):
    """Block the preparation of a method until the returned event is set."""
    go_on, iterate = threading.Event(), worker.iterate

    def preparing(*order):
        go_on.wait(PATIENCE / 1000)
        return iterate(*order)

    monkeypatch.setattr(worker, "iterate", preparing)
    yield go_on
    go_on.set()


@pytest.mark.slow
def test_a_run_is_stopped_while_its_method_is_prepared(window, qtbot, slow_method):
    before = window.session.document.now
    click(window, "Run")
    assert window.session.run.phase is Phase.PREPARING
    assert "Preparing" in sentence(window)
    click(window, "Stop")
    assert window.session.run.phase is Phase.STOPPING
    assert "when the method is ready" in sentence(window)
    assert not window.action("stop").isEnabled()
    slow_method.set()
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    assert window.session.document.now is before
    assert window.session.document.undo_title is None
    assert "Stopped" in sentence(window)
    assert not window.busy.isVisible()
    window.session.commands.tag("bad", [7])
    assert sentence(window) == ""  # the mesh is no longer that of the run


# Closing the window


@pytest.mark.slow
def test_cancelling_keeps_the_window_and_its_run(fresh_window, qtbot, monkeypatch):
    window = fresh_window
    click_until(window, qtbot, "Step", Phase.PAUSED)
    with monkeypatch.context() as patched:
        patched.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Cancel)
        window.close()
        assert window.isVisible()
        assert window.session.run.phase is Phase.PAUSED


def test_every_iteration_is_chosen_in_the_menu_and_stored(window):
    window.action("every_iteration").trigger()
    assert window.session.run.shows_every
    assert settings.EVERY_ITERATION.get()


# Shortage of memory: the window asks before a run, and nothing changes if the user declines.


YES, NO = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No


@pytest.fixture
def asked(window, monkeypatch):
    """Make memory short; record the questions of the window and answer them with `answer`."""

    class Asked(list):
        answer = NO

        def exec(self, box):
            self.append(f"{box.text()} {box.informativeText()}")
            return self.answer

    asked = Asked()
    monkeypatch.setattr(commands, "available", lambda: 80_000_000)
    monkeypatch.setattr(QMessageBox, "exec", lambda box: asked.exec(box))
    monkeypatch.setattr(METHODS["mend"], "bytes_per_hex", 10**9)
    return asked


@pytest.mark.slow
def test_a_run_starts_only_with_consent(window, qtbot, asked):
    session = window.session
    before = session.document.now
    choose(window, "mend", StoppingCriteria(max_iterations=2))
    for begin in (lambda: click(window, "Run"), lambda: click(window, "Step"), lambda: key(window, Qt.Key.Key_F5)):
        begin()
        assert session.run.phase is Phase.IDLE
        assert session.document.now is before
        assert not session.history.records
    assert len(asked) == 3
    assert "Mend on " in asked[0]
    assert "80\u00a0MB are free" in asked[0]
    asked.answer = YES
    with qtbot.waitSignal(session.run.ended):
        click(window, "Run")
    assert session.document.now is not before


def test_a_recipe_and_a_comparison_need_consent(window, asked):
    session = window.session
    session.recipe_draft.add(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=2)))
    session.recipe_draft.add(Stage(METHODS["mend"](), StoppingCriteria(max_iterations=2)))
    window.features["recipe"].run()
    assert session.run.phase is Phase.IDLE
    window.features["compare"].panel.model.tick(["laplacian", "mend"])
    window.features["compare"].run()
    assert not session.comparison.busy
    assert len(asked) == 2


@pytest.mark.slow
def test_a_branch_without_consent_leaves_the_active_run(window, qtbot, asked):
    choose(window, "laplacian", StoppingCriteria(tolerance=0.0))
    click_until(window, qtbot, "Step", Phase.PAUSED)
    record = window.session.run.record
    choose(window, "mend", StoppingCriteria())
    window.action("iteration_branch").trigger()
    assert len(asked) == 1
    assert window.session.run.phase is Phase.PAUSED
    assert window.session.run.record is record


# Rules of motion in the window: shown for sets and interfaces, chosen, used by runs, and stored.


SHORT = StoppingCriteria(max_iterations=3, tolerance=0)
SLIDING = MotionRules(interfaces="slide", fix=("inlet",))


def two_materials():
    """Scrambled cube of two materials, with sets of its opposite sides and of a node inside."""
    mesh = make("cube", size=64, scramble=0.3)
    x = make("cube", size=64).points
    sides = {name: np.flatnonzero(x[:, 0] == end) for name, end in (("inlet", x.min()), ("outlet", x.max()))}
    inside = np.flatnonzero(mesh.free)[:1]
    hexes = {"low": np.arange(32), "high": np.arange(32, 64)}
    return mesh.replace(node_sets={**sides, "inside": inside}, hex_sets=hexes)


@pytest.fixture
def mesh():
    return two_materials()


@pytest.fixture
def form(shown, mesh):
    form = shown(RuleForm(), 300, 400)
    form.show_rules(mesh, MotionRules())
    return form


@pytest.fixture
def host(hosted, mesh):
    host = hosted(mesh)
    host.feature = FeatureSmooth(host)
    return host


def boxes(form):
    """Return the boxes of the rules of sets by accessible name, without those that are being deleted."""
    QApplication.processEvents()  # rows are shown in the next turn of the event loop
    return {one.accessibleName(): one for one in form.findChildren(QComboBox) if not one.isHidden()}


def box(form, name):
    return boxes(form)[f"Rule of {name}"]


def pick(form, name, text):
    """Choose the rule of a set by keys."""
    combo = box(form, name)
    combo.setFocus(Qt.FocusReason.TabFocusReason)
    at = combo.findText(text)
    combo.setCurrentIndex(at)
    combo.activated.emit(at)


def test_the_form_tells_the_interfaces_and_lists_the_sets(form):
    found = named(form, QLabel, "Interfaces found")
    assert found.text() == "2 materials; 9 nodes on their interfaces are kept."
    form.interfaces.button("slide").click()
    assert found.text() == "2 materials; 9 nodes on their interfaces are to slide along them."
    assert list(boxes(form)) == [f"Rule of {name}" for name in ("inlet", "outlet", "inside", "low", "high")]


def test_a_choice_is_sent_as_rules(form):
    heard = heard_from(form.changed)
    pick(form, "inlet", "Fixed")
    assert heard[-1] == MotionRules(fix=("inlet",))
    assert form.title == "Interfaces and sets (1 rule)"
    pick(form, "inlet", "Slides")
    assert heard[-1] == MotionRules(slide=("inlet",))
    pick(form, "inlet", "No rule")
    assert heard[-1] == MotionRules()
    assert form.title == "Interfaces and sets"


@pytest.mark.parametrize(("name", "text", "reason"), [
    ("inside", "In its plane", "has no plane"), ("inlet", "Free", "cannot be free"), ("low", "In its plane", "not flat"),
])  # fmt: skip
def test_a_rule_that_a_set_cannot_have_is_refused_with_the_reason(form, name, text, reason):
    pick(form, name, text)
    assert reason in named(form, QLabel, "Problem of the rules").text()
    assert box(form, name).currentText() == "No rule"


def test_a_pair_that_does_not_match_is_refused_with_the_reason(form, mesh):
    x = make("cube", size=64).points
    apart = np.flatnonzero(x[:, 1] == x[:, 1].min())
    apart = np.concatenate([apart[:-1], np.flatnonzero(mesh.free)[-1:]])
    form.show_rules(mesh.replace(node_sets={**mesh.node_sets, "apart": apart}), MotionRules())
    pick(form, "inlet", "Periodic: apart")
    assert "not periodic" in named(form, QLabel, "Problem of the rules").text()
    assert box(form, "inlet").currentText() == "No rule"


def test_several_rules_of_a_set_are_shown_and_replaced_together():
    rules = MotionRules(fix=("a",), periodic=(("b", "a"),))
    assert rules_of_set(rules, "a") == (("fix", ""), ("periodic", "b"))
    assert with_set_rules(rules, "a", (("plane", ""),)) == MotionRules(plane=("a",))
    assert with_set_rules(rules, "b", (("periodic", "c"),)) == MotionRules(fix=("a",), periodic=(("b", "c"),))


def test_a_set_that_the_mesh_lacks_is_shown_as_long_as_it_has_a_rule(form, mesh):
    form.show_rules(mesh, MotionRules(fix=("other",)))
    assert box(form, "other").currentText() == "Fixed"
    pick(form, "other", "No rule")
    form.show_rules(mesh, MotionRules())
    assert "Rule of other" not in boxes(form)


def test_the_form_is_hidden_for_a_mesh_without_sets(host):
    feature, panel = host.feature, host.feature.panel
    feature.refresh()
    section = panel.rule_form.parentWidget().parentWidget()
    assert not section.isHidden()
    assert panel.rule_form.isEnabled()
    host.session.document.replace(MeasuredMesh.of(make("cube", size=27)), None)
    feature.refresh()
    assert section.isHidden()


def test_a_run_has_the_rules_and_its_result_has_none(host, mesh, qtbot):
    host.session.run_setup.set_rules(SLIDING)
    smooth(qtbot, host.session, "local-sd", boundary="slide")
    after = host.session.document.now.mesh
    expected = smoothed(mesh, METHODS["local-sd"](boundary="slide"), SHORT, interfaces="slide", fix=("inlet",)).mesh
    np.testing.assert_array_equal(after.points, expected.points)
    assert (after.points[mesh.node_sets["inlet"]] == mesh.points[mesh.node_sets["inlet"]]).all()
    free = smoothed(mesh, METHODS["local-sd"](boundary="slide"), SHORT).mesh
    assert (after.points != free.points).any()
    assert not after.node_rules.rules
    assert host.session.run.record.recipe.rules == SLIDING


def test_recipes_have_the_rules_in_files(host, tmp_path):
    session = host.session
    session.run_setup.set_rules(SLIDING)
    session.recipe_draft.add(Stage(METHODS["getme"]()))
    write_recipe(tmp_path / "r.toml", session.recipe_draft.recipe)
    session.run_setup.set_rules(MotionRules())
    session.recipe_draft.load(read_recipe(tmp_path / "r.toml"))
    assert session.run_setup.rules == SLIDING
    session.recipe_draft.load(Recipe.of("mend"))  # a recipe without rules
    assert session.run_setup.rules == SLIDING


def test_sessions_have_the_rules(host, tmp_path):
    session = host.session
    session.run_setup.set_rules(SLIDING)
    session_data.write(tmp_path / "a.hexmend", session.to_data())
    session.run_setup.set_rules(MotionRules())
    session.restore(session_data.read(tmp_path / "a.hexmend"))
    assert session.run_setup.rules == SLIDING


def test_another_mesh_keeps_the_rules_of_the_sets_that_it_has(host, mesh):
    session = host.session
    session.run_setup.set_rules(MotionRules(interfaces="slide", fix=("inlet", "low"), periodic=(("inlet", "outlet"),)))
    sets = {name: nodes for name, nodes in mesh.node_sets.items() if name != "outlet"}
    session.document.replace(MeasuredMesh.of(make("cube", size=64).replace(node_sets=sets)), None)
    assert session.run_setup.rules == MotionRules(interfaces="slide", fix=("inlet",))


def test_rules_that_do_not_fit_the_mesh_are_an_error_before_the_run(host, qtbot):
    session = host.session
    session.run_setup.set_rules(MotionRules(fix=("nowhere",)))
    before = session.document.now
    with qtbot.waitSignal(session.run.failed):
        session.commands.run(Stage(METHODS["local-sd"](), SHORT))
    assert session.document.now is before
    ((kind, title, text),) = host.messages.messages()
    assert (kind, title) == ("error", "Run not started")
    assert "there is no set 'nowhere'" in text


def test_rules_follow_a_tag_that_is_renamed(qtbot, host):
    session = host.session
    session.run_setup.set_rules(MotionRules(fix=("low",), slide=("inlet",), periodic=(("inlet", "outlet"),)))
    session.commands.rename_tag("low", "lower half")
    assert session.run_setup.rules == MotionRules(
        fix=("lower half",), slide=("inlet",), periodic=(("inlet", "outlet"),)
    )
    session.commands.undo()
    assert session.run_setup.rules.fix == ("low",)
    session.commands.redo()
    session.run_setup.set_rules(MotionRules(fix=("lower half",)))
    before = session.document.now.mesh
    smooth(qtbot, session, "local-sd")
    after = session.document.now.mesh
    nodes = np.unique(before.hexes[before.hex_sets["lower half"]])
    np.testing.assert_array_equal(after.points[nodes], before.points[nodes])


def test_rules_of_a_tag_that_is_removed_do_not_pass_to_another(host):
    session = host.session
    session.run_setup.set_rules(MotionRules(fix=("low",)))
    session.commands.remove_tag("low")
    assert session.run_setup.rules == MotionRules(fix=("low",))


# The smoothing panel, and the commands that use what it sets.


_STAGE = Stage(METHODS["getme"](scaling=0.25), StoppingCriteria(max_iterations=7))


@pytest.fixture
def setup(qapp):
    """Set-up of the panel: the method GETMe, scaling 0.25."""
    setup = RunSetup()
    setup.choose(_STAGE)
    return setup


@pytest.fixture
def panel(shown, setup):
    return shown(SmoothingPanel(setup), 360, 700)


def test_nothing_is_edited_while_a_run_is_active(host, qtbot):
    feature, run, form = host.feature, host.session.run, host.feature.panel.stage
    editable = {}

    def look():
        feature.refresh()
        parts = (form.parameters, form.stop, form.method)
        assert len({part.isEnabled() for part in parts}) == 1
        editable[run.phase] = form.method.isEnabled()
        assert not feature.panel.rule_form.isEnabled() or run.phase in (Phase.IDLE, Phase.FINISHED)

    run.phase_changed.connect(look)
    host.session.run_setup.choose(Stage(METHODS["local-sd"](), StoppingCriteria(tolerance=0)))
    feature.step()
    qtbot.waitUntil(lambda: run.phase is Phase.PAUSED)
    with qtbot.waitSignal(run.ended):
        run.stop()
    look()
    on = {Phase.PAUSED, Phase.FINISHED}
    assert on <= set(editable)
    assert {phase for phase, enabled in editable.items() if enabled} == on


def test_keys_choose_a_method_and_each_keeps_its_values(panel, setup):
    method = named(panel, QComboBox, "Method")
    method.setFocus()
    QTest.keyClick(method, Qt.Key.Key_Down)
    assert setup.method == "getme-sequential"
    assert setup.stage.smoother == METHODS["getme-sequential"]()
    assert METHODS["getme-sequential"].help in "".join(label.text() for label in panel.findChildren(QLabel))
    QTest.keyClick(method, Qt.Key.Key_Up)
    assert panel.stage.parameters.values()["scaling"] == 0.25
    assert setup.stage == _STAGE


def test_settings_changed_while_paused_change_the_run(host, qtbot):
    feature, session = host.feature, host.session
    session.run_setup.choose(Stage(METHODS["getme"](scaling=0.25), StoppingCriteria(tolerance=0)))
    for _ in range(2):  # the second step continues with the same stage
        feature.step()
        qtbot.waitUntil(lambda: session.run.phase is Phase.PAUSED)
    record = session.run.record
    assert len(record.recipe.stages) == 1
    feature.panel.stage.parameters.editors["scaling"].stepUp()
    feature.step()
    qtbot.waitUntil(lambda: session.run.phase is Phase.PAUSED and record.newest == 3)
    with qtbot.waitSignal(session.run.ended):
        session.run.stop()
    before, after = record.recipe.stages
    assert before.stop.max_iterations == 2
    assert after.smoother.scaling > 0.25


def test_run_shows_an_invalid_value(host, shown):
    feature, setup = host.feature, host.session.run_setup
    setup.choose(_STAGE)
    panel = shown(feature.panel, 360, 700)
    parameters = panel.findChildren(Section)[0]
    parameters.expand()
    editor = panel.stage.parameters.editors["scaling"]
    editor.lineEdit().setFocus()
    type_text(editor.lineEdit(), "-7")
    assert setup.stage is None
    assert setup.smoother is None
    parameters.collapse()
    feature.run_or_pause()
    feature.step()
    assert host.session.run.phase is Phase.IDLE
    assert "Correct" in named(panel, QLabel, "Outcome").text()
    assert editor.isVisible()
    assert editor.hasFocus()


def test_no_time_limit_is_called_none(panel, setup):
    seconds = panel.stage.stop.editors["max_seconds"]
    assert seconds.lineEdit().text() == "none"
    type_text(seconds.lineEdit(), "20")
    assert setup.stage.stop.max_seconds == 20
    type_text(seconds.lineEdit(), "none")
    assert setup.stage.stop.max_seconds == 0


def test_the_status_shows_progress_and_wraps_the_outcome(panel, qtbot):
    panel.set_status(12, 1.839, "Converged: no node moved further than the tolerance. " * 3)
    progress, sentence = named(panel, QLabel, "Progress"), named(panel, QLabel, "Outcome")
    assert progress.text() == "12 iterations · 1.84 s"
    qtbot.waitUntil(lambda: sentence.height() > 2 * sentence.fontMetrics().height())
    assert sentence.width() <= panel.width()
