"""Light and dark theme: legible, complete, switched immediately and stored."""

from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import QSettings, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from hexmend.quality import measure, summarise
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.features.hex_inspector.hex_panel import HexPanel
from hexmend_app.features.hex_inspector.worst_list import WorstList
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.features.quality.feature import QualityBar
from hexmend_app.picture import Page, Scene, Show
from hexmend_app.report.distribution import Distribution
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.theme import palette as theme
from hexmend_app.theme import theme_choice
from hexmend_app.theme.palette import THEME, Role
from hexmend_app.theme.style import apply_style
from hexmend_app.theme.theme_choice import ThemeChoice
from hexmend_app.widgets.message_bar import MessageBar
from tests.app.driving import pixels, turn
from tests.app.features.convergence.test_panel import curve, record
from tests.app.theme.contrasts import TEXT, contrast, painted
from tests.core.grids import grid, scrambled

pytestmark = pytest.mark.slow

MESH = scrambled(grid(5), 0.9, 4)
FIGURES = measure(MESH.points, MESH.hexes)
WORST = int(FIGURES.scaled_jacobian.argmin())


@pytest.fixture(autouse=True)
def light_afterwards(qapp):
    apply_style(qapp, dark=False)
    yield
    apply_style(qapp, dark=False)


def test_the_contrast_agrees_with_wcag():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#767676", "#ffffff") == pytest.approx(4.54, abs=0.01)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_every_text_is_legible_on_its_backgrounds(dark):
    roles = {name: role for name, role in vars(theme).items() if isinstance(role, Role)}
    pairs = [(name, role.of(dark), ground.of(dark)) for name, role in roles.items() for ground in role.on]
    assert len(pairs) > 30
    assert [pair for pair in pairs if contrast(*pair[1:]) < TEXT] == []


def histogram():
    widget = QualityHistogram()
    start, now, kept = (Distribution.of(FIGURES.q**power, FIGURES.inverted) for power in (1, 2, 3))
    widget.show_distributions(start, now, [(4, "kept", kept)])
    widget.set_range(Show((0.2, 0.7), "q"))
    return widget


def quality():
    bar = QualityBar()
    bar.set_summaries(summarise(MESH, FIGURES), summarise(grid(5), measure(grid(5).points, grid(5).hexes)))
    bar.all_button.click()
    return bar


def worst():
    widget = WorstList()
    widget.show()
    widget.set_quality(MESH, FIGURES)
    return widget


def one_element():
    panel = HexPanel()
    panel.show_hex(describe_hex(MESH, WORST))
    panel.show_node(describe_node(MESH, int(MESH.hexes[WORST, 0])))
    return panel


def message(kind):
    bar = MessageBar()
    getattr(bar, f"show_{kind}")("Title")
    return bar


def convergence():
    panel = ConvergencePanel()
    panel.set_curves([curve(record("getme", 4))])
    return panel


BUILT = {
    "histogram": histogram,
    "quality": quality,
    "worst": worst,
    "hex": one_element,
    **{kind: partial(message, kind) for kind in ("error", "warning", "info")},
    "convergence": convergence,
    "colour bar": ColourBar,
}


def seen(widget):
    QApplication.sendPostedEvents()
    return painted(widget).astype(int)


@pytest.fixture
def alone(shared):
    """Close the shared window, which would take seconds to change its theme."""
    shared.forget()


@pytest.mark.parametrize("dark", [True, False], ids=["dark", "light"])
@pytest.mark.parametrize("name", BUILT)
def test_no_widget_keeps_a_colour_of_the_other_theme(qtbot, qapp, alone, name, dark):
    apply_style(qapp, dark=dark)
    new = BUILT[name]()
    apply_style(qapp, dark=not dark)
    switched = BUILT[name]()
    for widget in (new, switched):
        qtbot.addWidget(widget)
        widget.resize(520, 330)
    new.show()
    switched.show()
    other = seen(switched)
    apply_style(qapp, dark=dark)
    assert np.abs(seen(switched) - other).max() > 100
    turn()
    np.testing.assert_array_equal(seen(switched), seen(new))


def test_the_theme_is_switched_and_remembered(window, qtbot):
    light = pixels(window)
    ground = light[5, 5]
    theme_choice.choose(ThemeChoice.DARK)
    assert THEME.dark
    assert theme_choice.chosen() is ThemeChoice.DARK
    assert QSettings().value("theme") == "dark"
    qtbot.waitUntil(lambda: window.palette().window().color().name() == theme.PANEL.dark)
    assert (pixels(window)[5, 5] < ground - 100).all()
    now = window.session.document.now
    scene = Scene(page=Page(pixels=(400, 300)))
    report = np.asarray(draw_page(scene, [PageMesh.of(now.mesh)]).image())
    assert report[2, 2].tolist() == [255, 255, 255]  # white in both themes
    theme_choice.choose(ThemeChoice.LIGHT)
    assert not THEME.dark
    qtbot.waitUntil(lambda: window.palette().window().color().name() == theme.PANEL.light)
    assert (np.abs(pixels(window) - light).sum(axis=2) > 60).mean() < 0.02


def test_the_theme_follows_the_desktop_until_one_is_selected(window, monkeypatch):
    hints = QGuiApplication.styleHints()
    scheme = Qt.ColorScheme.Dark
    monkeypatch.setattr(type(hints), "colorScheme", lambda self: scheme)
    assert theme_choice.chosen() is ThemeChoice.DESKTOP
    hints.colorSchemeChanged.emit(scheme)
    assert THEME.dark
    scheme = Qt.ColorScheme.Light
    hints.colorSchemeChanged.emit(scheme)
    assert not THEME.dark
    theme_choice.choose(ThemeChoice.LIGHT)
    scheme = Qt.ColorScheme.Dark
    hints.colorSchemeChanged.emit(scheme)
    assert not THEME.dark
