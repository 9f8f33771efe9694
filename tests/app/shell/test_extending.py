"""The feature of docs/extending.md, as a folder that is added: menu, palette, page of keys and window have it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest

import hexmend_app.features
from hexmend import gallery
from hexmend.quality import METRICS
from hexmend_app.shell.keys import as_markdown
from hexmend_app.shell.window import Window
from hexmend_app.state.document import State

TEXT = (Path(__file__).resolve().parents[3] / "docs/extending.md").read_text(encoding="utf-8")
_, EXAMPLE = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


@pytest.fixture
def with_folder(qtbot, tmp_path, monkeypatch):
    """A window that finds one folder more."""
    folder = tmp_path / "volume"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "feature.py").write_text(EXAMPLE, encoding="utf-8")
    monkeypatch.setattr(hexmend_app.features, "__path__", [*hexmend_app.features.__path__, str(tmp_path)])
    window = Window()
    window.furnish()
    window.show()
    yield window
    window.close()
    window.deleteLater()
    for name in [name for name in sys.modules if name.startswith("hexmend_app.features.volume")]:
        del sys.modules[name]


def test_a_folder_is_enough(with_folder, cube):
    window = with_folder
    assert "volume" in window.features
    assert window.action("volume").text() == "&Volume of the mesh"
    assert not window.action("volume").isEnabled()
    assert "| Volume of the mesh | `Ctrl+Shift+V` | Say how large the mesh is. |" in as_markdown(
        window.menus.declared()
    )
    window.session.document.replace(State.of(cube), None)
    window.refresh()
    window.action("volume").trigger()
    assert window.in_front("volume")
    volume = METRICS["volume"].of(cube.points, cube.hexes, window.session.document.now.figures).sum()
    assert np.isclose(float(window.features["volume"].panel.text().split()[0]), volume)


@pytest.fixture
def cube():
    """A mesh."""
    return gallery.make("cube", size=64)
