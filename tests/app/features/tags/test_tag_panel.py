"""Why a hex cannot be tagged is said, in the panel and where T is pressed."""

import pytest
from PySide6.QtWidgets import QComboBox, QLabel

from hexmend.run import StoppingCriteria
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.features.tags.feature import FeatureTags
from hexmend_app.features.tags.tag_panel import TagPanel, TagRow
from hexmend_app.state.run.run_controller import Phase
from tests.app.hosting import PlainHost, action
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


@pytest.fixture
def panel(shown):
    return shown(TagPanel(), 500, 200)


@pytest.fixture
def refused(panel):
    told = []
    panel.refused.connect(told.append)
    panel.toggle_requested.connect(lambda name: told.append(f"tagged {name}"))
    return told


def said(panel):
    return [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]


@pytest.mark.parametrize("rows", [[], [TagRow("one", 3, 0, 0.5)]])
@pytest.mark.parametrize(
    ("chosen", "busy", "name", "word"),
    [
        (False, False, "bad", "No hex is chosen"),
        (True, True, "bad", "while a run is under way"),
        (False, True, "bad", "while a run is under way"),
        (True, False, " ", "write one"),
    ],
)
def test_what_is_refused_has_a_reason(panel, refused, rows, chosen, busy, name, word):
    panel.set_tags(rows)
    panel.findChild(QComboBox).setEditText(name)
    panel.set_state(chosen, busy)
    panel.toggle()
    assert len(refused) == 1
    assert word in refused[0]
    # What a newcomer reads first says how a hex is chosen, too.
    assert any(word in text or ("Choose one" in text and not busy and name.strip()) for text in said(panel))


def test_what_is_possible_is_done(panel, refused):
    panel.set_state(True, False)
    panel.toggle()
    assert refused == ["tagged tagged"]


def test_the_panel_keeps_its_height_whatever_is_said(panel):
    heights = set()
    for chosen, busy in ((True, False), (False, False), (True, True)):
        panel.set_tags([TagRow("one", 3, 0, 0.5)])
        panel.set_state(chosen, busy)
        panel.layout().activate()
        heights.add(panel.findChild(QComboBox).geometry().top())
    assert len(heights) == 1


@pytest.fixture
def host(qtbot):
    host = PlainHost(scrambled(grid(4), 0.3))
    yield host
    host.session.close()


def test_the_key_says_why_nothing_is_tagged_while_a_run_is_paused(host, qtbot):
    feature = FeatureTags(host)
    tag = action(feature, "tag")
    smoothing = host.session.run
    host.session.selection.choose(5)
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0), 1)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED, timeout=PATIENCE)
    feature.refresh()
    assert tag.enabled()
    tag.handle()
    assert "while a run is under way" in " ".join(host.messages.messages()[-1])
    assert host.session.document.now.mesh.hex_sets == {}
    with qtbot.waitSignal(smoothing.ended, timeout=PATIENCE):
        smoothing.stop()
    feature.refresh()
    tag.handle()
    assert host.session.document.now.mesh.hex_sets["tagged"].tolist() == [5]
