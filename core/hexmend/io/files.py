"""Reading and writing of mesh files; the format follows from suffix and content."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from hexmend.errors import FileError, MeshError
from hexmend.io.base.capabilities import required_capabilities
from hexmend.io.base.content import INTERPOLATE_MISSING
from hexmend.io.base.format import Format
from hexmend.io.base.remedies import unread_content
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.replacement import (
    REWRITE,
    ChangedFileError,
    IncludedFileError,
    LostContentError,
    Original,
    Written,
    difference,
    is_same_file,
    replace_coordinates,
)
from hexmend.io.format_lookup import (
    OTHER_FORMAT,
    check_has_mesh,
    every_format,
    format_by_place,
    format_of,
    suffixes_of,
    writable_format,
)
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.io.storage.file_progress import FileAction, file_operation, report, stage
from hexmend.io.storage.readable import check_readable, reading
from hexmend.kernels import return_freed_arrays
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation

#: Share of the time to read a mesh that its format takes; then its orientation is checked.
_FORMATS_SHARE = 0.7
#: Bytes of a file from which on its mesh is large: arrays that are freed are returned to the system.
_LARGE_FILE = 1 << 24


def read(path: str | os.PathLike[str], *, as_is: bool = False, interpolate_missing: bool = False) -> Mesh:
    """Read a hexahedral mesh.

    Parameters
    ----------
    path : path-like
        A file of any format in `FORMATS`; the content decides where the suffix is unknown or misleading. For OpenFOAM
        also the folder of a case.
    as_is : bool
        Keep hexes that are numbered left-handed; else they are renumbered.
    interpolate_missing : bool
        Place nodes without finite coordinates between their neighbours; else they are an error.

    Returns
    -------
    Mesh
        Named after the file's stem or the case. The order of nodes and hexes, data, sets, fixed nodes and other cells
        are kept. Its `notes` list the changes made on reading.

    Raises
    ------
    FileError
        Where the file cannot be read as a mesh: it names the location in the file and a remedy.
    """
    path = Path(path)
    if path.is_dir() or format_by_place(path):
        check_has_mesh(path)
    if format_by_place(path) is None:
        check_readable(path, "a mesh file or the folder of an OpenFOAM case")
    format = format_of(path)
    if path.is_file() and path.stat().st_size >= _LARGE_FILE:
        return_freed_arrays()
    token = INTERPOLATE_MISSING.set(interpolate_missing)
    try:
        with reading(path, "Close other programs or use a larger machine."), file_operation(path, FileAction.READING):
            with stage(0.0, _FORMATS_SHARE):
                mesh = format.read(path)
            mesh = mesh if format.place else mesh.replace(name=path.stem)
            with stage(_FORMATS_SHARE, 1.0):
                return mesh if as_is else with_consistent_orientation(mesh, report)
    except MeshError as error:
        raise FileError(path, str(error), _REMEDY["finite" in str(error)]) from None
    finally:
        INTERPOLATE_MISSING.reset(token)


def write(
    path: str | os.PathLike[str],
    mesh: Mesh,
    *,
    encoding: str | None = None,
    like: str | os.PathLike[str] | Original | None = None,
) -> None:
    """Write a mesh; if that fails, an earlier file stays unchanged.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; one of `writable_suffixes()`.
    mesh : Mesh
        Data that the format cannot store are left out; see `unsupported_data`.
    encoding : str, optional
        One of the format's `encodings`; the first one if None.
    like : path-like or Original, optional
        File of the same format with the same hexes, whose coordinates are replaced in the copy that is written; all
        else in it is kept.

    Raises
    ------
    FileError
        For an unknown suffix or encoding, where the file cannot be written, and for a mesh that differs from that of
        `like` in more than its coordinates.
    TypeError
        Where `mesh` is no mesh.
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(
            f"write(path, mesh) was given {type(path).__name__} and {type(mesh).__name__}: expected a "
            "path, then a hexmend.Mesh, such as result.mesh"
        )
    path = Path(path)
    if like is None:
        _write_anew(path, mesh, encoding, writable_format(path))
        return
    with file_operation(path, FileAction.WRITING):
        if not isinstance(like, Original):
            given = read(like, as_is=True)
            turned = with_consistent_orientation(given)
            like = Original(Path(like), turned if difference(given, mesh, ()) else given)
        if not replaces_coordinates(path, like):
            problem = f"cannot be written like {like.path.name}: its format is another, or keeps nothing else"
            raise FileError(path, problem, "Write it without the argument like.")
        check_not_included(path, like.path)
        try:
            replace_coordinates(path, mesh, like, format_of(like.path))
        except CoordinatesError as error:
            raise FileError(path, f"cannot be written: {error}", "Write it without the argument like.") from None


def _write_anew(path: Path, mesh: Mesh, encoding: str | None, format: Format) -> None:
    write = format.write
    if write is None:
        raise FileError(path, "is a copy of a deck: it can have other coordinates only", OTHER_FORMAT)
    encoding = format.encodings[0] if encoding is None else encoding
    if encoding not in format.encodings:
        problem = f"{format.title} has no encoding {encoding!r}"
        raise FileError(path, problem, f"Use one of {', '.join(format.encodings)}.")
    with file_operation(path, FileAction.WRITING):
        if format.place or format.remove:  # it writes several files, each as a whole
            write(path, mesh, encoding)
            return
        with atomic_write(path) as temporary:
            try:
                write(temporary, mesh, encoding)
            except FileError as error:  # it names the temporary file
                raise FileError(path, error.problem, error.remedy) from None


def replaces_coordinates(path: str | os.PathLike[str], original: Original | None) -> bool:
    """Return True if a mesh is written by replacing coordinates in a copy of its file, whose format `path` has.

    Parameters
    ----------
    path : path-like
    original : Original or None

    Raises
    ------
    FileError
        For an unknown suffix, and for a folder that cannot take the mesh.
    """
    if original is None or not (original.path.is_file() or format_by_place(original.path)):
        return False
    format = writable_format(Path(path), original.path)
    if format.locate is None or format_of(original.path) is not format:
        return False
    if format.place:
        format.place.check_target(Path(path), original.mesh, original.path)
    return True


def write_as_given(path: str | os.PathLike[str], mesh: Mesh, original: Original | None) -> Written:
    """Write a mesh by replacing coordinates in a copy of its file where that has the same format, else anew.

    Parameters
    ----------
    path : path-like
    mesh : Mesh
    original : Original or None
        File of the mesh, and the mesh as read from it; None to write anew.

    Returns
    -------
    Written
        Tells which of both was done, and why a file was written anew although it has the format of the original.

    Raises
    ------
    FileError
        Where the file cannot be written; where `path` is the original file and that has changed since it was read, or
        has content that a file written anew would not have; or where it is a file that the original includes.
    """
    path = Path(path)
    if original is not None:
        check_not_included(path, original.path)
    with file_operation(path, FileAction.WRITING):
        reason: tuple[str, ...] = ()
        if original is not None and replaces_coordinates(path, original):
            try:
                return replace_coordinates(path, mesh, original, format_of(original.path))
            except CoordinatesError as error:
                if not format_of(original.path).write:
                    raise FileError(path, f"cannot be written: {error}", OTHER_FORMAT) from None
                _check_content(path, original, str(error))
                reason = (_anew(str(error), original),)
            except ChangedFileError as error:
                if is_same_file(path, original.path) or not format_of(original.path).write:
                    raise
                reason = (_anew(f"{error.path.name} {error.problem}", original),)
        elif original is not None and is_same_file(path, original.path):
            _check_content(path, original, "coordinates alone are never replaced in its format")
        elif original is not None and not original.path.exists() and path.suffix == original.path.suffix:
            reason = (_anew(f"{original.path.name} does not exist any more", original),)
        _write_anew(path, mesh, None, writable_format(path, None if original is None else original.path))
    return Written(False, reason)


def check_not_included(path: str | os.PathLike[str], source: str | os.PathLike[str]) -> None:
    """Check that a file to write is none that the mesh's own file includes, and that it does not include that one.

    Parameters
    ----------
    path : path-like
        File to write.
    source : path-like
        File of the mesh.

    Raises
    ------
    FileError
        For a file that `source` includes: it would no longer have what `source` needs. For a file that includes
        `source`, as one of several files: it would have the mesh of this one alone.
    """
    path, source = Path(path), Path(source)
    if not (path.is_file() and source.is_file()) or is_same_file(path, source):
        return
    if _includes(format_of(source), source, path):
        raise IncludedFileError(path, f"is included by {source.name}", "Choose another name.")
    if _includes(writable_format(path, source), path, source):
        raise IncludedFileError(path, f"includes {source.name}, the given mesh", "Choose another name.")


def _includes(format: Format, path: Path, other: Path) -> bool:
    return format.included is not None and any(is_same_file(other, one) for one in format.included(path))


def _check_content(path: Path, original: Original, reason: str) -> None:
    """Raise `LostContentError` where a file is to be written anew in place of an original with more than the mesh."""
    lost = _lost_content(original)
    if lost and is_same_file(path, original.path):
        problem = f"would lose data other than the mesh: {'; '.join(lost)}. It has to be rewritten, as {reason}"
        raise LostContentError(path, problem, REWRITE)


def _lost_content(original: Original) -> list[str]:
    """Content of the original file that a file written anew does not have, besides comments."""
    return [*unread_content(original.mesh.notes), *(["periodic pairs"] if original.mesh.periodic_pairs else [])]


def _anew(reason: str, original: Original) -> str:
    """Sentences for a file that was written anew although it has the format of the original."""
    lost = "; ".join([*_lost_content(original), "comments"])
    return f"The file is rewritten: {reason}. Lost data of the original, other than the mesh: {lost}."


def writer_for(
    path: str | os.PathLike[str], source: str | os.PathLike[str] | None = None
) -> Callable[[str | os.PathLike[str], Mesh], None]:
    """Return `write` after a check of suffix and folder, so that errors are found before a long run.

    Parameters
    ----------
    path : path-like
    source : path-like, optional
        File that the mesh is read from; a case is written as a case where the suffix chooses nothing.

    Returns
    -------
    callable
        `write`

    Raises
    ------
    FileError
        For an unknown suffix, and where the file cannot be written.
    """
    path = Path(path)
    format = writable_format(path, Path(source) if source else None)
    if not format.place:
        check_writable(path)
    return write


def remove(path: str | os.PathLike[str]) -> None:
    """Remove a mesh file that Hexmend has written, with the other files that it names."""
    path = Path(path)
    own = writable_format(path).remove
    if own is None:
        path.unlink(missing_ok=True)
    else:
        own(path)


def unsupported_data(
    path: str | os.PathLike[str], mesh: Mesh, source: str | os.PathLike[str] | None = None
) -> list[str]:
    """Describe the data of a mesh that are lost if it is written to a file.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; the file need not exist.
    mesh : Mesh
    source : path-like, optional
        As of `writer_for`.

    Returns
    -------
    list of str
        Phrases for a message, such as "node sets (inlet)"; empty if the file holds everything.

    Raises
    ------
    FileError
        For an unknown suffix, and for a folder that cannot take the mesh.
    """
    format = writable_format(Path(path), Path(source) if source else None)
    if format.place:
        format.place.check_target(Path(path), mesh, None)
    required = required_capabilities(mesh, format.stored_names)
    missing = [description for kind, description in required.items() if kind not in format.capabilities]
    if mesh.periodic_pairs and not format.place:  # boundaries of a case alone have partners
        missing.append(f"periodic pairs ({', '.join(' with '.join(pair) for pair in mesh.periodic_pairs)})")
    return missing + (format.limitations(mesh) if format.limitations else [])


def readable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `read` knows, with the dot."""
    return suffixes_of(every_format())


def writable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `write` knows, with the dot."""
    return suffixes_of(format for format in every_format() if format.write)


#: Remedies for an invalid mesh: False in general, True for coordinates that are not finite.
_REMEDY = {
    False: "Correct the file, or write it again with the program that made it.",
    True: "Correct the file, or let hexmend repair put such nodes between their neighbours.",
}
