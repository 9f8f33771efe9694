"""Benchmark of the remarks that sections 4.1.2 and 4.1.3 of the thesis make on local and global methods."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from benchmarks.scale.memory import measure_memory
from benchmarks.section import BenchSection
from hexmend.energy import MeshEnergy
from hexmend.energy.norm import ObjectiveNorm
from hexmend.gallery import make
from hexmend.kernels import local
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.linear_solvers import Minres
from hexmend.quality import measure
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers import METHODS

#: Bytes of a number of a sparse matrix and of its index, as section 4.1.2 counts them.
_NUMBER, _INDEX = 8, 4

#: Hexes of the meshes: of FiveSide6 for memory and solutions, of the two copies of different size.
_SIZE, _COPY = 44_400, 2_625

#: The objective of chapter 4: p = 2 without the "-1" of (B.20).
_SQUARES = ObjectiveNorm(2.0, 0.0)

#: Iterations after which inverted hexes are counted.
_ITERATIONS = 10

#: Factor between the sizes of the copies.
_FACTOR = 100.0


class Remark(NamedTuple):
    """Remark of the thesis with the figures that were measured about it."""

    section: str
    remark: str
    measured: str


def _measure() -> dict[str, Any]:
    mesh = make("five-side", size=_SIZE)
    remarks = [*_assembling(mesh), _memory(), _accuracy(mesh), _scaling()]
    return {"hexes": mesh.n_hexes, "remarks": [remark._asdict() for remark in remarks]}


def _assembling(mesh: Mesh) -> Iterator[Remark]:
    """4.1.2: numbers with indices of all corner tetrahedra over those of the Hessian, by free nodes."""
    tetrahedra = mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]]  # (m, 8, 4)
    contributions = int((tetrahedra.sum(axis=2) ** 2).sum())
    at_nodes = int(tetrahedra.sum())
    energy = MeshEnergy(mesh, _SQUARES)
    diagonal, above = energy.nodes.size, energy.sparsity.blocks
    blocks = diagonal + 2 * above
    share = (_NUMBER + _INDEX) / _NUMBER
    yield Remark(
        "4.1.2",
        "Storing and assembling the contributions of the tetrahedra takes about 50 times the memory of the Hessian: "
        "32 numbers with an index for each of its own.",
        f"five-side, {mesh.n_hexes:,} hexes: {at_nodes / diagonal:.1f} contributions to each block of the diagonal, "
        f"with indices {share * at_nodes / diagonal:.0f} times its memory; {contributions / blocks:.1f} to a block on "
        f"average, {share * contributions / blocks:.1f} times. Here contributions are added to the matrix at once.",
    )


def _memory() -> Remark:
    """4.1.3: peak memory of a local and a global method in addition to the mesh."""
    one, all_ = (measure_memory(name, _SIZE, 3) for name in ("local-nr", "global-nr"))
    return Remark(
        "4.1.3",
        "Solving many small systems instead of one large one requires less memory.",
        f"cube, {one['hexes']:,} hexes: local-nr {one['mb']:.0f} MiB, global-nr {all_['mb']:.0f} MiB in addition to "
        "the mesh.",
    )


def _accuracy(mesh: Mesh) -> Remark:
    """4.1.3: residuals of the Newton systems of all nodes, solved directly, and of the global one by MINRES."""
    method: Any = METHODS["local-nr"]
    residuals = []
    for node in np.flatnonzero(mesh.free).tolist():
        star = mesh.topology.node_corners[node]
        patch = local.patch_energy(mesh.points, mesh.hexes, star, 0.0, 0.0, _SQUARES)
        step = local.recorded_step(mesh.points, mesh.hexes, star, method(offset=0.0).step_settings(0.0))
        if not step.fallback and step.status is local.StepStatus.MOVED:
            xx, xy, xz, yy, yz, zz = patch.hessian
            hessian, gradient = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), np.array(patch.gradient)
            residuals.append(np.linalg.norm(hessian @ step.direction + gradient) / np.linalg.norm(gradient))
    energy = MeshEnergy(mesh, _SQUARES)
    x = energy.to_edge_units(mesh.points)
    of_all, gradient = energy.hessian(x, 0.0), energy.gradient(x, 0.0).ravel()
    solver = Minres()
    solution, iterations = solver(of_all, -gradient)
    left = np.linalg.norm(of_all.assembled(np.float64).matvec(solution) + gradient) / np.linalg.norm(gradient)
    return Remark(
        "4.1.3",
        "Directly solving the small linear systems is more accurate than the iterative solution of the large one.",
        f"five-side, {mesh.n_hexes:,} hexes, residual over gradient: {np.median(residuals):.1g} in the median of "
        f"{len(residuals):,} nodes, at most {max(residuals):.1g}; by MINRES {left:.1g} after {iterations:,} "
        "iterations.",
    )


def _scaling() -> Remark:
    """4.1.3: inverted hexes that are left in two copies of a mesh, one of them much smaller."""
    mesh = make("five-side", size=_COPY, scramble=0.6)
    small = mesh.points / _FACTOR + [2 * np.ptp(mesh.points[:, 0]), 0, 0]
    both = Mesh(np.concatenate([mesh.points, small]), np.concatenate([mesh.hexes, mesh.hexes + mesh.n_nodes]))
    counts, stop = [], StoppingCriteria(max_iterations=_ITERATIONS)
    for name, values in (("local-sd", dict[str, Any]()), ("global-mnr", {"delta_unit": "mesh"})):
        result = smooth(both, name, stop, progress=False, delta=0.01, offset=0.0, **values)
        inverted = measure(result.mesh.points, both.hexes).inverted
        counts.append(f"{name} {inverted[: mesh.n_hexes].sum():,} and {inverted[mesh.n_hexes :].sum():,}")
    before = measure(mesh.points, mesh.hexes).inverted.sum()
    return Remark(
        "4.1.3",
        "Scaling each patch normalises the influence of delta, so that local methods suit meshes of elements of "
        "different sizes.",
        f"Two copies of five-side with {mesh.n_hexes:,} hexes each, the second {_FACTOR:g} times smaller, {before:,} "
        f"inverted in each: after {_ITERATIONS} iterations left in the first and the second {', '.join(counts)}.",
    )


def _lines(figures: dict[str, Any]) -> list[str]:
    rows = [f"| {one['section']} | {one['remark']} | {one['measured']} |" for one in figures["remarks"]]
    return ["| section | remark | measured |", "|:---|:---|:---|", *rows]


REMARKS = BenchSection("remarks", "What 4.1.2 and 4.1.3 of the thesis remark, measured", _measure, _lines)
