"""The panel and the shortcut tell why a hex cannot be tagged."""

import pytest
from PySide6.QtWidgets import QComboBox, QLabel

from hexmend import LocalSteepestDescent, StoppingCriteria
from hexmend_app.features.tags.feature import FeatureTags
from hexmend_app.features.tags.tag_panel import TagPanel, TagRow
from hexmend_app.state.run.run_controller import Phase
from tests.app.hosting import action
from tests.core.grids import grid, scrambled


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
    ("selected", "busy", "name", "word"),
    [
        (False, False, "bad", "No hex selected"),
        (True, True, "bad", "during a run"),
        (False, True, "bad", "during a run"),
        (True, False, " ", "Enter a tag name"),
    ],
)
def test_a_refused_tag_has_a_reason(panel, refused, rows, selected, busy, name, word):
    panel.set_tags(rows)
    panel.findChild(QComboBox).setEditText(name)
    panel.set_state(selected, busy)
    panel.toggle()
    assert len(refused) == 1
    assert word in refused[0]
    # The first hint also tells how to select a hex.
    assert any(word in text or ("Select a hex" in text and not busy and name.strip()) for text in said(panel))


@pytest.fixture
def host(hosted):
    return hosted(scrambled(grid(4), 0.3))


def test_the_shortcut_reports_that_a_run_is_paused(host, qtbot):
    feature = FeatureTags(host)
    tag = action(feature, "tag")
    smoothing = host.session.run
    host.session.selection.choose(5)
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0), 1)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)
    feature.refresh()
    assert tag.enabled()
    tag.handle()
    assert "during a run" in " ".join(host.messages.messages()[-1])
    assert host.session.document.now.mesh.hex_sets == {}
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
    feature.refresh()
    tag.handle()
    assert host.session.document.now.mesh.hex_sets["tagged"].tolist() == [5]
