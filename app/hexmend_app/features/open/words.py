"""What is said while a mesh is opened, and of pictures."""

from __future__ import annotations

from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.opener import Doing, Progress
from hexmend_app.state.restoring import Beside, Lack, Restored, Wanting
from hexmend_app.state.views import MOST


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


def of_picture(restored: Restored) -> tuple[str, ...]:
    """What is said of meshes that were opened from a picture: of others than it shows, a title first."""
    name, picture, carried = restored.path.name, restored.picture.name, restored.carried
    if restored.digest not in (carried.first.opened, carried.first.shown):
        text = f"{name} has other hexes, or nodes elsewhere, than the mesh that {picture} was made of."
        return f"This is not the mesh of {picture}", text + _beside(restored)
    if restored.digest == carried.first.shown:
        seen = f"{name} is looked at as in {picture}."
    else:
        ran = (
            f"after “{carried.recipe.title}”, which is in the Recipe panel" if carried.recipe is not None else "changed"
        )
        seen = f"{name} is looked at as in {picture}, which shows it {ran}."
    if restored.path.suffix.lower() == SUFFIX:
        seen += f" Its runs are not: open {name} itself for them."
    text = seen + _beside(restored)
    return (text,) if restored.alike else (f"This is not all that {picture} shows", text)


def _beside(restored: Restored) -> str:
    """What is said of the other meshes of a picture, after what is said of the first."""
    shown = [f"“{one.name}”" for one in restored.others if one.state is not None]
    names = " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))
    how = "is wiped over it" if restored.wiped is not None else "stands beside it"
    if len(shown) > 1:
        how = "stand beside it"
    found = [f"{names} {how}."] if shown else []
    found += [_lacking(one) for one in restored.others if one.lack is not None]
    return "".join(f" {sentence}" for sentence in found)


def _lacking(one: Beside) -> str:
    """Why another mesh of a picture is not shown, or in what it is another."""
    if one.lack is Lack.PLACES:
        return f"“{one.name}” is another than in the picture: {one.file} has its nodes elsewhere."
    why = {
        Lack.ROOM: f"the window has room for {MOST + 1} views",
        Lack.FILE: f"{one.file} is not there" if one.file else "the picture does not say in which file it is",
        Lack.READING: str(one.error).rstrip("."),
        Lack.RUN: f"it is an iteration, or a result, of a run on {one.file}, which the file alone does not give",
        Lack.HEXES: f"{one.file} has other hexes, and views beside are of one mesh",
    }[one.lack]
    return f"“{one.name}” is not shown: {why}."


def lost(wanting: Wanting) -> tuple[str, str]:
    """What is said of a picture whose mesh is not found."""
    file = wanting.carried.first.file
    where = f"{file} is not there, nor is it beside the picture." if file else "The picture does not say which file."
    return f"Where is the mesh of {wanting.picture.name}?", where
