"""Compiled kernels: arrays in, arrays out, no classes.

They are written in C++ (`core/native`, a file a family) and stand below `mesh` and `topology`, which are built with
them. Every kernel releases the GIL, so that a window stays alive beside it. Results do not depend on the number of
threads: parallel loops write disjoint rows, and sums are taken over those rows afterwards.

There is a build for each generation of processors; the newest that this one can run is loaded. The variable
`HEXMEND_KERNELS` names another: v2, v3 or v4 (x86-64-v2 and so on).

Arrays are taken as they are, without a copy: points (n, 3) float64, hexes (m, 8) int32, all contiguous. Another type
or shape is a TypeError.
"""

from __future__ import annotations

import importlib
import os
import sys
from types import ModuleType

from hexmend.kernels import _processor

#: Builds, the newest first, that a processor of each level can run.
_RUNS = {"v4": ("v4", "v3", "v2"), "v3": ("v3", "v2"), "v2": ("v2",), "native": ("native",)}


def _chosen() -> str:
    can = _RUNS.get(_processor.LEVEL, ())
    wanted = os.environ.get("HEXMEND_KERNELS") or (can[0] if can else "")
    if wanted not in can:
        runs = f"it runs {', '.join(can)}" if can else "it runs none of them; SSE 4.2 is the least"
        raise ImportError(
            f"HEXMEND_KERNELS={wanted or 'v2'}: this processor cannot run that build of the kernels; {runs}"
        )
    return wanted


def _default_threads() -> int:
    """HEXMEND_THREADS, else what OpenMP's variables say, else every processor that this process may use."""
    for name in ("HEXMEND_THREADS", "OMP_NUM_THREADS"):
        first = os.environ.get(name, "").split(",")[0].strip()
        if first.isdecimal() and int(first) > 0:
            return int(first)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


#: The build that is loaded.
BUILD = _chosen()

_native = importlib.import_module(f"hexmend.kernels._{BUILD}")
_native.set_default_threads(_default_threads())

threads, set_threads, LANES = _native.threads, _native.set_threads, _native.LANES

for _name, _family in vars(_native).items():
    if isinstance(_family, ModuleType):
        globals()[_name] = sys.modules[f"{__name__}.{_name}"] = _family
