"""Measuring: the kernels against plain loops over one hex after another, and what a Newton system is solved with."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import Any

import numba
import numpy as np

from hexmend.energy import Couplings, MeshEnergy, energies
from hexmend.gallery import make
from hexmend.numba_kernels import hexahedron, local, objective, serial, tetrahedron
from hexmend.numba_kernels.elements import load
from hexmend.quality import measure
from hexmend.study.section import Section

#: How often each is timed.
_TIMES = 15


@serial
def _plain_energies(points, hexes, delta, eta):
    x = np.empty((8, 3))
    for h in range(hexes.shape[0]):
        load(points, hexes, h, x)
        total = 0.0
        for t in range(8):
            ux, uy, uz, vx, vy, vz, wx, wy, wz = hexahedron.corner_edges(x, t)
            f, square, _, _ = tetrahedron.energy(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, 1.0)
            total += f * square
        eta[h] = max(total / 8 - 1, 0.0)


@serial
def _plain_gradient(points, hexes, delta, p, blocks):
    x, g = np.empty((8, 3)), np.empty((8, 3))
    for h in range(hexes.shape[0]):
        load(points, hexes, h, x)
        first, _ = hexahedron.weights(hexahedron.gradient(x, delta, 0, g), p)
        for c in range(8):
            for k in range(3):
                blocks[h, c, k] = first * g[c, k]


@serial
def _plain_product(points, hexes, slots, values, delta, p, blocks):
    x, v, g, hv = np.empty((8, 3)), np.empty((8, 3)), np.empty((8, 3)), np.empty((8, 3))
    for h in range(hexes.shape[0]):
        load(points, hexes, h, x)
        for c in range(8):
            i = slots[h, c]
            for k in range(3):
                v[c, k] = values[i, k] if i >= 0 else 0.0
        hexahedron.product(x, v, delta, p, 0, g, hv)
        blocks[h] = hv


def _seconds(call: Callable[[], Any]) -> float:
    call()
    took = []
    for _ in range(_TIMES):
        began = perf_counter()
        call()
        took.append(perf_counter() - began)
    return median(took)


def _kernels() -> dict[str, Any]:
    mesh = make("bridge-sharp")
    energy = MeshEnergy(mesh)
    x, m = energy.scaled(mesh.points), mesh.n_hexes
    x.flags.writeable = False
    hessian, none = energy.hessian(x), energy.left_out
    gradient, blocks, eta = energy.gradient(x), np.empty((m, 8, 3)), np.empty(m)
    matrix, right = hessian.assembled(), -gradient.ravel()
    one, all_threads = 1, numba.get_num_threads()

    def iteration() -> None:
        matrix.solve(right, 0.0, 20)

    rows: list[tuple[str, Callable[[], Any], Callable[[], Any] | None, float]] = [
        ("quality", lambda: measure(x, mesh.hexes), None, 1),
        ("energy", lambda: energies(x, mesh.hexes), lambda: _plain_energies(x, mesh.hexes, 0.0, eta), 1),
        (
            "gradient",
            lambda: objective.gradient(x, mesh.hexes, 0.0, 2.0, none, blocks),
            lambda: _plain_gradient(x, mesh.hexes, 0.0, 2.0, blocks),
            1,
        ),
        (
            "hessian product, by formulas",
            lambda: objective.hessian_product(x, mesh.hexes, energy.slots, gradient, 0.0, 2.0, none, blocks),
            lambda: _plain_product(x, mesh.hexes, energy.slots, gradient, 0.0, 2.0, blocks),
            1,
        ),
        ("hessian product, assembled", lambda: matrix @ right, None, 1),
        ("hessian, assembling", hessian.assembled, None, 1),
        ("conjugate gradients, an iteration", iteration, None, 20),
        ("local sweep, steepest descent", lambda: _sweep(energy, x), None, 1),
    ]
    figures = {}
    try:
        for name, call, plain, times in rows:
            numba.set_num_threads(one)
            alone, reference = _seconds(call) / times, _seconds(plain) if plain else None
            numba.set_num_threads(all_threads)
            figures[name] = {
                "ns_per_tetrahedron": alone / (8 * m) * 1e9,
                "ns_per_tetrahedron_all_threads": _seconds(call) / times / (8 * m) * 1e9,
                "ns_per_tetrahedron_plain": reference and reference / (8 * m) * 1e9,
                "ratio": reference and reference / alone,
            }
    finally:
        numba.set_num_threads(all_threads)
    return {"hexes": m, "kernels": figures}


def _sweep(energy: MeshEnergy, x: np.ndarray) -> None:
    mesh, moved = energy.mesh, x.copy()
    corners, colours = mesh.topology.node_corners, mesh.topology.colouring(mesh.free)
    local.sweep(
        moved, mesh.hexes, corners.start, corners.items, colours.start, colours.items,
        local.STEEPEST_DESCENT, 0.0, 2.0, 1.0, 0.7, 1e-4, 60,
    )  # fmt: skip


def _kernel_lines(figures: dict[str, Any]) -> list[str]:
    lines = [f"{'ns a corner tetrahedron':<36}{'plain loop':>11}{'1 thread':>10}{'all':>8}{'ratio':>8}"]
    for name, row in figures["kernels"].items():
        plain = f"{row['ns_per_tetrahedron_plain']:11.1f}" if row["ns_per_tetrahedron_plain"] else " " * 11
        ratio = f"{row['ratio']:7.1f}x" if row["ratio"] else ""
        lines.append(
            f"{name:<36}{plain}{row['ns_per_tetrahedron']:10.1f}{row['ns_per_tetrahedron_all_threads']:8.1f}{ratio}"
        )
    return lines


#: What the preconditioners are compared on: mesh, sizes, residuals.
_SIZES = (10_000, 100_000, 1_000_000)
_RESIDUALS = (1e-1, 1e-3)


def _preconditioners() -> dict[str, Any]:
    rows = []
    for size in _SIZES:
        mesh = make("five-side", size=size, scramble=0.05)
        energy = MeshEnergy(mesh)
        x = energy.scaled(mesh.points)
        right, parts = -energy.gradient(x).ravel(), energy.couplings.pattern[0]
        for name, part in (("block Jacobi", 1), ("Gauss-Seidel, in parts", parts), ("Gauss-Seidel, whole", 10**9)):
            energy.couplings = Couplings(mesh, part)
            matrix = energy.hessian(x).assembled()
            for residual in _RESIDUALS:
                began = perf_counter()
                solved = matrix.solve(right, residual, 2000)
                rows.append(
                    {
                        "hexes": mesh.n_hexes,
                        "preconditioner": name,
                        "residual": residual,
                        "iterations": solved.iterations,
                        "seconds": perf_counter() - began,
                    }
                )
    return {"systems": rows}


def _preconditioner_lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{row['hexes']:>9,} hexes   {row['preconditioner']:<24} to {row['residual']:g}: "
        f"{row['iterations']:>4} iterations {row['seconds']:8.3f} s"
        for row in figures["systems"]
    ]


KERNELS = Section("kernels", "Kernels on bridge-sharp, 32,000 hexes (median of 15)", _kernels, _kernel_lines)
PRECONDITIONERS = Section(
    "preconditioners",
    "Newton's system on five-side, moved by up to 0.05 edge lengths",
    _preconditioners,
    _preconditioner_lines,
)
