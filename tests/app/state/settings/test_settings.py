"""What is remembered from one start to the next."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QSettings

import hexmend_app
from hexmend_app.state.settings import settings
from hexmend_app.state.settings.settings import Setting

ALL = {name: one for name, one in vars(settings).items() if isinstance(one, Setting)}
OTHERS = {
    "GEOMETRY": QByteArray(b"\0\1here"),
    "PANELS": {"hidden": True, "closed": ["tags"], "all": QByteArray(b"\0\1")},
    "THEME": "dark",
    "RECENT": (Path("/a/b c.vtu"), Path("/ä.vtk")),
    "FOLDER": Path("/somewhere"),
    "HISTORY_MEGABYTES": 128,
    "ITERATIONS_PLAYED": 30,
}


@pytest.fixture(autouse=True)
def kept(tmp_path, monkeypatch):
    """A file of settings of the test's own; read anew each time."""
    path = str(tmp_path / "settings.ini")
    monkeypatch.setattr(settings, "QSettings", lambda: QSettings(path, QSettings.Format.IniFormat))
    return Path(path)


def test_each_key_is_there_once():
    assert len({one.key for one in ALL.values()}) == len(ALL)


@pytest.mark.parametrize("name", ALL)
def test_what_is_kept_is_read_as_it_was(name, kept):
    one = ALL[name]
    assert one.get() == one.default
    one.set(OTHERS[name])
    assert kept.exists()
    assert one.get() == OTHERS[name] != one.default
    assert type(one.get()) is type(one.default)


@pytest.mark.parametrize("name", sorted(ALL.keys() - {"THEME", "FOLDER"}))
def test_what_cannot_be_read_gives_what_stands_at_first(name):
    one = ALL[name]
    settings.QSettings().setValue(one.key, "not {this}")
    assert one.get() == one.default


@pytest.mark.parametrize("kept", ["", "nonsense", "2 0.5", "nan nan", "0.5"])
def test_a_place_that_cannot_be_read_is_home(kept):
    one = settings.place_of("card", (1.0, 0.5))
    one.set((0.25, 0.0))
    assert settings.place_of("card", (1.0, 0.5)).get() == (0.25, 0.0)
    settings.QSettings().setValue(one.key, kept)
    assert one.get() == (1.0, 0.5)
    one.set((0.25, 0.0))
    one.forget()
    assert one.get() == (1.0, 0.5)


def test_the_settings_are_asked_nowhere_else():
    root = Path(hexmend_app.__file__).parent
    asking = {
        str(path.relative_to(root)) for path in root.rglob("*.py") if re.search(r"\bQSettings\b", path.read_text())
    }
    assert asking == {"state/settings/settings.py"}
