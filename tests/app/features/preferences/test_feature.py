"""Preferences: what the dialog stores is applied, at once or at the next start."""

import sys
from subprocess import run

import pytest
from PySide6.QtWidgets import QCheckBox, QComboBox

from hexmend_app.features.preferences.feature import PreferencesDialog
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.start.program import first_mesh
from hexmend_app.state.settings import settings
from hexmend_app.state.settings.settings import LETTERS, RECENT, REOPEN
from hexmend_app.theme import theme_choice
from hexmend_app.theme.palette import THEME
from hexmend_app.theme.theme_choice import ThemeChoice
from tests.app.conftest import separate_settings
from tests.app.driving import named


@pytest.fixture
def dialog(qtbot, tmp_path):
    with separate_settings(tmp_path / "settings"):
        dialog = PreferencesDialog()
        qtbot.addWidget(dialog)
        yield dialog
    theme_choice.apply_theme()


def test_a_theme_is_applied_at_once(dialog):
    box = named(dialog, QComboBox, "Theme")
    box.setCurrentText("Dark")
    box.activated.emit(box.currentIndex())
    assert theme_choice.chosen() is ThemeChoice.DARK
    assert THEME.dark


def test_the_last_mesh_is_opened_at_the_start_if_so_set_and_it_exists(dialog, mesh_file, tmp_path):
    RECENT.set((mesh_file,))
    assert first_mesh() == demo_mesh()
    named(dialog, QCheckBox, "Reopen the last mesh").click()
    assert REOPEN.get()
    assert first_mesh() == mesh_file
    RECENT.set((tmp_path / "gone.vtu", mesh_file))
    assert first_mesh() == demo_mesh()


@pytest.mark.slow
def test_letters_have_the_size_that_was_set_at_the_next_start(dialog, tmp_path):
    program = (
        "from hexmend_app.state.settings import settings; settings.store_in(%r)\n"
        "from hexmend_app.shell.start.program import application; print(application().font().pointSizeF())"
    )
    sizes = []
    for letters in (100, 150):
        LETTERS.set(letters)
        settings.write_all()
        words = [sys.executable, "-c", program % str(tmp_path / "settings")]
        sizes.append(float(run(words, capture_output=True, text=True, check=True).stdout))
    assert sizes[1] == pytest.approx(1.5 * sizes[0])
