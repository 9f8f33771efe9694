"""Reading in a subprocess: a library that crashes or hangs on a damaged file does not take Hexmend with it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from time import monotonic

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.storage.file_progress import (
    FileAction,
    FileProgress,
    advance,
    file_operation,
    report,
    stage,
    watch_files,
)

#: Time limit of a reader in seconds, and further seconds for each megabyte of the file.
SECONDS, SECONDS_PER_MB = 60.0, 0.5
#: Memory limit of a reader in bytes, and further bytes for each byte of the file.
MEMORY, MEMORY_PER_BYTE = 4 << 30, 64

#: Share of the work that the subprocess has, and seconds between looks at its progress.
_CHILDS_SHARE, _POLL = 0.7, 0.1


def run_reader(reader: str, path: Path) -> Content:
    """Call the function that reads a file in a subprocess.

    Parameters
    ----------
    reader : str
        "module:function"; the function takes the path and returns a `Content`.
    path : Path

    Returns
    -------
    Content

    Raises
    ------
    FileError
        From the function, and where the process crashes or takes too long.
    """
    size = os.path.getsize(path)
    with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
        answer, log = Path(folder) / "answer.npz", Path(folder) / "stderr"
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
            raise FileError(path, f"its reader fails ({_last_line(log)})", "Write the file again, and report this.")
        if process.returncode or not answer.exists():
            raise FileError(path, "ends the library that reads it", DAMAGED)
        with np.load(answer, allow_pickle=False) as arrays, stage(_CHILDS_SHARE, 1.0):
            message = json.loads(arrays["message"].tobytes())
            if "problem" in message:
                raise FileError(path, message["problem"], message["remedy"])
            return decode(message["content"], _ReportedArrays(arrays, os.path.getsize(answer)))


class _ReportedArrays:
    """Arrays of an answer, by name, of which each is reported when it has been read."""

    def __init__(self, arrays: Mapping[str, np.ndarray], total: int):
        self._arrays, self._total = arrays, total

    def __getitem__(self, name: str) -> np.ndarray:
        values = self._arrays[name]
        advance(values.nbytes, self._total)
        return values


def _wait(process: subprocess.Popen, limit: float, answer: Path) -> None:
    """Wait for the subprocess and report its progress; it is killed after so many seconds, and on any exception."""
    deadline = monotonic() + limit
    try:
        while process.poll() is None:
            with suppress(subprocess.TimeoutExpired):
                process.wait(_POLL)
            if process.returncode is None and monotonic() > deadline:
                raise subprocess.TimeoutExpired(process.args, limit)
            report(_stored_share(_share_file(answer)))
    except BaseException:
        process.kill()
        raise


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
    """Entry point of the subprocess: read the file and write the answer, a file .npz."""
    _limit_memory(Path(path))
    module, _, function = reader.partition(":")
    arrays: dict[str, np.ndarray] = {}
    try:
        with _stored_progress(Path(path), _share_file(Path(answer))):
            message = {"content": encode(getattr(import_module(module), function)(Path(path)), arrays)}
    except MemoryError:
        message = {"problem": "needs more memory than a file of its size should", "remedy": DAMAGED}
    except FileError as error:
        message = {"problem": error.problem, "remedy": error.remedy}
    np.savez(answer, message=np.frombuffer(json.dumps(message).encode(), np.uint8), **arrays)


@contextmanager
def _stored_progress(path: Path, target: Path) -> Iterator[None]:
    """Context manager in which the share that is done is stored in a file."""

    def store(progress: FileProgress) -> None:
        with suppress(OSError):
            target.write_bytes(b"%.4f" % progress.share)

    with watch_files(store), file_operation(path, FileAction.READING):
        yield


def encode(value: object, arrays: dict[str, np.ndarray]) -> object:
    """Convert a content to values for JSON; its arrays are added to `arrays` under names."""
    if isinstance(value, np.ndarray | np.generic):
        name = f"a{len(arrays)}"
        arrays[name] = np.asarray(value)
        return {"array": name}
    if isinstance(value, Content | Block):
        kind = type(value).__name__.lower()
        return {kind: {field.name: encode(getattr(value, field.name), arrays) for field in fields(value)}}
    if isinstance(value, dict):
        return {"items": [[name, encode(item, arrays)] for name, item in value.items()]}
    if isinstance(value, list | tuple):
        return [encode(item, arrays) for item in value]
    return value


def decode(value: object, arrays: object) -> object:
    """Reverse `encode`."""
    if isinstance(value, list):
        return [decode(item, arrays) for item in value]
    if not isinstance(value, dict):
        return value
    ((kind, inside),) = value.items()
    if kind == "array":
        return arrays[inside]
    if kind == "items":
        return {name: decode(item, arrays) for name, item in inside}
    parts = {name: decode(item, arrays) for name, item in inside.items()}
    if kind == "block":
        return Block(**parts)
    return Content(**{**parts, "blocks": tuple(parts["blocks"]), "notes": tuple(parts["notes"])})


def _last_line(path: Path) -> str:
    """Last line of a process's error output, printable and of 200 characters at most."""
    with open(path, "rb") as file:
        file.seek(max(0, os.path.getsize(path) - 2000))
        lines = file.read().decode(errors="replace").split("\n")
    last = next((line for line in reversed(lines) if line.strip()), "no reason is given")
    return "".join(letter if letter.isprintable() else " " for letter in last)[:200]


def _limit_memory(path: Path) -> None:
    try:
        import resource
    except ImportError:  # Windows has none
        return
    limit = MEMORY + MEMORY_PER_BYTE * os.path.getsize(path)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
