"""What is said while a mesh is opened, and of pictures."""

from __future__ import annotations

from hexmend_app.state.opener import Doing, Progress, Restored, Wanting


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


def alike(restored: Restored) -> bool:
    """Whether a mesh is the one that a picture shows, be it before what ran on it."""
    return restored.digest in (restored.carried.first.opened, restored.carried.first.shown)


def of_picture(restored: Restored) -> tuple[str, ...]:
    """What is said of the mesh that was opened from a picture: of another than it shows, a title first."""
    name, picture, carried = restored.path.name, restored.picture.name, restored.carried
    several = f" It shows {len(carried.meshes)} meshes, of which this is one." if len(carried.meshes) > 1 else ""
    if not alike(restored):
        text = f"{name} has other hexes, or nodes elsewhere, than the mesh that {picture} was made of.{several}"
        return f"This is not the mesh of {picture}", text
    if restored.digest == carried.first.shown:
        return (f"{name} is looked at as in {picture}.{several}",)
    ran = f" after “{carried.recipe.title}”, which is in the Recipe panel" if carried.recipe is not None else " changed"
    return (f"{name} is looked at as in {picture}, which shows it{ran}.{several}",)


def lost(wanting: Wanting) -> tuple[str, str]:
    """What is said of a picture whose mesh is not found."""
    file = wanting.carried.first.file
    where = f"{file} is not there, nor is it beside the picture." if file else "The picture does not say which file."
    return f"Where is the mesh of {wanting.picture.name}?", where
