"""Reading in a process of its own: a library that crashes or never ends on a damaged file takes none but that along."""

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

#: Seconds that a reader may take: some, and more for each megabyte of the file.
SECONDS, SECONDS_PER_MB = 60.0, 0.5
#: Bytes of memory that it may use: some, and many times the file's size.
MEMORY, MEMORY_TIMES = 4 << 30, 64

_DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."


def run_reader(reader: str, path: Path) -> Content:
    """What a function makes of a file, in another process.

    Parameters
    ----------
    reader : str
        "module:function"; it takes the path and gives a `Content`.
    path : Path

    Raises
    ------
    FileError
        As the function does; or where the process ends before it has an answer, or takes too long.
    """
    size = os.path.getsize(path)
    with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
        answer, said = Path(folder) / "answer.npz", Path(folder) / "said"
        program = f"import sys; sys.path[:] = sys.argv[4:]; from {__name__} import main; main(*sys.argv[1:4])"
        limit = SECONDS + SECONDS_PER_MB * size / 1e6
        try:
            with open(said, "wb") as errors:
                done = subprocess.run(
                    [sys.executable, "-c", program, reader, str(path.absolute()), str(answer), *sys.path],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=errors,
                    timeout=limit,
                    check=False,
                )
        except subprocess.TimeoutExpired:
            raise FileError(path, f"is not read within {limit:.0f} seconds", _DAMAGED) from None
        if done.returncode == 1:  # an exception that its reader did not expect
            raise FileError(path, f"its reader fails ({_last_line(said)})", "Write the file again, and report this.")
        if done.returncode or not answer.exists():
            raise FileError(path, "ends the library that reads it", _DAMAGED)
        with np.load(answer, allow_pickle=False) as arrays:
            said = json.loads(arrays["said"].tobytes())
            if "problem" in said:
                raise FileError(path, said["problem"], said["remedy"])
            return decode(said["content"], arrays)


def main(reader: str, path: str, answer: str) -> None:
    """What the child does: read, and leave the answer."""
    _limit_memory(Path(path))
    module, _, function = reader.partition(":")
    arrays: dict[str, np.ndarray] = {}
    try:
        said = {"content": encode(getattr(import_module(module), function)(Path(path)), arrays)}
    except MemoryError:
        said = {"problem": "needs more memory than a file of its size should", "remedy": _DAMAGED}
    except FileError as error:
        said = {"problem": error.problem, "remedy": error.remedy}
    np.savez(answer, said=np.frombuffer(json.dumps(said).encode(), np.uint8), **arrays)


def encode(value: object, arrays: dict[str, np.ndarray]) -> object:
    """A content as JSON can hold it; its arrays are put among `arrays` and named."""
    if isinstance(value, np.ndarray | np.generic):
        name = f"a{len(arrays)}"
        arrays[name] = np.asarray(value)
        return {"array": name}
    if isinstance(value, Content | Block):
        kind = type(value).__name__.lower()
        return {kind: {one.name: encode(getattr(value, one.name), arrays) for one in fields(value)}}
    if isinstance(value, dict):
        return {"items": [[name, encode(one, arrays)] for name, one in value.items()]}
    if isinstance(value, list | tuple):
        return [encode(one, arrays) for one in value]
    return value


def decode(value: object, arrays: object) -> object:
    """What `encode` was given."""
    if isinstance(value, list):
        return [decode(one, arrays) for one in value]
    if not isinstance(value, dict):
        return value
    ((kind, inside),) = value.items()
    if kind == "array":
        return arrays[inside]
    if kind == "items":
        return {name: decode(one, arrays) for name, one in inside}
    parts = {name: decode(one, arrays) for name, one in inside.items()}
    if kind == "block":
        return Block(**parts)
    return Content(**{**parts, "blocks": tuple(parts["blocks"]), "notes": tuple(parts["notes"])})


def _last_line(path: Path) -> str:
    """The last line of what a process has said, short and printable."""
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
    limit = MEMORY + MEMORY_TIMES * os.path.getsize(path)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
