"""Atomic replacement of files."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.storage.temporary_files import TemporaryFile, flush_file, flush_folder


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
    path = Path(path)
    temporary: TemporaryFile | None = None
    try:
        if is_stream(path):
            yield path
            return
        target, mode = writable_target(path)
        temporary = TemporaryFile(target)
        temporary.create(mode)
        yield temporary.path
        flush_file(temporary.path)
        os.replace(temporary.path, target)
        flush_folder(target.parent)
    except OSError as error:
        own = (path,) if temporary is None else (path, temporary.path, temporary.lock_path)
        if error.filename is not None and Path(error.filename) not in own:
            raise  # of another file, which the block uses
        problem = f"cannot be written: {error.strerror or error}"
        raise FileError(path, problem, "Check free space and permissions, or choose another folder.") from None
    finally:
        if temporary is not None:
            temporary.remove()


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
