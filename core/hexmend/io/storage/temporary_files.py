"""Temporary files in the folder of the file that they will replace, and folders that appear complete or not at all.

Such a name is `.hexmend-3f0c5e6f9a1b2c3d.vtu`.
"""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

#: Longest suffix of a target, in characters, that its temporary files have too.
_LONGEST_SUFFIX = 16


def temporary_path(target: Path) -> Path:
    """Choose the name of a file beside a target, for its new or its old content.

    Parameters
    ----------
    target : Path
    """
    suffix = target.suffix if len(target.suffix) <= _LONGEST_SUFFIX else ""
    return target.with_name(f".hexmend-{os.urandom(8).hex()}{suffix}")


def create_file(path: Path, mode: int | None) -> None:
    """Create an empty temporary file.

    Parameters
    ----------
    path : Path
        As of `temporary_path`.
    mode : int or None
        Permissions; those of the umask if None.

    Raises
    ------
    OSError
        Where the folder is not writable.
    """
    with _opened(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666 if mode is None else 0o600) as handle:
        if mode is not None and hasattr(os, "fchmod"):
            os.fchmod(handle, mode)


@contextmanager
def _opened(path: Path, flags: int, mode: int = 0o777) -> Iterator[int]:
    """Context manager that opens a file, by its descriptor."""
    handle = os.open(path, flags, mode)
    try:
        yield handle
    finally:
        os.close(handle)


def flush_file(path: Path) -> None:
    """Wait until the content of a file is on the disk.

    Parameters
    ----------
    path : Path

    Raises
    ------
    OSError
        Where the file cannot be written, for example because the disk is full.
    """
    with _opened(path, os.O_WRONLY) as handle:
        try:
            _flush(handle)
        except OSError as error:
            if error.errno not in (errno.EINVAL, errno.ENOTSUP):  # a file system that cannot flush
                raise


def flush_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk, where the system supports it.

    Parameters
    ----------
    folder : Path
    """
    # Windows cannot open folders; a folder may be writable and not readable
    with suppress(OSError), _opened(folder, os.O_RDONLY) as handle:
        _flush(handle)


def _flush(handle: int) -> None:
    """Flush an open file; on macOS also the cache of the drive, which `os.fsync` does not flush there."""
    full = getattr(fcntl, "F_FULLFSYNC", None)
    if full is not None:
        with suppress(OSError):  # not on this file system
            fcntl.fcntl(handle, full)
            return
    os.fsync(handle)


def make_folder(folder: Path) -> None:
    """Make a folder and its missing parents, and wait until they are on the disk.

    Parameters
    ----------
    folder : Path

    Raises
    ------
    OSError
        Where the folder cannot be made or is a file.
    """
    missing = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for made in missing:
        flush_folder(made.parent)


@contextmanager
def temporary_folder(target: Path) -> Iterator[Path]:
    """Context manager that gives an empty folder beside `target`, and renames it to `target` at the end.

    If the block raises, the temporary folder is removed. The content is flushed to the disk before it is renamed.

    Parameters
    ----------
    target : Path
        It does not exist, or is an empty folder.

    Yields
    ------
    Path

    Raises
    ------
    OSError
        Where the folder cannot be made, or `target` is not empty.
    """
    temporary = target.with_name(f".hexmend-{os.urandom(8).hex()}-{target.name[:80]}")
    temporary.mkdir()
    try:
        yield temporary
        for folder, _, names in os.walk(temporary):
            for name in names:
                path = Path(folder, name)
                if path.is_file() and not path.is_symlink():
                    flush_file(path)
            flush_folder(Path(folder))
        os.replace(temporary, target)
        flush_folder(target.parent)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
