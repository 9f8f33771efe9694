"""Benchmark of the memory of a run in addition to the open mesh, compared with the declaration of the method."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.section import BenchSection, probe
from hexmend.gallery import make
from hexmend.run.memory import FIXED
from hexmend.smoothers import METHODS

#: Numbers of hexes of the scrambled blocks.
_SIZES = 50_000, 200_000

#: Iterations: later ones need no more memory than the first; only mend has stages.
_ITERATIONS = 3
_ITERATIONS_OF = {"mend": 40}

#: The memory of a linear solver does not grow with its iterations.
_FEW = {"solver_iterations": 20}
_VALUES_OF = {"global-nr": _FEW, "global-mnr": _FEW}

# The mesh is read from arrays: no memory of a generator or reader is in the process.
_PROBE = """
import json, sys
import numpy as np
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import declared
from hexmend.quality import measure
from hexmend.run import StoppingCriteria, smooth
from hexmend.run.memory import needed
from hexmend.smoothers import METHODS
from hexmend.run.memory import peak_mb, resident_mb
path, name, values, iterations = sys.argv[1:]
with np.load(path) as arrays:
    mesh = Mesh(arrays["points"], arrays["hexes"])
measure(mesh.points, mesh.hexes)
smoother = METHODS[name](**json.loads(values))
before = resident_mb()
smooth(mesh, smoother, StoppingCriteria(max_iterations=int(iterations), tolerance=0), progress=False)
print(json.dumps({"hexes": mesh.n_hexes, "mb": peak_mb() - before, "needed_mb": needed(smoother, mesh) / 2**20}))
"""


def measure_memory(name: str, size: int, iterations: int, **values: Any) -> dict[str, Any]:
    """Measure the memory of a method on a scrambled block, in a new process.

    Parameters
    ----------
    name : str
        Name of the method.
    size : int
        Requested number of hexes.
    iterations : int
    values : Any
        Values of its parameters.

    Returns
    -------
    dict
        `hexes`; `mb`, peak in addition to the open mesh, MiB; `needed_mb`, as predicted, MiB.
    """
    with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
        mesh, path = make("cube", size=size, scramble=0.6), Path(folder) / "mesh.npz"
        np.savez(path, points=mesh.points, hexes=mesh.hexes)
        return probe(_PROBE, path, name, json.dumps(values), iterations)


def _memory() -> dict[str, Any]:
    figures: dict[str, Any] = {}
    for name, cls in METHODS.items():
        iterations, values = _ITERATIONS_OF.get(name, _ITERATIONS), _VALUES_OF.get(name, {})
        rows = [measure_memory(name, size, iterations, **values) for size in _SIZES]
        figures[name] = {"bytes_per_hex": cls.bytes_per_hex, "sizes": rows}
    return figures


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [f"predicted: the bytes a hex that a method declares, and {FIXED >> 20} MiB"]
    for name, row in figures.items():
        sizes = "   ".join(
            f"{size['hexes']:>7,} hexes {size['mb']:5.0f} MiB ({size['needed_mb']:5.0f} predicted)"
            for size in row["sizes"]
        )
        lines.append(f"{name:<18} {row['bytes_per_hex']:>5,} bytes a hex   {sizes}")
    return lines


_TITLE = "Memory of a run in addition to the open mesh, a scrambled block (whole process)"
MEMORY = BenchSection("memory", _TITLE, _memory, _lines)
