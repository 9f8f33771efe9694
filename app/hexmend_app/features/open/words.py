"""What is said while a mesh is opened."""

from __future__ import annotations

from hexmend_app.state.opener import Doing, Progress


def said(progress: Progress) -> str:
    """What is being done.

    >>> from pathlib import Path
    >>> said(Progress(Doing.MEASURING, Path("a/five.vtu"), 12345))
    'Measuring five.vtu, 12,345 hexes…'
    """
    name = progress.path.name
    return {
        Doing.READING: f"Reading {name}…",
        Doing.MEASURING: f"Measuring {name}, {progress.hexes:,} hexes…",
        Doing.PREPARING: f"Preparing the view of {name}…",
    }[progress.doing]
