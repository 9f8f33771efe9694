"""Bar of key figures in the view."""

import dataclasses

import pytest
from PySide6.QtWidgets import QLabel

from hexmend.iteration import StoppingCriteria
from hexmend.quality import summarise
from hexmend_app.features.quality.quality_bar import FIGURES, QualityBar
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.style import BETTER, WORSE
from hexmend_app.widgets.wording import figure
from tests.app.driving import choose, click, phase
from tests.core.grids import grid
from tests.patience import PATIENCE

START = dataclasses.replace(
    summarise(grid(2)), inverted=56, invalid=58, q_min=0.4035, q_mean=0.8916, scaled_jacobian_min=0.2224
)
NOW = dataclasses.replace(START, inverted=0, invalid=2, q_min=0.4841, q_mean=0.8781)


@pytest.fixture
def bar(shown):
    bar = shown(QualityBar(), 900, 30)
    bar.set_summaries(START, NOW)
    return bar


def colours(bar):
    html = bar.findChild(QLabel).text()
    return [part.split(";")[0].split('"')[0] for part in html.split('<b style="color: ')[1:]]


def test_each_figure_has_its_value_at_the_start_and_an_arrow_in_the_colour_of_better_or_worse(bar):
    assert bar.text == (
        "inverted 56 → 0 ▼ invalid 58 → 2 ▼ q min 0.4035 → 0.4841 ▲ q mean 0.8916 → 0.8781 ▼ scaled Jacobian min 0.2224"
    )
    assert colours(bar)[:4] == [str(BETTER), str(BETTER), str(BETTER), str(WORSE)]
    assert "q mean 0.8781, worse than at the start: 0.8916" in bar.findChild(QLabel).accessibleDescription()


def test_differences_of_rounding_have_no_arrow(bar):
    bar.set_summaries(START, dataclasses.replace(START, q_min=START.q_min - 1e-14))
    assert not set(bar.text) & set("▲▼→")


def test_a_narrow_bar_omits_the_figures_at_the_start(bar):
    bar.resize(400, bar.height())
    assert "q min 0.4841 ▲" in bar.text
    assert "→" not in bar.text
    bar.resize(900, bar.height())
    assert "0.4035 → 0.4841 ▲" in bar.text


def test_the_bar_follows_a_run(window, qtbot):
    bar = window.features["quality"].bar
    start = window.session.document.start.summary
    assert bar.isVisible()
    assert "→" not in bar.text
    seen = set()
    window.session.run.iterated.connect(lambda frame: seen.add(frame.iteration.number))
    choose(window, "local-sd", StoppingCriteria(max_iterations=5))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.refresh()
    now = window.session.document.now.summary
    assert seen
    changes = [f"{one.label} {figure(getattr(start, one.key))} → {figure(getattr(now, one.key))}" for one in FIGURES]
    qtbot.waitUntil(lambda: all(change in bar.text for change in changes), timeout=PATIENCE)
