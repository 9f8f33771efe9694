"""Numba kernels: arrays in, arrays out, no classes.

They stand below `mesh` and `topology`, which are built with them, and import only the reference hexahedron. Every kernel
releases the GIL, so that a window stays alive beside it, and is cached on disk. Results do not depend on the number of
threads: parallel loops write disjoint rows, and sums are taken over those rows afterwards.

Numba compiles a kernel once more for an array that is read-only. Points are therefore always handed over read-only
where they are only read, as `Mesh` keeps them.
"""

from __future__ import annotations

import numba

#: A kernel that runs on one thread, or a piece of one.
serial = numba.njit(nogil=True, cache=True, error_model="numpy")

#: A kernel whose `prange` loops share the threads.
parallel = numba.njit(nogil=True, cache=True, parallel=True, error_model="numpy")

#: Hexes (or nodes) that one thread takes at a time.
CHUNK = 256
