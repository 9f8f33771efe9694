"""Settings that are stored between starts."""

import re
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QSettings

import hexmend_app
from hexmend_app.state.session.recovery import VARIABLE, state_folder
from hexmend_app.state.settings import settings
from hexmend_app.state.settings.settings import Setting

ALL = {name: value for name, value in vars(settings).items() if isinstance(value, Setting)}
OTHERS = {
    "GEOMETRY": QByteArray(b"\0\1here"),
    "PANELS": {"hidden": True, "closed": ["tags"], "all": QByteArray(b"\0\1")},
    "THEME": "dark",
    "LETTERS": 150,
    "REOPEN": True,
    "RECENT": (Path("/a/b c.vtu"), Path("/ä.vtk")),
    "FOLDER": Path("/somewhere"),
    "HISTORY_MEGABYTES": 128,
    "ITERATIONS_PLAYED": 30,
    "EVERY_ITERATION": True,
    "KEY_FIGURES": False,
}


@pytest.fixture(autouse=True)
def file(tmp_path, monkeypatch):
    """Store settings in a temporary file, which is read at every access."""
    path = str(tmp_path / "settings.ini")
    monkeypatch.setattr(settings, "QSettings", lambda: QSettings(path, QSettings.Format.IniFormat))
    return Path(path)


@pytest.mark.parametrize("name", ALL)
def test_a_stored_value_is_read_unchanged(name, file):
    setting = ALL[name]
    assert setting.get() == setting.default
    setting.set(OTHERS[name])
    assert file.exists()
    assert setting.get() == OTHERS[name] != setting.default
    assert type(setting.get()) is type(setting.default)


@pytest.mark.parametrize("name", sorted(ALL.keys() - {"THEME", "FOLDER"}))
def test_an_invalid_value_gives_the_default(name):
    setting = ALL[name]
    settings.QSettings().setValue(setting.key, "not {this}")
    assert setting.get() == setting.default


def test_only_this_module_uses_qsettings():
    root = Path(hexmend_app.__file__).parent
    users = {
        str(path.relative_to(root)) for path in root.rglob("*.py") if re.search(r"\bQSettings\b", path.read_text())
    }
    assert users == {"state/settings/settings.py"}


# The state folder on each system.


@pytest.mark.parametrize(("system", "variables", "expected"), [
    ("linux", {}, "home/.local/state/hexmend"),
    ("linux", {"XDG_STATE_HOME": "/x"}, "/x/hexmend"),
    ("linux", {"XDG_STATE_HOME": "x"}, "home/.local/state/hexmend"),
    ("darwin", {}, "home/Library/Application Support/Hexmend"),
    ("win32", {}, "home/AppData/Local/Hexmend"),
    ("win32", {"LOCALAPPDATA": "/data"}, "/data/Hexmend"),
    ("linux", {VARIABLE: "/own", "XDG_STATE_HOME": "/x"}, "/own"),
])  # fmt: skip
def test_the_folder_follows_the_convention_of_the_system(system, variables, expected, monkeypatch, tmp_path):
    for name in (VARIABLE, "XDG_STATE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "home")
    assert state_folder() == tmp_path / expected
