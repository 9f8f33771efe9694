"""The style sheet: legible by its colours, complete, and with images that are up to date."""

import re
import runpy

import pytest

from hexmend_app.resources import resource
from hexmend_app.theme.style_sheet import control_sheet, tokens
from tests.app.theme.contrasts import DISABLED, TEXT, contrast
from tests.examples import ROOT

THEMES = pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])

#: Images that are at least this much lighter or darker than what is behind them (WCAG 2.2, 1.4.11).
IMAGE = 3.0


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
    allowed = {value for value in tokens(dark).values() if value.startswith("#")}
    used = set(re.findall(r"#[0-9a-f]{6}\b", control_sheet(dark)))
    assert used <= allowed


@THEMES
def test_controls_without_a_text_stand_out_from_panels(dark):
    colours = tokens(dark)
    for name in ("OUTLINE", "ACCENT_LINE", "MUTED"):
        assert contrast(colours[name], colours["PANEL"]) >= IMAGE
        assert contrast(colours[name], colours["FIELD"]) >= IMAGE
    assert contrast(colours["ON_ACCENT"], colours["ACCENT"]) >= IMAGE
    assert contrast(colours["ACCENT"], colours["FIELD"]) >= IMAGE


@THEMES
def test_images_of_the_style_sheet_exist(dark):
    paths = re.findall(r'url\("([^"]+)"\)', control_sheet(dark))
    assert paths
    for path in paths:
        assert resource(f"controls/{'dark' if dark else 'light'}/{path.rpartition('/')[2]}").is_file()


def test_images_are_up_to_date():
    draw_controls = runpy.run_path(str(ROOT / "scripts/draw_controls.py"))
    folder = draw_controls["FOLDER"]
    stored = {path.relative_to(folder).as_posix(): path.read_text() for path in folder.glob("*/*.svg")}
    assert stored == draw_controls["images"](), "run: python scripts/draw_controls.py"
