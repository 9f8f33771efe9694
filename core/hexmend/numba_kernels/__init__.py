"""Numba kernels: arrays in, arrays out, no classes.

They stand below `mesh` and `topology`, which are built with them, and import only the reference hexahedron. Every
kernel releases the GIL, so that a window stays alive beside it, and is cached on disk. Results do not depend on the
number of threads: parallel loops write disjoint rows, and sums are taken over those rows afterwards.

Numba compiles a kernel once more for an array that is read-only. Points are therefore always handed over read-only
where they are only read, as `Mesh` keeps them.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

# Threads that wait for others sleep after some microseconds. OpenMP's own way, to spin, keeps the thread that is waited
# for off its core wherever another process (or this one's window) wants one too: twenty times slower on a busy machine.
# Read as the first parallel kernel runs; what the user has set stands.
for _name, _value in (("OMP_WAIT_POLICY", "PASSIVE"), ("GOMP_SPINCOUNT", "1000"), ("KMP_BLOCKTIME", "0")):
    os.environ.setdefault(_name, _value)

#: Hexes (or nodes) that one thread takes at a time.
CHUNK = 256


def _cache_folder() -> Path:
    """Where compiled kernels are kept: a folder for each state of their sources.

    Numba's own cache looks only at the file of the kernel, not at those whose functions it calls, nor at its options;
    a change there would go unseen.
    """
    here = Path(__file__).parent
    digest = hashlib.sha256()
    for source in sorted([*here.glob("*.py"), here.parent / "hexahedron.py"]):
        digest.update(source.read_bytes())
    home = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or Path.home() / ".cache"
    folder = Path(home) / "hexmend" / f"kernels-{digest.hexdigest()[:16]}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:  # a home that cannot be written to
        return Path(tempfile.gettempdir()) / f"hexmend-{digest.hexdigest()[:16]}"
    return folder


_CACHE = str(_cache_folder())


def _compiled(**options: Any) -> Callable[[Callable], Callable]:
    def decorate(function: Callable) -> Callable:
        theirs = numba.config.CACHE_DIR
        numba.config.CACHE_DIR = theirs or _CACHE  # read as the function is decorated, and by nobody after
        try:
            return numba.njit(nogil=True, cache=True, error_model="numpy", **options)(function)
        finally:
            numba.config.CACHE_DIR = theirs

    return decorate


#: A kernel that runs on one thread, or a piece of one. Products and sums may be contracted to one rounding, which is
#: what vector units are fast at.
serial = _compiled(fastmath={"contract"})

#: Of what Numba would make parallel, `prange` alone: array expressions are short here, and cost seconds to compile.
_PRANGE = dict.fromkeys(
    ("comprehension", "reduction", "inplace_binop", "setitem", "numpy", "stencil", "fusion"), False
) | {"prange": True}

#: A kernel whose `prange` loops share the threads.
parallel = _compiled(parallel=_PRANGE, fastmath={"contract"})

#: A formula that its callers take in whole, as a loop over lanes needs it to be.
formula = _compiled(fastmath={"contract"}, forceinline=True)

#: The same, every operation rounded on its own: its result is the same to the last bit wherever it stands. (What is not
#: said is inherited from the caller.)
exact = _compiled(fastmath=False, forceinline=True)
