"""Suggestions that release nodes: without rules of motion, and on a larger part of the mesh."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QPushButton

from hexmend import METHODS, MotionRules, Stage, StoppingCriteria
from hexmend.advice import Suggestion
from hexmend_app.features.outcome.feature import FeatureOutcome
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import named
from tests.core.grids import displaced, grid


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


def run(host, qtbot):
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
    run(host, qtbot)
    assert session.document.now.summary.inverted > 0
    apply(host, "Mend without the fixed sets")
    assert session.run_setup.rules == MotionRules(interfaces="slide")
    run(host, qtbot)
    assert session.document.now.summary.inverted == 0


def test_a_larger_part_is_free_around_the_hexes_that_are_still_inverted(host, qtbot):
    session, node = host.session, tangled()[1]
    mesh = session.document.now.mesh
    corner = int(np.flatnonzero((mesh.points == [4, 4, 4]).all(axis=1))[0])
    session.commands.pin(np.setdiff1d(np.arange(mesh.n_nodes), corner), True)
    session.run_setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(1, keep_last=True)))
    run(host, qtbot)
    suggestion = Suggestion("Mend on a larger part", "", "inverted", METHODS["mend"](), widen=True)
    record = session.timeline.record
    record.advice = replace(record.advice, suggestions=(suggestion,))
    host.feature.refresh()
    host.feature.panel.suggestion_chosen.emit(0)
    pinned = session.document.now.mesh.pinned
    assert not pinned[node]
    inverted = session.document.now.figures.inverted
    around = mesh.topology.hexes_around(np.flatnonzero(inverted), 2)
    assert not pinned[mesh.hexes[around]].any()


@pytest.mark.parametrize(
    ("change", "text"),
    [({"rules": MotionRules()}, "rules of motion"), ({"widen": True}, "around the inverted hexes")],
)
def test_the_help_of_a_suggestion_says_what_it_changes(shown, qtbot, host, change, text):
    host.session.run_setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(1)))
    run(host, qtbot)
    panel, advice = shown(OutcomePanel(), 400, 300), host.session.run.advice
    suggestion = Suggestion("Mend", "", "inverted", METHODS["mend"](), **change)
    panel.show_advice("", replace(advice, suggestions=(suggestion,)))
    assert text in named(panel, QPushButton, "Select: Mend").toolTip()
