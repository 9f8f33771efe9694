"""Icons: those that Hexmend draws can be told apart, and are sharp and legible in both themes."""

from itertools import combinations

import numpy as np
import pytest
from PySide6.QtCore import QSize
from PySide6.QtGui import QIcon, QImage

from hexmend_app.theme.icons import DRAWN, icon
from hexmend_app.theme.palette import FAINT, TEXT
from tests.app.theme.contrasts import contrast


def opacity(name, size, ratio=1.0):
    """Return the opacity of the pixels of an icon, from 0 to 1."""
    image = icon(name).pixmap(QSize(size, size), ratio).toImage().convertToFormat(QImage.Format.Format_RGBA8888)
    return np.array(image.constBits()).reshape(image.height(), image.width(), 4)[..., 3] / 255


@pytest.mark.parametrize("size", [16, 20])
def test_icons_differ(qapp, size):
    images = {name: opacity(name, size) for name in (*DRAWN, "cube-outline", "compare", "grid")}
    for one, other in combinations(images, 2):
        assert np.abs(images[one] - images[other]).sum() > 5, (one, other)


@pytest.mark.parametrize("name", DRAWN)
def test_icons_are_drawn_in_the_resolution_of_the_screen(qapp, name):
    assert opacity(name, 16, 2.0).shape == (32, 32)
    assert opacity(name, 16).max() > 0.9
    edge = opacity(name, 16).copy()
    edge[1:-1, 1:-1] = 0
    assert edge.max() < 0.9, "the icon is clipped"


@pytest.mark.parametrize("name", ["cut", "plus-x"])
def test_a_disabled_icon_is_faint(qapp, name):
    image = icon(name).pixmap(QSize(16, 16), 1.0, QIcon.Mode.Disabled).toImage()
    colours = {
        image.pixelColor(x, y).name() for x in range(16) for y in range(16) if image.pixelColor(x, y).alpha() > 250
    }
    assert str(FAINT) in colours
    assert str(TEXT) not in colours


def test_icons_of_the_tool_bar_differ(window):
    names = [action.property("icon_name") for action in window.menus.actions.values() if action.property("face")]
    shown = [name for name in names if name and name.startswith(("plus-", "minus-", "cut"))]
    assert len(set(shown)) == len(shown) == 7


def test_the_contrast_of_an_icon_suffices():
    for dark in (False, True):
        for ground in TEXT.on:
            assert contrast(TEXT.of(dark), ground.of(dark)) >= 4.5
