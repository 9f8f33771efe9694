"""HTML of values for notebooks."""

from __future__ import annotations

from hexmend.hooks import hook


def html_of(value: object) -> str:
    """Return the HTML that a notebook shows for a value; see `hexmend.notebook`."""
    return hook("html")(value)
