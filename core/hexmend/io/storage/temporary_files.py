"""Temporary files in the folder of the file that they will replace, with locks, and removal of abandoned ones.

The name consists of the host, a random number and the target: `.hexmend-3f0c9a1b2c3d4e5f6a7b-mesh.vtu`. An empty file,
`.hexmend-lock-3f0c9a1b2c3d4e5f6a7b-mesh.vtu`, is created before it and removed after it. The writing process holds a
lock (`flock`) on this empty file, which the system releases however the process ends. (The lock is not on the temporary
file itself because libraries such as HDF5 lock the files that they write.) Temporary files of this host whose lock is
free are therefore abandoned. On Windows and some network file systems, which have no locks, abandoned files stay.
"""

from __future__ import annotations

import errno
import os
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from hexmend.signal_guard import uninterrupted

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

_PREFIX = ".hexmend-"
_LOCK_PREFIX = ".hexmend-lock-"
#: Random bytes in a name.
_RANDOM = 8
#: Longest name of a file in bytes, where the system does not tell it.
_LONGEST = 255


class TemporaryFile:
    """Temporary file in the folder of `target` that only this writer uses.

    Parameters
    ----------
    target : Path
        The file that it will replace.

    Attributes
    ----------
    path : Path
        Ends with the suffix of the target.
    lock_path : Path
        The empty file that is locked.
    """

    def __init__(self, target: Path):
        self._target = target
        self._lock: int | None = None
        self._released = False
        self._choose_name()

    def create(self, mode: int | None) -> None:
        """Create the empty file and the lock, and remove abandoned temporary files of the same target.

        Parameters
        ----------
        mode : int or None
            Permissions; those of the umask if None.

        Raises
        ------
        OSError
            Where the folder is not writable.
        """
        if fcntl is not None:
            remove_abandoned(self._target)
            while not self._create_lock():
                self._choose_name()
        flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
        with _opened(self.path, flags, 0o666 if mode is None else 0o600) as handle:
            if mode is not None and hasattr(os, "fchmod"):
                os.fchmod(handle, mode)

    @uninterrupted
    def remove(self) -> None:
        """Remove the file if it is still there, and then the lock; not after `release`."""
        for path in (self.lock_path,) if self._released else (self.path, self.lock_path):
            with suppress(OSError):
                path.unlink()
        self._close()

    def release(self) -> None:
        """Let the file stay when `remove` is called; without its lock it never counts as abandoned."""
        self._released = True

    def _choose_name(self) -> None:
        middle, end = os.urandom(_RANDOM).hex(), _name_end(self._target)
        self.path = self._target.with_name(f"{_PREFIX}{_host()}{middle}{end}")
        self.lock_path = self._target.with_name(f"{_LOCK_PREFIX}{_host()}{middle}{end}")

    def _create_lock(self) -> bool:
        """Return False if another process removed the file before it was locked."""
        self._lock = os.open(self.lock_path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:  # another process has locked it in order to remove it
            self._close()
            return False
        except OSError:  # this file system has no locks, so nobody removes the file
            return True
        if os.fstat(self._lock).st_nlink:
            return True
        self._close()
        return False

    def _close(self) -> None:
        handle, self._lock = self._lock, None
        if handle is not None:
            os.close(handle)


@contextmanager
def _opened(path: Path, flags: int, mode: int = 0o777) -> Iterator[int]:
    """Context manager that opens a file, by its descriptor."""
    handle = os.open(path, flags, mode)
    try:
        yield handle
    finally:
        os.close(handle)


def remove_abandoned(target: Path) -> None:
    """Remove temporary files of `target` whose writers have ended; errors are ignored.

    Parameters
    ----------
    target : Path
    """
    if fcntl is None:
        return
    start, end = f"{_LOCK_PREFIX}{_host()}", _name_end(target)
    length = len(start) + 2 * _RANDOM + len(end)
    with suppress(OSError):
        for name in os.listdir(target.parent):
            if name.startswith(start) and name.endswith(end) and len(name) == length:
                data = f"{_PREFIX}{name.removeprefix(_LOCK_PREFIX)}"
                _remove_unlocked(target.with_name(name), target.with_name(data))


def _remove_unlocked(lock: Path, data: Path) -> None:
    flags = os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK
    with suppress(OSError), _opened(lock, flags) as handle:  # locked, gone, not ours, or without locks
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        data.unlink(missing_ok=True)
        lock.unlink()


def _host() -> str:
    """Checksum of the host's name in four characters; a lock may be visible on its own host only."""
    name = os.uname().nodename if hasattr(os, "uname") else os.environ.get("COMPUTERNAME", "")
    return f"{zlib.crc32(name.encode()) & 0xFFFF:04x}"


def _name_end(target: Path) -> str:
    """End of the names of temporary files, behind the random number.

    A long name of the target is replaced by its checksum and its suffix.
    """
    free = _longest_name(target.parent) - len(f"{_LOCK_PREFIX}{_host()}") - 2 * _RANDOM - 1
    name = target.name
    if len(os.fsencode(name)) > free:
        name = f"{zlib.crc32(os.fsencode(name)):08x}{target.suffix}"
        if len(os.fsencode(name)) > free:
            name = name[:8]
    return f"-{name}"


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
