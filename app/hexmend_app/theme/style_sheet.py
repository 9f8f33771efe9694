"""Style sheet of all controls, from `resources/controls/controls.qss` and the colours of a theme."""

from __future__ import annotations

from functools import cache
from string import Template

from hexmend_app.resources import resource
from hexmend_app.theme import palette

#: Measures in pixels that the style sheet uses by name.
MEASURES = {"RADIUS": "4px"}


@cache
def control_sheet(dark: bool) -> str:
    """Return the style sheet in the dark or in the light theme."""
    folder = resource("controls")
    template = Template((folder / "controls.qss").read_text(encoding="utf-8"))
    images = (folder / ("dark" if dark else "light")).as_posix()
    return template.substitute(tokens(dark), images=images)


def tokens(dark: bool) -> dict[str, str]:
    """Return the colours and measures by the names that the style sheet uses."""
    colours = {name: role.of(dark) for name, role in vars(palette).items() if isinstance(role, palette.Role)}
    return {**MEASURES, **colours}
