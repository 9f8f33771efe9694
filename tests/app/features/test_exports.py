"""Charts, saved through the dialogs that name what is in them."""

import csv

import pytest
from PIL import Image
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QLabel

from hexmend import METHODS, StoppingCriteria
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.widgets.dialogs.chart_dialog import ChartDialog
from tests.app.driving import phase

pytestmark = pytest.mark.slow

SHORT = StoppingCriteria(max_iterations=3)


@pytest.fixture
def worked(window, qtbot):
    """A window in which a method has run."""
    window.session.run.start(METHODS["laplacian"](), SHORT)
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    for panel in ("histogram", "convergence"):
        window.show_panel(panel)
        window.refresh()
    return window


def answer(window, feature, path, title, names, **style):
    """Have a feature ask, answer as a user would, and give up where that is refused; what was said then."""
    said = []

    def fill():
        dialog = next(one for one in window.findChildren(ChartDialog) if one.isVisible())
        try:
            dialog.target.line.setText(str(path))
            dialog.title.setText(title)
            for own, name in names.items():
                dialog.names[own].setText(name)
            for name, value in style.items():
                dialog.form.editors[name].set_value(value)
            dialog.accept()
        finally:
            said.extend(one.text() for one in dialog.findChildren(QLabel) if one.accessibleName() == "Problem")
            if dialog.isVisible():
                dialog.reject()

    QTimer.singleShot(0, fill)
    window.features[feature].ask()
    return said[0]


def test_what_is_named_in_the_dialog_is_named_so_in_the_table(worked, tmp_path):
    for feature, own in (("histogram", "now"), ("convergence", METHODS["laplacian"].title)):
        answer(worked, feature, tmp_path / "table.csv", "", {own: "what I did"})
        with (tmp_path / "table.csv").open(newline="") as file:
            cells = [cell for row in csv.reader(file) for cell in row]
        assert "what I did" in cells
        assert own not in cells


def test_figures_are_as_wide_as_was_asked_and_the_next_ones_too(worked, tmp_path):
    for feature in ("histogram", "convergence"):
        answer(worked, feature, tmp_path / "a.png", "title", {}, width=76.2, resolution=100.0)
        with Image.open(tmp_path / "a.png") as picture:
            assert picture.width == 300
        answer(worked, feature, tmp_path / "b.png", "title", {})
        assert (tmp_path / "b.png").read_bytes() == (tmp_path / "a.png").read_bytes()
