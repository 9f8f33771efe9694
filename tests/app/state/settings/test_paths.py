"""The state folder on each system."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from hexmend_app.state.settings.paths import VARIABLE, state_folder


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
