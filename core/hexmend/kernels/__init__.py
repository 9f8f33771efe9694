"""Compiled kernels: functions of NumPy arrays.

They are written in C++ (`core/native`, a file a family) and stand below `mesh` and `topology`, which are built with
them. Every kernel releases the GIL, so that a window stays responsive. Results do not depend on the number of
threads: parallel loops write disjoint rows, and sums are taken over those rows afterwards.

There is a build for each generation of processors; the newest that this one can run is loaded. The variable
`HEXMEND_KERNELS` names another: v2, v3 or v4 (x86-64-v2 and so on); other kinds of processors have one build, native.

Loops are shared by as many threads as `HEXMEND_THREADS` says, else OpenMP's variables (`OMP_NUM_THREADS`,
`OMP_THREAD_LIMIT`), else by as many as there are processors that this process may use. `set_threads` chooses another
number for the calling thread alone.

Arrays are taken as they are, without a copy: points (n, 3) float64, hexes (m, 8) int32, all contiguous. Another type
or shape is a TypeError, lengths that do not fit each other are a ValueError. Numbers in arrays are not checked: nodes
in hexes must exist, and the entries of `start` of rows, of which only the last is compared with the length of the
rows, must ascend from 0. What goes together is a class: `hex_mesh.HexMesh`, `line_search.LineSearch`,
`sliding_surface.SlidingSurface` and settings of steps; its objects view their arrays and keep them alive.
"""

from __future__ import annotations

import importlib
import os
import sys
from types import ModuleType

from hexmend.errors import InstallationError, ParameterError

try:
    from hexmend.kernels import _processor
except ImportError:
    raise InstallationError(
        f"the kernels of Hexmend are not built for this Python ({sys.version.split()[0]}): run  "
        "pip install --editable .  in its folder, which needs a C++ compiler and Python's headers (Debian: "
        "apt-get install g++ python3-dev)"
    ) from None

#: Builds, the newest first, that a processor of each level can run.
_RUNS = {"v4": ("v4", "v3", "v2"), "v3": ("v3", "v2"), "v2": ("v2",), "native": ("native",)}


#: Those that this processor can run, the newest first.
BUILDS = _RUNS.get(_processor.LEVEL, ())


def _chosen() -> str:
    if not BUILDS:
        raise InstallationError("this processor can run none of the builds of Hexmend's kernels: SSE 4.2 is the least")
    wanted = os.environ.get("HEXMEND_KERNELS", "").strip() or BUILDS[0]
    if wanted not in BUILDS:
        raise ParameterError(
            f"HEXMEND_KERNELS = {wanted!r} names no build that this processor can run: expected {', '.join(BUILDS)}"
        )
    return wanted


def _default_threads() -> int:
    """HEXMEND_THREADS, else what OpenMP's variables say, else every processor that this process may use."""
    wanted = os.environ.get("HEXMEND_THREADS", "").strip()
    if wanted:
        if _positive(wanted) is None:
            raise ParameterError(f"HEXMEND_THREADS = {wanted!r} cannot be used: expected a whole number from 1 to 1024")
        return int(wanted)
    theirs = _positive(os.environ.get("OMP_NUM_THREADS", "").split(",")[0])  # of nested loops, the outer ones'
    limit = _positive(os.environ.get("OMP_THREAD_LIMIT", ""))
    if theirs is None:
        theirs = cores()
    return theirs if limit is None else min(theirs, limit)


def cores() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def cores_for(tasks: int) -> int:
    """Return the share of these processors, at least 1, of each of some tasks at a time."""
    return max(1, cores() // max(1, tasks))


def _positive(word: str) -> int | None:
    word = word.strip()
    number = int(word) if word.isascii() and word.isdecimal() and len(word) < 7 else 0
    return number if 0 < number <= 1024 else None


#: The build that is loaded.
BUILD = _chosen()

_native = importlib.import_module(f"hexmend.kernels._{BUILD}")
_native.set_default_threads(_default_threads())

threads, set_threads, LANES = _native.threads, _native.set_threads, _native.LANES
release_free_memory = _native.release_free_memory
return_freed_arrays = _native.return_freed_arrays

# So that a family is imported like a module of its own: `from hexmend.kernels.local import sweep`.
for _name, _family in vars(_native).items():
    if isinstance(_family, ModuleType):
        globals()[_name] = sys.modules[f"{__name__}.{_name}"] = _family
