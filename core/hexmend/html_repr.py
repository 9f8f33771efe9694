"""How values show themselves in notebooks: floors above know how, and are asked only where there is a notebook."""

from __future__ import annotations

from importlib import import_module


def html_of(value: object) -> str:
    """A value as a notebook shows it: see `hexmend.notebook`."""
    return import_module("hexmend.notebook").html(value)
