"""The style sheet: legible by its colours, and complete."""

import re
from pathlib import Path

import pytest

from hexmend_app.theme import palette
from hexmend_app.theme.style import control_sheet
from tests.app.theme.contrasts import DISABLED, TEXT, contrast

THEMES = pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])

#: Images that are at least this much lighter or darker than what is behind them (WCAG 2.2, 1.4.11).
IMAGE = 3.0


def colours_of(dark):
    """Return the colours of a theme by name."""
    return {name: role.of(dark) for name, role in vars(palette).items() if isinstance(role, palette.Role)}


def rules(dark):
    """Return selector and declarations of each rule of the style sheet."""
    sheet = re.sub(r"/\*.*?\*/", "", control_sheet(dark), flags=re.DOTALL)
    for selector, body in re.findall(r"([^{}]+)\{([^{}]*)\}", sheet):
        yield selector.strip(), dict(re.findall(r"([\w-]+)\s*:\s*([^;]+)", body))


@THEMES
def test_every_rule_with_a_text_and_a_background_is_legible(dark):
    pairs = [
        (selector, body["color"], body["background"])
        for selector, body in rules(dark)
        if "color" in body and body.get("background", "").startswith("#")
    ]
    assert len(pairs) > 10
    faults = [
        f"{selector}: {text} on {ground}"
        for selector, text, ground in pairs
        if contrast(text, ground) < (DISABLED if ":disabled" in selector else TEXT)
    ]
    assert not faults


@THEMES
def test_colours_are_those_of_the_palette(dark):
    used = set(re.findall(r"#[0-9a-f]{6}\b", control_sheet(dark)))
    assert used <= set(colours_of(dark).values())


@THEMES
def test_controls_without_a_text_stand_out_from_panels(dark):
    colours = colours_of(dark)
    for name in ("OUTLINE", "ACCENT_LINE", "MUTED"):
        assert contrast(colours[name], colours["PANEL"]) >= IMAGE
        assert contrast(colours[name], colours["FIELD"]) >= IMAGE
    assert contrast(colours["ON_ACCENT"], colours["ACCENT"]) >= IMAGE
    assert contrast(colours["ACCENT"], colours["FIELD"]) >= IMAGE


@THEMES
def test_images_of_the_style_sheet_exist(dark):
    paths = re.findall(r'url\("([^"]+)"\)', control_sheet(dark))
    assert paths
    assert all(Path(path).is_file() for path in paths)
