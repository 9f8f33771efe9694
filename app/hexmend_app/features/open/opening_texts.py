"""Messages for opening meshes and pictures."""

from __future__ import annotations

from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredMesh, RestoredPicture, RestoreProblem
from hexmend_app.state.tasks.mesh_opener import LoadProgress, LoadStage
from hexmend_app.state.view.side_views import MOST


def stage_text(progress: LoadProgress) -> str:
    """Describe the stage of loading.

    >>> from pathlib import Path
    >>> stage_text(LoadProgress(LoadStage.MEASURING, Path("a/five.vtu"), 12345))
    'Measuring five.vtu, 12,345 hexes…'
    """
    name = progress.path.name
    return {
        LoadStage.READING: f"Reading {name}…",
        LoadStage.MEASURING: f"Measuring {name}, {progress.hexes:,} hexes…",
        LoadStage.PREPARING: f"Preparing the view of {name}…",
    }[progress.doing]


def of_picture(restored: RestoredPicture) -> tuple[str, ...]:
    """Return the message for meshes opened from a picture, with a title first if they differ from the picture."""
    name, picture, metadata = restored.path.name, restored.picture.name, restored.metadata
    if restored.digest not in (metadata.first.opened, metadata.first.shown):
        text = f"{name} has other hexes, or nodes elsewhere, than the mesh that {picture} was made of."
        return f"This is not the mesh of {picture}", text + _neighbour(restored)
    if restored.digest == metadata.first.shown:
        seen = f"{name} is looked at as in {picture}."
    else:
        ran = (
            f"after “{metadata.recipe.title}”, which is in the Recipe panel"
            if metadata.recipe is not None
            else "changed"
        )
        seen = f"{name} is looked at as in {picture}, which shows it {ran}."
    if restored.path.suffix.lower() == SUFFIX:
        seen += f" Its runs are not: open {name} itself for them."
    text = seen + _neighbour(restored)
    return (text,) if restored.alike else (f"This is not all that {picture} shows", text)


def _neighbour(restored: RestoredPicture) -> str:
    """Return the sentences on the other meshes of a picture."""
    shown = [f"“{one.name}”" for one in restored.others if one.state is not None]
    names = " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))
    if restored.wiped is not None:
        layout = "is wiped over it"
    else:
        layout = f"{'are' if len(shown) > 1 else 'is'} shown next to it"
    found = [f"{names} {layout}."] if shown else []
    found += [_lacking(one) for one in restored.others if one.lack is not None]
    return "".join(f" {sentence}" for sentence in found)


def _lacking(one: RestoredMesh) -> str:
    """Explain why a further mesh of a picture is not shown, or how it differs."""
    if one.lack is RestoreProblem.PLACES:
        return f"“{one.name}” is another than in the picture: {one.file} has its nodes elsewhere."
    reason = {
        RestoreProblem.NO_SPACE: f"the window shows at most {MOST + 1} views",
        RestoreProblem.FILE: f"{one.file} is not there" if one.file else "the picture does not say in which file it is",
        RestoreProblem.READING: str(one.error).rstrip("."),
        RestoreProblem.RUN: f"it is an iteration or a result of a run on {one.file}, which that file does not hold",
        RestoreProblem.HEXES: f"{one.file} has other hexes, and side views show one mesh",
    }[one.lack]
    return f"“{one.name}” is not shown: {reason}."


def lost(wanting: MissingMesh) -> tuple[str, str]:
    """Return title and text for a picture whose mesh file is missing."""
    file = wanting.metadata.first.file
    where = (
        f"{file} was not found, neither at its path nor next to the picture."
        if file
        else "The picture does not name its mesh file."
    )
    return f"Where is the mesh of {wanting.picture.name}?", where
