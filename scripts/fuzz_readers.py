"""Reads files that were spoilt in many ways: each gives a mesh or one clear error, in bounded time and memory.

Use: python scripts/fuzz_readers.py [--cases N] [--seed S] [--meshes FOLDER] [FORMAT ...]

For each format the meshes of FOLDER (by default that of the variable HEXMEND_MESHES) and some that Hexmend or VTK
writes are spoilt: bits and bytes changed, numbers made huge or negative, parts cut out, doubled, exchanged, the end cut
off. Of a file that names others beside it, any of them is.
Prints a line a format; exit status 1 where anything but a mesh or a clear error came of a file, which is kept.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import re
import resource
import shutil
import signal
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from hexmend import gallery, io
from hexmend.errors import HexmendError
from hexmend.io.base.format import FORMATS, Format
from hexmend.mesh.mesh import Mesh
from hexmend_app.formats.session import FORMAT as SESSION
from hexmend_app.formats.session.session_file import write_session

#: Memory limit of the process in bytes, time limit per file in seconds, and size limit of foreign files in bytes.
MEMORY, SECONDS, LARGEST = 3 << 30, 20, 3_000_000

_NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
_HARD = [b"-1", b"0", b"4294967303", b"99999999999999999999", b"1e400", b"nan", b"268", b"7.9", b"", b"2147483647"]


class TooLong(Exception):
    """A file takes more seconds than it may."""


def spoilt(data: bytes, random: np.random.Generator) -> bytes:
    """A copy of a file with one to four things wrong."""
    for _ in range(random.integers(1, 5)):
        if not data:
            break
        at, size = int(random.integers(len(data))), int(random.integers(1, 1 + min(64, len(data))))
        kind = random.integers(8)
        if kind == 0:  # a bit
            data = data[:at] + bytes([data[at] ^ (1 << int(random.integers(8)))]) + data[at + 1 :]
        elif kind == 1:  # some bytes
            data = data[:at] + random.bytes(size) + data[at + size :]
        elif kind == 2:  # the end is missing
            data = data[:at]
        elif kind == 3:  # a part is missing
            data = data[:at] + data[at + size :]
        elif kind == 4:  # a part is there twice
            data = data[: at + size] + data[at:]
        elif kind == 5:  # parts are exchanged
            other = int(random.integers(len(data)))
            low, high = sorted((at, other))
            data = (
                data[:low] + data[high : high + size] + data[low + size : high] + data[low : low + size] + data[high:]
            )
        elif kind == 6:  # a number is another one
            found = list(_NUMBER.finditer(data, at, at + 4096)) or list(_NUMBER.finditer(data, 0, 4096))
            if found:
                one = found[int(random.integers(len(found)))]
                data = data[: one.start()] + _HARD[int(random.integers(len(_HARD)))] + data[one.end() :]
        else:  # a whole number in binary is another one
            number = int(random.choice([-1, 0, 1 << 31, (1 << 32) + 7, (1 << 62), 255]))
            width = int(random.choice([4, 8]))
            data = data[:at] + (number & ((1 << (8 * width)) - 1)).to_bytes(width, "little") + data[at + width :]
    return data


@dataclass(frozen=True)
class Seed:
    """A sound file: its suffix and content, and those of the files beside it that it names."""

    suffix: str
    data: bytes
    beside: Mapping[str, bytes] = field(default_factory=dict)


def seeds(format: Format, meshes: Path | None) -> list[Seed]:
    """Sound files of a format."""
    found = []
    for path in sorted(meshes.iterdir()) if meshes else ():
        if path.suffix.lower() in format.suffixes and path.stat().st_size <= LARGEST:
            found.append(Seed(path.suffix, path.read_bytes()))
    if format.write is not None:
        with tempfile.TemporaryDirectory() as folder:
            for encoding in format.encodings:
                for k, mesh in enumerate(_meshes()):
                    path = Path(folder) / f"{k}{format.suffixes[0]}"
                    path = Path(folder) / f"{encoding}-{k}" / path.name if format.place else path
                    io.write(path, mesh, encoding=encoding)
                    parts = path.parent.rglob("*") if format.place else ()
                    beside = {
                        one.relative_to(path.parent).as_posix(): one.read_bytes() for one in parts if one.is_file()
                    }
                    beside.pop(path.name, None)
                    found.append(Seed(format.suffixes[0], path.read_bytes(), beside))
    if format is SESSION:  # which holds more than a mesh, so that no mesh is written as one
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "session.hexmend"
            write_session(path, _meshes(), 1, {"look": [0.5, None]})
            found.append(Seed(path.suffix, path.read_bytes()))
    if format.name in BY_VTK and find_spec("pyvista"):
        with tempfile.TemporaryDirectory() as folder:
            for k, mesh in enumerate(_meshes()):
                path = Path(folder) / f"{k}{format.suffixes[0]}"
                BY_VTK[format.name](path, _grid(mesh))
                pieces = {one.name: one.read_bytes() for one in path.parent.glob(f"{path.stem}_*")}
                found.append(Seed(path.suffix, path.read_bytes(), pieces))
    return found


def _write_pvtu(path: Path, grid: object) -> None:
    from vtkmodules.vtkIOParallelXML import vtkXMLPUnstructuredGridWriter

    writer = vtkXMLPUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    writer.Write()


def _write_vtkhdf(path: Path, grid: object) -> None:
    from vtkmodules.vtkIOHDF import vtkHDFWriter

    writer = vtkHDFWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(4)
    writer.Write()


#: Makers of files in formats that Hexmend does not write.
BY_VTK = {"pvtu": _write_pvtu, "vtkhdf": _write_vtkhdf}


def _grid(mesh: Mesh) -> object:
    """The mesh as VTK has it."""
    import pyvista

    grid = pyvista.UnstructuredGrid({12: mesh.hexes.astype(np.int64)}, mesh.points)
    grid.cell_data.update(mesh.hex_data)
    grid.point_data["velocity"] = mesh.points + 1
    return grid


def _meshes() -> list[Mesh]:
    mesh = gallery.make("cube", size=27, scramble=0.3)
    sets = {"hex_sets": {"part": np.arange(5)}, "node_sets": {"wall": np.arange(9)}}
    return [mesh, mesh.replace(**sets, hex_data={"pressure": np.linspace(0, 1, mesh.n_hexes)})]


def attempt(path: Path, names: set[str]) -> str:
    """Return the outcome for a file: "mesh", "error" naming one of the files, or a description of the failure."""
    signal.alarm(SECONDS)
    try:
        io.read(path)
    except HexmendError as error:
        text = str(error)
        if "its reader fails" in text:  # an exception that a child's reader did not expect
            return text
        return (
            "error"
            if any(name in text for name in names) and "\n" not in text
            else f"an error without the file's name: {text!r}"
        )
    except TooLong:
        return f"more than {SECONDS} s"
    except MemoryError:
        return "too much memory"
    except BaseException as error:  # whatever it is, it is no clear error
        return f"{type(error).__name__}: {error}"
    finally:
        signal.alarm(0)
    return "mesh"


def fuzz(format: Format, cases: int, seed: int, meshes: Path | None, kept: Path) -> Counter[str]:
    """Read so many spoilt files of a format; those that go wrong are kept in a folder."""
    random, found, counts = np.random.default_rng(seed), seeds(format, meshes), Counter()
    for case in range(cases if found else 0):
        one = found[int(random.integers(len(found)))]
        place = kept / f"{format.name}-{seed}-{case}" if one.beside else kept
        place.mkdir(exist_ok=True)
        path = place / f"{format.name}-{seed}-{case}{one.suffix}"
        written = [path, *(place / name for name in one.beside)]
        bad = int(random.integers(len(written)))
        for k, (file, data) in enumerate(zip(written, (one.data, *one.beside.values()), strict=True)):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(spoilt(data, random) if k == bad else data)
        came = attempt(path, {file.name for file in written})
        counts[came] += 1
        if came not in ("mesh", "error"):
            print(f"{path}: {came}", file=sys.stderr, flush=True)
            continue
        for file in written:
            file.unlink()
        if one.beside:
            shutil.rmtree(place)
    return counts


def _ring(number: int, frame: object) -> None:
    raise TooLong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formats", nargs="*", metavar="FORMAT", help="all if none is named")
    parser.add_argument("--cases", type=int, default=1000, help="spoilt files of each format")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--meshes", type=Path, default=os.environ.get("HEXMEND_MESHES"))
    args = parser.parse_args()
    faulthandler.enable()
    warnings.simplefilter("error")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, _ring)
    kept = Path(tempfile.mkdtemp(prefix="spoilt-"))
    bad = 0
    formats = {**FORMATS, SESSION.name: SESSION}
    for name in args.formats or formats:
        counts = fuzz(formats[name], args.cases, args.seed, args.meshes and Path(args.meshes), kept)
        wrong = sum(counts.values()) - counts["mesh"] - counts["error"]
        bad += wrong
        print(
            f"{name:<14} {sum(counts.values()):>6,} files: {counts['mesh']:>6,} meshes, "
            f"{counts['error']:>6,} clear errors, {wrong} others",
            flush=True,
        )
    if not bad:
        kept.rmdir()
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
