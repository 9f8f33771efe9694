"""Messages for opening meshes and pictures."""

from __future__ import annotations

from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredMesh, RestoredPicture, RestoreProblem
from hexmend_app.state.tasks.mesh_opener import LoadProgress, LoadStage
from hexmend_app.state.view.side_views import MAX_SIDE_VIEWS


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
    }[progress.stage]


def restored_message(restored: RestoredPicture) -> tuple[str, ...]:
    """Return the message for meshes opened from a picture, with a title first if they differ from the picture."""
    name, picture, metadata = restored.path.name, restored.picture.name, restored.metadata
    others = _other_meshes(restored)
    if restored.digest not in (metadata.first.opened, metadata.first.shown):
        text = f"{name} has other hexes or node positions than the mesh in {picture}."
        return f"The mesh differs from {picture}", text + others
    text = f"{name} is shown with the camera and appearance of {picture}"
    if restored.digest == metadata.first.shown:
        text += "."
    elif metadata.recipe is not None:
        text += f", in which it was smoothed by “{metadata.recipe.title}”; see the Recipe panel."
    else:
        text += ", in which it was changed."
    if restored.path.suffix.lower() == SUFFIX:
        text += f" To restore its runs, open {name}."
    return (text + others,) if restored.matches else (f"Not all of {picture} was restored", text + others)


def _other_meshes(restored: RestoredPicture) -> str:
    """Describe the other meshes of a picture, as sentences with a leading space."""
    shown = [f"“{mesh.name}”" for mesh in restored.others if mesh.state is not None]
    names = " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))
    if restored.wipe_position is not None:
        layout = "is shown with a wipe"
    else:
        layout = f"{'are' if len(shown) > 1 else 'is'} shown next to it"
    sentences = [f"{names} {layout}."] if shown else []
    sentences += [_problem(mesh) for mesh in restored.others if mesh.problem is not None]
    return "".join(f" {sentence}" for sentence in sentences)


def _problem(mesh: RestoredMesh) -> str:
    """Explain why another mesh of a picture is not shown, or how it differs."""
    if mesh.problem is RestoreProblem.PLACES:
        return f"“{mesh.name}” differs from the picture: {mesh.file} has other node positions."
    reason = {
        RestoreProblem.NO_SPACE: f"the window shows at most {MAX_SIDE_VIEWS + 1} views",
        RestoreProblem.FILE: f"{mesh.file} was not found" if mesh.file else "the picture does not name its file",
        RestoreProblem.READING: str(mesh.error).rstrip("."),
        RestoreProblem.RUN: f"it is an iteration or a result of a run on {mesh.file}, which is not stored in that file",
        RestoreProblem.HEXES: f"{mesh.file} has other hexes; side views must have the hexes of the main view",
    }[mesh.problem]
    return f"“{mesh.name}” is not shown: {reason}."


def missing_mesh_message(missing: MissingMesh) -> tuple[str, str]:
    """Return title and text for a picture whose mesh file is missing."""
    file = missing.metadata.first.file
    reason = f"{file} is neither at its path nor next to the picture." if file else "The picture names no mesh file."
    return f"The mesh of {missing.picture.name} was not found", reason
