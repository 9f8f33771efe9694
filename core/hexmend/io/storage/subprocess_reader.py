"""Reading in a subprocess: a library that crashes or hangs on a damaged file does not take Hexmend with it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import fields
from importlib import import_module
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content
from hexmend.io.base.remedies import DAMAGED

#: Time limit of a reader in seconds, and further seconds for each megabyte of the file.
SECONDS, SECONDS_PER_MB = 60.0, 0.5
#: Memory limit of a reader in bytes, and further bytes for each byte of the file.
MEMORY, MEMORY_PER_BYTE = 4 << 30, 64


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
            with open(log, "wb") as errors:
                command = [sys.executable, "-c", program, reader, str(path.absolute()), str(answer), *sys.path]
                null = subprocess.DEVNULL
                process = subprocess.run(command, stdin=null, stdout=null, stderr=errors, timeout=limit, check=False)
        except subprocess.TimeoutExpired:
            raise FileError(path, f"is not read within {limit:.0f} seconds", DAMAGED) from None
        if process.returncode == 1:  # an unexpected exception
            raise FileError(path, f"its reader fails ({_last_line(log)})", "Write the file again, and report this.")
        if process.returncode or not answer.exists():
            raise FileError(path, "ends the library that reads it", DAMAGED)
        with np.load(answer, allow_pickle=False) as arrays:
            message = json.loads(arrays["message"].tobytes())
            if "problem" in message:
                raise FileError(path, message["problem"], message["remedy"])
            return decode(message["content"], arrays)


def main(reader: str, path: str, answer: str) -> None:
    """Entry point of the subprocess: read the file and write the answer, a file .npz."""
    _limit_memory(Path(path))
    module, _, function = reader.partition(":")
    arrays: dict[str, np.ndarray] = {}
    try:
        message = {"content": encode(getattr(import_module(module), function)(Path(path)), arrays)}
    except MemoryError:
        message = {"problem": "needs more memory than a file of its size should", "remedy": DAMAGED}
    except FileError as error:
        message = {"problem": error.problem, "remedy": error.remedy}
    np.savez(answer, message=np.frombuffer(json.dumps(message).encode(), np.uint8), **arrays)


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
    last = next((line for line in reversed(lines) if line.strip()), "it does not say why")
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
