"""Messages for opening meshes and pictures."""

from __future__ import annotations

from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredMesh, RestoredPicture, RestoreProblem
from hexmend_app.state.tasks.mesh_opener import LoadProgress, LoadStage
from hexmend_app.state.view.side_views import MAX_SIDE_VIEWS
from hexmend_app.translation import tr


def stage_text(progress: LoadProgress) -> str:
    """Describe the stage of loading.

    >>> from pathlib import Path
    >>> stage_text(LoadProgress(LoadStage.MEASURING, Path("a/five.vtu"), 12345))
    'Measuring five.vtu, 12,345 hexes…'
    >>> from hexmend.io.storage.file_progress import FileAction, FileProgress
    >>> file = FileProgress(Path("a/five.vtu"), FileAction.READING, 0.4, 2.0)
    >>> stage_text(LoadProgress(LoadStage.READING, file.path, file=file))
    'Reading five.vtu: 40%, 3 s left…'
    """
    name = progress.path.name
    if progress.file is not None and progress.file.share:
        return tr("Reading {name}: {done}…", name=name, done=progress.file.phrase)
    return {
        LoadStage.READING: tr("Reading {name}…", name=name),
        LoadStage.MEASURING: tr("Measuring {name}, {hexes:,} hexes…", name=name, hexes=progress.hexes),
        LoadStage.PREPARING: tr("Preparing the view of {name}…", name=name),
    }[progress.stage]


def restored_message(restored: RestoredPicture) -> tuple[str, ...]:
    """Return the message for meshes opened from a picture, with a title first if they differ from the picture."""
    name, picture, metadata = restored.path.name, restored.picture.name, restored.metadata
    others = _other_meshes(restored)
    if restored.digest not in (metadata.first.opened, metadata.first.shown):
        text = tr("{name} has other hexes or node positions than the mesh in {picture}.", name=name, picture=picture)
        return tr("The mesh differs from {picture}", picture=picture), text + others
    text = tr("{name} is shown with the camera and appearance of {picture}", name=name, picture=picture)
    if restored.digest == metadata.first.shown:
        text += "."
    elif metadata.recipe is not None:
        text += tr(", in which it was smoothed by “{title}”; see the Recipe panel.", title=metadata.recipe.title)
    else:
        text += tr(", in which it was changed.")
    if restored.path.suffix.lower() == SUFFIX:
        text += tr(" To restore its runs, open {name}.", name=name)
    return (
        (text + others,)
        if restored.matches
        else (tr("Part of {picture} was not restored", picture=picture), text + others)
    )


def _other_meshes(restored: RestoredPicture) -> str:
    """Describe the other meshes of a picture, as sentences with a leading space."""
    shown = [f"“{mesh.name}”" for mesh in restored.others if mesh.state is not None]
    names = " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))
    if restored.wipe_position is not None:
        layout = tr("is shown with a wipe")
    else:
        layout = tr("are shown next to it") if len(shown) > 1 else tr("is shown next to it")
    sentences = [f"{names} {layout}."] if shown else []
    sentences += [_problem(mesh) for mesh in restored.others if mesh.problem is not None]
    return "".join(f" {sentence}" for sentence in sentences)


def _problem(mesh: RestoredMesh) -> str:
    """Explain why another mesh of a picture is not shown, or how it differs."""
    reason = tr(mesh.problem, views=MAX_SIDE_VIEWS + 1, file=mesh.file, error=str(mesh.error).rstrip("."))
    if mesh.problem is RestoreProblem.PLACES:
        return tr("“{name}” differs from the picture: {reason}.", name=mesh.name, reason=reason)
    return tr("“{name}” is not shown: {reason}.", name=mesh.name, reason=reason)


def missing_mesh_message(missing: MissingMesh) -> tuple[str, str]:
    """Return title and text for a picture whose mesh file is missing."""
    file = missing.metadata.first.file
    reason = (
        tr("{file} is neither at its path nor next to the picture.", file=file)
        if file
        else tr("The picture does not contain the name of a mesh file.")
    )
    return tr("The mesh of {name} was not found", name=missing.picture.name), reason
