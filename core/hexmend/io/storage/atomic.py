"""Atomic replacement of a file, or of several that belong together: all of them, or none."""

from __future__ import annotations

import os
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.storage.temporary_files import create_file, flush_file, flush_folder, temporary_path
from hexmend.signal_guard import uninterrupted


@contextmanager
def atomic_write(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Context manager that gives a temporary file in the folder of `path`, and replaces `path` by it at the end.

    If the block raises, the temporary file is removed and the old file stays unchanged. The content is flushed to the
    disk before the file is renamed, and the folder before the block ends, so that a power cut leaves the old file or
    the new one. A new file gets the permissions of the user's umask; a replaced file keeps its own. Links are followed.
    A stream (/dev/stdout, a pipe of the shell) cannot be replaced and is written to directly.

    Parameters
    ----------
    path : path-like
        The file to replace.

    Yields
    ------
    Path
        An empty file with the same suffix, to be written in the block.

    Raises
    ------
    FileError
        Where the folder is missing or not writable, `path` is a folder, a named pipe, a link to itself or read-only,
        or the disk is full.
    """
    with atomic_files() as files:
        yield files.add(Path(path))


def check_writable(path: str | os.PathLike[str]) -> None:
    """Raise the `FileError` that `atomic_write` would raise, as far as it is known before writing."""
    path = Path(path)
    if not is_stream(path):
        writable_target(path)


def is_stream(path: Path) -> bool:
    """Return True for a stream, such as /dev/stdout or a pipe of the shell, which is written to and never replaced.

    Raises
    ------
    FileError
        For a named pipe: writing would wait until another program reads it.
    """
    if not path.exists() or path.is_file() or path.is_dir():
        return False
    if path.is_fifo() and not os.path.realpath(path).startswith(("/dev/", "/proc/")):
        raise FileError(path, "is a named pipe: expected the name of a file to write", "Choose another name.")
    return True


def writable_target(path: Path) -> tuple[Path, int | None]:
    """Resolve the links of a path that is to be replaced.

    Parameters
    ----------
    path : Path

    Returns
    -------
    target : Path
        The file.
    mode : int or None
        Its permissions; None where it does not exist.

    Raises
    ------
    FileError
        Where it cannot be replaced, as far as this is known before writing.
    """
    if path.is_dir():
        raise FileError(path, "is a folder: expected the name of a file to write", "Add a file name.")
    target = Path(os.path.realpath(path))
    folder = target.parent
    if target.is_symlink():
        raise FileError(path, "is a link to itself", "Remove it, or choose another name.")
    if not folder.is_dir():
        raise FileError(path, f"cannot be written: there is no folder {folder}", "Create the folder or choose another.")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FileError(path, f"cannot be written: no permission to write in {folder}", "Choose another folder.")
    if not target.exists():
        return target, None
    if not os.access(target, os.W_OK):
        raise FileError(path, "cannot be written: the file is read-only", "Make it writable or choose another name.")
    return target, stat.S_IMODE(target.stat().st_mode)


@dataclass(frozen=True)
class _Replacement:
    """File to be replaced, its temporary file, and its backup until all files are replaced."""

    path: Path
    target: Path
    temporary: Path
    backup: Path | None


class AtomicFiles:
    """Files that are replaced together; see `atomic_files`."""

    def __init__(self) -> None:
        self._replacements: list[_Replacement] = []
        self._named: dict[Path, Path] = {}  # path given by the user, by all that errors of the system may name
        self._needed: set[Path] = set()  # backups of files that could not be restored

    def add(self, path: Path) -> Path:
        """Add a file to be replaced, and return a temporary file with the same suffix, to be written.

        A file that was added before has the same temporary file again.

        Parameters
        ----------
        path : Path

        Raises
        ------
        FileError
            Where the file cannot be replaced, see `atomic_write`.
        """
        if is_stream(path):
            self._named[path] = path
            return path
        target, mode = writable_target(path)
        for one in self._replacements:
            if one.target == target:
                return one.temporary
        temporary, backup = temporary_path(target), None if mode is None else temporary_path(target)
        self._replacements.append(_Replacement(path, target, temporary, backup))  # to be removed if creation fails
        with _named(path):
            create_file(temporary, mode)
        self._named |= dict.fromkeys((path, target, temporary), path)
        return temporary

    def commit(self) -> None:
        """Replace all files, those that were added first last.

        Raises
        ------
        FileError
            If one of them cannot be replaced; those that were replaced before it have their old content again.
        """
        for one in self._replacements:
            with _named(one.path):
                flush_file(one.temporary)
        if len(self._replacements) > 1:
            for one in self._replacements:
                with _named(one.path):
                    _keep(one)
        self._replace()
        for folder in dict.fromkeys(one.target.parent for one in self._replacements):
            flush_folder(folder)

    @uninterrupted
    def _replace(self) -> None:
        done: list[_Replacement] = []
        for one in reversed(self._replacements):
            try:
                os.replace(one.temporary, one.target)
            except OSError as error:
                problem = f"cannot be replaced: {error.strerror or error}{self._restore(done)}"
                raise FileError(
                    one.path, problem, "Check free space and permissions, or choose another folder."
                ) from None
            done.append(one)

    def _restore(self, done: list[_Replacement]) -> str:
        """Restore the old files; returns words about them for a message, "" if there are none.

        The old content of a file that cannot be restored stays in its backup, which the message names.
        """
        kept, names = [], [one.path.name for one in done]
        for one in reversed(done):
            try:
                if one.backup is None:
                    one.target.unlink()
                else:
                    os.replace(one.backup, one.target)
            except OSError:
                if one.backup is None:
                    kept.append(f"{one.path.name} stays as a new file")
                else:
                    self._needed.add(one.backup)
                    kept.append(f"{one.path.name} cannot be restored: its old content is in {one.backup}")
        if kept:
            return f", and {', and '.join(kept)}"
        return f"; {', '.join(names)} {'is' if len(names) == 1 else 'are'} as before" if names else ""

    def path_of(self, error: OSError) -> Path | None:
        """Return the path that an error is about: the first where the error names none, None for another file's."""
        names = [name for name in (error.filename, error.filename2) if name is not None]  # both of one that is copied
        if not names:
            return next(iter(self._named.values()), None)
        return next((self._named[Path(name)] for name in names if Path(name) in self._named), None)

    @uninterrupted
    def remove(self) -> None:
        """Remove the temporary files that are left, but for backups of files that could not be restored."""
        for path in (path for one in self._replacements for path in (one.temporary, one.backup)):
            if path is not None and path not in self._needed:
                with suppress(OSError):
                    path.unlink()


@contextmanager
def atomic_files() -> Iterator[AtomicFiles]:
    """Context manager that replaces files at its end, all of them or none.

    All new files are on the disk before the first is renamed. If the block raises, or a file cannot be replaced, all
    old files are there as before.

    Yields
    ------
    AtomicFiles

    Raises
    ------
    FileError
        Where a file cannot be written.
    """
    files = AtomicFiles()
    try:
        yield files
        files.commit()
    except OSError as error:
        path = files.path_of(error)
        if path is None:
            raise  # of another file, which the block uses
        with _named(path):
            raise
    finally:
        files.remove()


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Context manager in which errors of the system become errors of a file."""
    try:
        yield
    except OSError as error:
        problem = f"cannot be written: {error.strerror or error}"
        raise FileError(path, problem, "Check free space and permissions, or choose another folder.") from None


def _keep(one: _Replacement) -> None:
    """Keep the old content of a file: by another name where the file system has links, else in a copy."""
    if one.backup is None:
        return
    try:
        os.link(one.target, one.backup)
    except OSError:
        shutil.copy2(one.target, one.backup)
