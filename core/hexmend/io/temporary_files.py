"""Temporary files beside the file that they will replace: their names, their locks, and removing abandoned ones.

A name holds the host, a random number and the target: `.hexmend-3f0c9a1b2c3d4e5f6a7b-mesh.vtu`. The process that writes
a temporary file holds a lock (`flock`) on it, which the system releases when the process ends, however it ends. A
temporary file of this host without a lock is therefore abandoned. Where locks do not exist (Windows, some network file
systems), abandoned files stay.
"""

from __future__ import annotations

import errno
import os
import zlib
from contextlib import suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

_PREFIX = ".hexmend-"
#: Random bytes in a name.
_RANDOM = 8
#: The longest name of a file, in bytes, where the system does not say it.
_LONGEST = 255


class TemporaryFile:
    """A file beside `target` that only this writer uses.

    Parameters
    ----------
    target : Path
        The file that it will replace.

    Attributes
    ----------
    path : Path
        It ends with the suffix of the target.
    """

    def __init__(self, target: Path):
        self._target = target
        self._handle: int | None = None
        self.path = self._new_path()

    def create(self, mode: int | None) -> None:
        """Create the empty file and lock it; remove abandoned temporary files of the same target.

        Parameters
        ----------
        mode : int or None
            The permissions from the first byte on; those that the umask leaves if None.

        Raises
        ------
        OSError
            Where the folder cannot be written to.
        """
        remove_abandoned(self._target)
        while not self._create_locked(mode):
            self.path = self._new_path()

    def remove(self) -> None:
        """Remove the file if it is still there, and release its lock."""
        with suppress(OSError):
            self.path.unlink()
        self._close()

    def _new_path(self) -> Path:
        start, end = _name_parts(self._target)
        return self._target.with_name(f"{start}{os.urandom(_RANDOM).hex()}{end}")

    def _create_locked(self, mode: int | None) -> bool:
        """Return False if another process removed the file before it was locked."""
        flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
        self._handle = os.open(self.path, flags, 0o666 if mode is None else 0o600)
        if mode is not None and hasattr(os, "fchmod"):
            os.fchmod(self._handle, mode)
        if fcntl is None:  # an open file could not be renamed on Windows
            self._close()
            return True
        try:
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:  # another process has locked it in order to remove it
            self._close()
            return False
        except OSError:  # this file system has no locks, so nobody removes the file
            return True
        if os.fstat(self._handle).st_nlink:
            return True
        self._close()
        return False

    def _close(self) -> None:
        handle, self._handle = self._handle, None
        if handle is not None:
            os.close(handle)


def remove_abandoned(target: Path) -> None:
    """Remove temporary files of `target` whose writers have ended; errors are ignored.

    Parameters
    ----------
    target : Path
    """
    if fcntl is None:
        return
    start, end = _name_parts(target)
    length = len(start) + 2 * _RANDOM + len(end)
    with suppress(OSError):
        for name in os.listdir(target.parent):
            if name.startswith(start) and name.endswith(end) and len(name) == length:
                _remove_unlocked(target.with_name(name))


def _remove_unlocked(path: Path) -> None:
    with suppress(OSError):  # locked, gone, not ours, or on a file system without locks
        handle = os.open(path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.unlink()
        finally:
            os.close(handle)


def _name_parts(target: Path) -> tuple[str, str]:
    """What stands before and after the random number in the name of a temporary file.

    The host is part of it because a lock may be seen on its own host only. A long name of the target is replaced by
    its checksum and its suffix.
    """
    host = os.uname().nodename if hasattr(os, "uname") else os.environ.get("COMPUTERNAME", "")
    start = f"{_PREFIX}{zlib.crc32(host.encode()) & 0xFFFF:04x}"
    free = _longest_name(target.parent) - len(start) - 2 * _RANDOM - 1
    name = target.name
    if len(os.fsencode(name)) > free:
        name = f"{zlib.crc32(os.fsencode(name)):08x}{target.suffix}"
        if len(os.fsencode(name)) > free:
            name = name[:8]
    return start, f"-{name}"


def _longest_name(folder: Path) -> int:
    try:
        return os.pathconf(folder, "PC_NAME_MAX")
    except (AttributeError, OSError, ValueError):
        return _LONGEST


def flush_file(path: Path) -> None:
    """Wait until the content of a file is on the disk.

    Parameters
    ----------
    path : Path

    Raises
    ------
    OSError
        Where it cannot be written, for example because the disk is full.
    """
    handle = os.open(path, os.O_WRONLY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):  # a file system that cannot flush
            raise
    finally:
        os.close(handle)


def flush_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk, where the system can do that.

    Parameters
    ----------
    folder : Path
    """
    with suppress(OSError):  # Windows cannot open folders; a folder may be writable and not readable
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def make_folder(folder: Path) -> None:
    """Make a folder and those above it where they are missing, on the disk too.

    Parameters
    ----------
    folder : Path

    Raises
    ------
    OSError
        Where it cannot be made or is a file.
    """
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for one in missing:
        flush_folder(one.parent)
