"""Reading in a subprocess: a library that crashes or hangs on a damaged file does not take Hexmend with it."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from time import monotonic
from typing import IO, Any, NamedTuple

from hexmend.errors import FileError
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.storage.file_progress import FileAction, FileProgress, file_operation, report, stage, watch_files
from hexmend.terminal_text import printable

#: Time limit of a reader in seconds, and further seconds for each megabyte of the file.
SECONDS, SECONDS_PER_MB = 60.0, 0.5
#: Memory limit of a reader in bytes, and further bytes for each byte of the file.
MEMORY, MEMORY_PER_BYTE = 4 << 30, 64

#: Share of the work that the subprocess has, and seconds between looks at its progress.
_CHILDS_SHARE, _POLL = 0.7, 0.1


def run_reader(reader: str, path: Path) -> Any:
    """Call the function that reads a file in a subprocess.

    Parameters
    ----------
    reader : str
        "module:function"; the function takes the path and returns what can be sent to another process.
    path : Path

    Returns
    -------
    object
        What the function returns.

    Raises
    ------
    FileError
        From the function, and where the process crashes or takes too long.
    """
    size = os.path.getsize(path)
    with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
        answer, log = Path(folder) / "answer", Path(folder) / "stderr"
        program = f"import sys; sys.path[:] = sys.argv[4:]; from {__name__} import main; main(*sys.argv[1:4])"
        limit = SECONDS + SECONDS_PER_MB * size / 1e6
        try:
            with open(log, "wb") as errors, stage(0.0, _CHILDS_SHARE):
                command = [sys.executable, "-c", program, reader, str(path.absolute()), str(answer), *sys.path]
                null = subprocess.DEVNULL
                with subprocess.Popen(command, stdin=null, stdout=null, stderr=errors) as process:
                    _wait(process, limit, answer)
        except subprocess.TimeoutExpired:
            raise FileError(path, f"is not read within {limit:.0f} seconds", DAMAGED) from None
        if process.returncode == 1:  # an unexpected exception
            with open(log, "rb") as errors:
                reason = last_line(errors)
            raise FileError(path, f"its reader fails ({reason})", "Write the file again, and report this.")
        if process.returncode or not answer.exists():
            raise FileError(path, "ends the library that reads it", DAMAGED)
        with open(answer, "rb") as file, stage(_CHILDS_SHARE, 1.0):
            result = pickle.load(file)  # of our own process, which has no other rights than this one
    if isinstance(result, Failure):
        raise FileError(path, result.problem, result.remedy)
    return result


class Failure(NamedTuple):
    """Answer of a subprocess that could not read the file."""

    problem: str
    remedy: str


def _wait(process: subprocess.Popen, limit: float, answer: Path) -> None:
    """Wait for the subprocess and report its progress; it is killed after so many seconds, and on any exception."""
    try:
        if wait_for(process, limit, _POLL, lambda: report(_stored_share(_share_file(answer)))):
            raise subprocess.TimeoutExpired(process.args, limit)
    except BaseException:
        process.kill()
        raise


def wait_for(process: subprocess.Popen, seconds: float, interval: float, watch: Callable[[], object]) -> bool | None:
    """Wait for the end of a process, and call `watch` at intervals meanwhile.

    Parameters
    ----------
    process : Popen
    seconds, interval : float
        Time limit, and seconds between two calls.
    watch : callable
        A true result ends the waiting.

    Returns
    -------
    bool or None
        False if the process has ended, True if it is out of time, None if `watch` ended the waiting.
    """
    end = monotonic() + seconds
    while True:
        try:
            process.wait(min(interval, max(0.0, end - monotonic())))
            return False
        except subprocess.TimeoutExpired:
            if watch():
                return None
            if monotonic() >= end:
                return True


def _stored_share(path: Path) -> float:
    """Share that the subprocess has stored; 0 as long as there is none, or while it is being written."""
    try:
        return float(path.read_bytes())
    except (OSError, ValueError):
        return 0.0


def _share_file(answer: Path) -> Path:
    """File in which the subprocess stores the share that it has done, as text."""
    return answer.with_name("share")


def main(reader: str, path: str, answer: str) -> None:
    """Entry point of the subprocess: read the file and write the answer, a pickled one."""
    limit_memory("RLIMIT_AS", MEMORY + MEMORY_PER_BYTE * os.path.getsize(path))
    limit_memory("RLIMIT_CORE", 0)
    module, _, function = reader.partition(":")
    result: object
    try:
        with _stored_progress(Path(path), _share_file(Path(answer))):
            result = getattr(import_module(module), function)(Path(path))
    except MemoryError:
        result = Failure("needs more memory than a file of its size should", DAMAGED)
    except FileError as error:
        result = Failure(error.problem, error.remedy)
    with open(answer, "wb") as file:
        pickle.dump(result, file, pickle.HIGHEST_PROTOCOL)


@contextmanager
def _stored_progress(path: Path, target: Path) -> Iterator[None]:
    """Context manager in which the share that is done is stored in a file."""

    def store(progress: FileProgress) -> None:
        with suppress(OSError):
            target.write_bytes(b"%.4f" % progress.share)

    with watch_files(store), file_operation(path, FileAction.READING):
        yield


def last_line(errors: IO[bytes]) -> str:
    """Return the last line of a process's error output, short and printable."""
    errors.seek(max(0, errors.seek(0, os.SEEK_END) - 2000))
    lines = errors.read().decode(errors="replace").split("\n")
    return printable(next((line for line in reversed(lines) if line.strip()), "it gave no reason"))[:300]


def limit_memory(kind: str, size: int) -> None:
    """Limit a kind of this process's memory, such as "RLIMIT_AS", to a number of bytes, where the system can."""
    try:
        import resource
    except ImportError:  # Windows has none
        return
    number = getattr(resource, kind)
    hard = resource.getrlimit(number)[1]
    resource.setrlimit(number, (size if hard == resource.RLIM_INFINITY else min(size, hard), hard))
