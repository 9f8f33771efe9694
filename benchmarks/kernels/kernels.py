"""Benchmark of the kernels against scalar loops, and of the preconditioners of Newton systems."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median, quantiles
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.section import BenchSection
from hexmend.energy import BlockSparsity, MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.gallery.gallery_mesh import scramble_nodes
from hexmend.kernels import elements, local, objective, set_threads, threads, validity
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.run import StoppingCriteria, smooth

#: Number of timed calls.
_TIMES = 15


def _seconds(*calls: Callable[[], Any]) -> list[list[float]]:
    """Return the seconds of repeated calls; they are timed in turn, so that changes of clock rate affect all alike."""
    timings: list[list[float]] = [[] for _ in calls]
    for _ in range(1 + _TIMES):
        for call, seconds in zip(calls, timings, strict=True):
            began = perf_counter()
            call()
            seconds.append(perf_counter() - began)
    return [seconds[1:] for seconds in timings]


def _kernels() -> dict[str, Any]:
    from benchmarks.kernels import scalar_reference  # which make builds; an installed wheel has none

    mesh = make("bridge-sharp")
    energy = MeshEnergy(mesh)
    x, hexes, m = energy.to_edge_units(mesh.points), mesh.hexes, mesh.n_hexes
    hessian, none = energy.hessian(x), energy.omitted
    gradient, shares, figures = energy.gradient(x), np.empty((m, 8, 3)), np.empty((4, m))
    matrix, right = hessian.assembled(), -gradient.ravel()
    folded, codes = UNIT_CUBE.copy(), np.empty(m, np.uint8)
    folded[4:, :2] *= [-2, -0.5]  # det J = 1 - 4.5 z (1 - z)
    with_folded, some_folded = np.concatenate([x, folded]), hexes.copy()
    some_folded[::100] = len(x) + np.arange(8)
    hex_mesh, colours = mesh.topology.hex_mesh, mesh.topology.colouring(mesh.free)
    settings = local.NodeStepSettings(
        local.Direction.STEEPEST_DESCENT, 0.0, ObjectiveNorm(), LineSearch(max_backtracks=60)
    )

    def sweep(by: Callable[..., object]) -> None:
        by(x.copy(), hex_mesh, colours.start, colours.items, settings)

    # Name, call of the kernel and of the scalar loop, number of repetitions in a call.
    rows: list[tuple[str, Callable[[], Any], Callable[[], Any] | None, float]] = [
        ("quality", lambda: elements.measure(x, hexes, *figures), None, 1),
        ("certificate, all valid", lambda: validity.certify(x, hexes, codes), None, 1),
        ("certificate, 1 % invalid inside", lambda: validity.certify(with_folded, some_folded, codes), None, 1),
        *(
            (name, lambda call=call: call(objective), lambda call=call: call(scalar_reference), 1)
            for name, call in (
                ("energy", lambda by: by.energies(x, hexes, 0.0, 1.0, none, figures[0])),
                ("gradient", lambda by: by.gradient(x, hexes, 0.0, ObjectiveNorm(), none, shares)),
                (
                    "hessian product, by formulas",
                    lambda by: by.hessian_product(x, hexes, energy.slots, gradient, 0.0, ObjectiveNorm(), none, shares),
                ),
            )
        ),
        ("hessian product, assembled", lambda: matrix @ right, None, 1),
        ("hessian, assembling", hessian.assembled, None, 1),
        ("conjugate gradients, an iteration", lambda: matrix.solve(right, 0.0, 20), None, 20),
        ("local sweep, steepest descent", lambda: sweep(local.sweep), lambda: sweep(scalar_reference.sweep), 1),
    ]
    all_threads, answer = threads(), {}
    try:
        for name, call, reference, times in rows:
            set_threads(1)
            single, *scalar = _seconds(call, *filter(None, [reference]))
            set_threads(all_threads)
            (threaded,) = _seconds(call)
            pairs = zip(single, *scalar, strict=True) if scalar else ()
            ratios = [slow * times / fast for fast, slow in pairs]
            low, middle, high = quantiles(ratios, n=4) if ratios else (None, None, None)
            answer[name] = {
                "ns_per_tetrahedron": median(single) / times / (8 * m) * 1e9,
                "ns_per_tetrahedron_all_threads": median(threaded) / times / (8 * m) * 1e9,
                "ns_per_tetrahedron_plain": median(scalar[0]) / (8 * m) * 1e9 if scalar else None,
                "ratio": middle,
                "ratio_quartiles": [low, high] if ratios else None,
            }
    finally:
        set_threads(all_threads)
    return {"hexes": m, "kernels": answer}


def _kernel_lines(figures: dict[str, Any]) -> list[str]:
    lines = [f"{'ns a corner tetrahedron':<36}{'scalar loop':>11}{'1 thread':>10}{'all':>8}{'ratio':>8}  quartiles"]
    for name, row in figures["kernels"].items():
        scalar = f"{row['ns_per_tetrahedron_plain']:11.1f}" if row["ns_per_tetrahedron_plain"] else " " * 11
        ratio = "{:7.1f}x  {:.1f} to {:.1f}".format(row["ratio"], *row["ratio_quartiles"]) if row["ratio"] else ""
        lines.append(
            f"{name:<36}{scalar}{row['ns_per_tetrahedron']:10.1f}{row['ns_per_tetrahedron_all_threads']:8.1f}{ratio}"
        )
    return lines


#: Numbers of hexes of the meshes for preconditioners.
_SIZES = (10_000, 100_000, 1_000_000)
#: Largest displacement of nodes from the optimum, in mean edge lengths.
_MOVED = 0.03
#: Relative residuals at which solvers end.
_RESIDUALS = (1e-3, 1e-6)


def _preconditioners() -> dict[str, Any]:
    rows = []
    for size in _SIZES:
        # Near the optimum, where the Hessian is definite: elsewhere the solver ends at the first negative curvature.
        stop = StoppingCriteria(max_iterations=1000)
        optimum = smooth(make("five-side", size=size), "mend", stop, progress=False, goal="shape").mesh
        mesh = scramble_nodes(optimum, _MOVED, seed=0)
        energy = MeshEnergy(mesh)
        x = energy.to_edge_units(mesh.points)
        right = -energy.gradient(x).ravel()
        for parts in (None, 1):
            energy.reduction.ordered_nodes = BlockSparsity(mesh, parts)
            made = energy.sparsity.bounds.size // 2
            name = "Gauss-Seidel, whole" if made == 1 else f"Gauss-Seidel, {made} parts"
            matrix = energy.hessian(x).assembled()
            for residual in _RESIDUALS:
                began = perf_counter()
                solved = matrix.solve(right, residual, 2000)
                row = {"hexes": mesh.n_hexes, "preconditioner": name, "residual": residual}
                row |= {"iterations": solved.iterations, "negative_curvature": bool(solved.negative_curvature)}
                rows.append(row | {"seconds": perf_counter() - began})
    return {"systems": rows}


def _preconditioner_lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{row['hexes']:>9,} hexes   {row['preconditioner']:<24} to {row['residual']:g}: "
        f"{row['iterations']:>4} iterations {row['seconds']:8.3f} s"
        + ("   ended at negative curvature" if row["negative_curvature"] else "")
        for row in figures["systems"]
    ]


KERNELS = BenchSection("kernels", "Kernels on bridge-sharp, 32,000 hexes (median of 15)", _kernels, _kernel_lines)
_TITLE = "Newton's system on five-side, moved by up to 0.03 edge lengths from its optimum"
PRECONDITIONERS = BenchSection("preconditioners", _TITLE, _preconditioners, _preconditioner_lines)
