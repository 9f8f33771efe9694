"""Benchmark of mend: seconds to the optimum of shape, and inverted hexes that remain."""

from __future__ import annotations

import itertools
from collections import Counter
from functools import partial
from statistics import median
from typing import Any

from benchmarks.section import BenchSection, by_size, collection
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import summarise
from hexmend.run import StoppingCriteria, smooth

#: Gallery meshes by name, size and scramble.
_MESHES = [("five-side", 7350, 0.0), ("bridge-sharp", 32000, 0.0), ("bridge-sharp", 32000, 0.6), ("plane", 31760, 0.0)]

#: Scrambled meshes: names and sizes, amplitudes in edge lengths, seeds; 4 x 5 x 10.
_SCRAMBLED = [("cube", 1000), ("five-side", 1360), ("bridge-sharp", 1372), ("plane", 2500)]
_AMPLITUDES = [0.5, 1.0, 2.0, 3.5, 5.0]
_SEEDS = range(10)


def _optima() -> dict[str, Any]:
    gallery = [make(name, size=size, scramble=scramble) for name, size, scramble in _MESHES]
    return {"meshes": [_row(mesh) for mesh in itertools.chain(gallery, (mesh for _, mesh in collection()))]}


def _row(mesh: Mesh) -> dict[str, Any]:
    result = smooth(mesh, "mend", StoppingCriteria(max_iterations=1000), progress=False, goal="shape")
    return {
        "mesh": mesh.name,
        "hexes": mesh.n_hexes,
        "inverted": result.before.inverted,
        "locked": result.before.locked_inverted,
        "left": result.after.inverted,
        "q_min": result.after.q_min,
        **{key: getattr(result, key) for key in ("iterations", "seconds", "setup_seconds")},
    }


def _optima_lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{row['mesh']:<28} {row['hexes']:>9,} hexes   inverted {row['inverted']:>7,} to {row['left']:<3}"
        f" locked {row['locked']:<3}q min {row['q_min']:.4f}  {row['iterations']:>3} iterations {row['seconds']:8.3f} s"
        for row in figures["meshes"]
    ]


def _untangling() -> dict[str, Any]:
    seconds, ends, failures = [], Counter[str](), []
    for (name, size), amplitude, seed in itertools.product(_SCRAMBLED, _AMPLITUDES, _SEEDS):
        mesh = make(name, size=size, scramble=amplitude, seed=seed)
        before = summarise(mesh)
        result = smooth(mesh, "mend", StoppingCriteria(max_iterations=400), progress=False, goal="shape")
        seconds.append(result.seconds)
        ends[result.outcome.key] += 1
        if result.after.inverted > before.locked_inverted:
            failures.append({"mesh": mesh.name, "amplitude": amplitude, "seed": seed, "left": result.after.inverted})
    return {
        "meshes": len(seconds),
        "at_lower_bound": len(seconds) - len(failures),
        "others": failures,
        "ends": dict(ends),
        "median_seconds": median(seconds),
        "most_seconds": max(seconds),
    }


def _untangling_lines(figures: dict[str, Any]) -> list[str]:
    ends = ", ".join(f"{count} {end}" for end, count in figures["ends"].items())
    lines = [
        f"{figures['at_lower_bound']} of {figures['meshes']} end with no inverted hex but those that fixed nodes lock",
        f"ended: {ends}; median {figures['median_seconds']:.3f} s, at most {figures['most_seconds']:.3f} s",
    ]
    others = "{mesh}, amplitude {amplitude}, seed {seed}: {left} left"
    return lines + [others.format(**failure) for failure in figures["others"]]


_PROBE = """
import json, sys
from hexmend.gallery import make
from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers import METHODS
from hexmend.run.memory import peak_mb
mesh = make("five-side", size=int(sys.argv[1]), scramble=0.3)
run = iterate(mesh, METHODS["mend"](goal="shape"), StoppingCriteria(max_iterations=1000))
inner = sum(it.diagnostics.get("solver_iterations", 0) for it in run)
result = run.result()
row = {
    "hexes": mesh.n_hexes, "inverted": result.before.inverted, "left": result.after.inverted,
    "iterations": result.iterations, "solver_iterations": inner, "seconds": result.seconds,
    "peak_mb": peak_mb(),
}
print(json.dumps(row))
"""


def _size_lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{row['hexes']:>9,} hexes   inverted {row['inverted']:>6,} to {row['left']}"
        f"   {row['iterations']:>3} iterations ({row['solver_iterations']:>3} of the solver)   {row['seconds']:8.2f} s"
        f"   {row['seconds'] / row['hexes'] * 1e6:5.1f} us a hex   peak {row['peak_mb']:6.0f} MB"
        for row in figures["sizes"]
    ]


_TITLE = "mend (goal shape) on five-side scrambled by 0.3, against size (whole process)"
SIZES = BenchSection("sizes", _TITLE, partial(by_size, _PROBE), _size_lines)
OPTIMA = BenchSection("optima", "mend, from the mesh to its optimum of shape", _optima, _optima_lines)
UNTANGLING = BenchSection(
    "tangled", "mend on meshes scrambled by up to 5 edge lengths, 750 to 2,500 hexes", _untangling, _untangling_lines
)
