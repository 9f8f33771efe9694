"""Values of every wrong type, shape and size for everything of the core that takes arrays or numbers of nodes and hexes.

Runs as a program of its own, since what it looks for would end the process: `python -m tests.core.hostile`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import hexmend as hx
from hexmend.boundary import ClosestPointTrees, SkinSurface, SlidingBoundary, boundary_of, classify
from hexmend.energy import MeshEnergy, energies
from hexmend.errors import HexmendError
from hexmend.mesh.edge_length import mean_edge_length
from hexmend.mesh.fixing import fix_outside, with_pinned
from hexmend.mesh.tags import with_tag
from hexmend.mesh.topology import Topology
from hexmend.quality import METRICS, corner_determinants, corner_qualities, locked_hexes, rank_worst
from hexmend.smoothers.local.patch import partition_patches
from tests.core.energy.projected import projected_energy
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(3), 0.2)
X, H, N, M = MESH.points, MESH.hexes, MESH.n_nodes, MESH.n_hexes
QUALITY = hx.measure(X, H)
INSIDE = np.flatnonzero(MESH.free)
FACES = MESH.topology.boundary_faces
ENERGY = MeshEnergy(MESH)
SKIN = SkinSurface(X, FACES)
SLIDING = SlidingBoundary(MESH)
MATRIX = ENERGY.hessian(ENERGY.to_edge_units(X)).assembled()
SLIDING_HESSIAN = projected_energy(SLIDING).hessian(ENERGY.to_edge_units(X))


@dataclass(frozen=True)
class YieldsAnything(hx.Smoother):
    """Third-party method that yields arbitrary values as points."""

    name = "yields"
    title = "YieldsAnything"
    help = "Gives anything for points."
    source = "nobody"
    value: object = None

    def steps(self, mesh):
        yield hx.Step(mesh.points)
        yield hx.Step(self.value)


def run(value: object) -> None:
    hx.smooth(MESH, YieldsAnything(value), max_iterations=2)


#: Calls that are given wrong values.
CALLS: dict[str, Callable[[object], object]] = {
    "Mesh, points": lambda v: hx.Mesh(v, H),
    "Mesh, hexes": lambda v: hx.Mesh(X, v),
    "Mesh, both": lambda v: hx.Mesh(v, v),
    "Mesh, pinned": lambda v: hx.Mesh(X, H, pinned=v),
    "Mesh, mid_nodes": lambda v: hx.Mesh(X, H, mid_nodes=v),
    "Mesh, cells": lambda v: hx.Mesh(X, H, cells=(hx.Cells("quad", v),)),
    "Mesh, kind of cells": lambda v: hx.Mesh(X, H, cells=(v,)),
    "Mesh, all cells": lambda v: hx.Mesh(X, H, cells=v),
    "Mesh, data of cells": lambda v: hx.Mesh(X, H, cells=(hx.Cells("quad", FACES, {"a": v}),)),
    "Mesh, set of cells": lambda v: hx.Mesh(X, H, cells=(hx.Cells("quad", FACES, {}, {"a": v}),)),
    "Mesh, tables of cells": lambda v: hx.Mesh(X, H, cells=(hx.Cells("quad", FACES, v, v),)),
    "Mesh, table": lambda v: hx.Mesh(X, H, node_sets=v),
    **{
        f"Mesh, {table}": lambda v, table=table: hx.Mesh(X, H, **{table: {"a": v}})
        for table in ("node_data", "hex_data", "node_sets", "hex_sets", "side_sets")
    },
    "with_points": MESH.with_points,
    "with_fixed": MESH.with_fixed,
    "rebuilt": lambda v: MESH.rebuilt(hexes=v),
    "replace": lambda v: MESH.replace(hex_sets={"a": v}),
    "quality": MESH.quality,
    "worst": MESH.worst,
    "smooth": hx.smooth,
    "smooth, yielding": run,
    "measure, points": lambda v: hx.measure(v, H),
    "measure, hexes": lambda v: hx.measure(X, v),
    "locked, fixed": lambda v: locked_hexes(X, H, v, QUALITY.inverted),
    "locked, inverted": lambda v: locked_hexes(X, H, MESH.fixed, v),
    "corner_determinants": lambda v: corner_determinants(X, v),
    "corner_determinants, which": lambda v: corner_determinants(X, H, v),
    "corner_qualities": lambda v: corner_qualities(X, v),
    "rank_worst, values": lambda v: rank_worst(v, QUALITY, 3),
    **{f"{name}, hexes": lambda v, of=one.of: of(X, v, QUALITY) for name, one in METRICS.items()},
    **{f"{name}, points": lambda v, of=one.of: of(v, H, QUALITY) for name, one in METRICS.items()},
    "mean_edge_length": lambda v: mean_edge_length(X, v),
    "energies": lambda v: energies(X, v),
    "energies, left out": lambda v: energies(X, H, omitted=v),
    "MeshEnergy, left out": lambda v: MeshEnergy(MESH, omitted=v).value(ENERGY.to_edge_units(X)),
    "MeshEnergy.value": ENERGY.value,
    "MeshEnergy.gradient": ENERGY.gradient,
    "MeshEnergy.hessian": lambda v: ENERGY.hessian(v).assembled(),
    "MeshEnergy.to_mesh_units": ENERGY.to_mesh_units,
    "MeshEnergy.moved": lambda v: ENERGY.moved(ENERGY.to_edge_units(X), v),
    "Hessian": lambda v: ENERGY.hessian(ENERGY.to_edge_units(X)).matvec(v),
    "Assembled": lambda v: MATRIX.matvec(v),
    "Assembled.solve": lambda v: MATRIX.solve(v, 1e-3, 5),
    "SlidingHessian": lambda v: SLIDING_HESSIAN.matvec(v),
    "SlidingHessian, assembled": lambda v: SLIDING_HESSIAN.assembled().matvec(v),
    "parameter, number": lambda v: hx.LocalSteepestDescent(surface_tolerance=v),
    "parameter, choice": lambda v: hx.LocalSteepestDescent(boundary=v),
    "Topology": lambda v: Topology(v, N).node_corners,
    "colouring": MESH.topology.colouring,
    "wavefronts": MESH.topology.wavefronts,
    "levels": MESH.topology.levels,
    "hexes_around": lambda v: MESH.topology.hexes_around(v, 1),
    "SkinSurface, points": lambda v: SkinSurface(v, FACES),
    "SkinSurface, faces": lambda v: SkinSurface(X, v),
    "SkinSurface.closest": SKIN.closest,
    "SkinSurface.with_points": SKIN.with_points,
    "ClosestPointTrees": lambda v: ClosestPointTrees(X, v, np.zeros(3, int)),
    "ClosestPointTrees, group": lambda v: ClosestPointTrees(X, FACES[:, :3], v),
    "classify": lambda v: classify(X, v),
    "boundary_of, corners": lambda v: boundary_of(MESH, corners=v),
    "boundary_of, sharp": lambda v: boundary_of(MESH, sharp=v),
    "SlidingBoundary.project": SLIDING.project,
    "SlidingBoundary.flipped_quads": lambda v: SLIDING.flipped_quads(X, v),
    "MeshEnergy.gradient, sliding": lambda v: projected_energy(SLIDING).gradient(v),
    "with_pinned": lambda v: with_pinned(MESH, v),
    "fix_outside": lambda v: fix_outside(MESH, v),
    "with_tag": lambda v: with_tag(MESH, "a", v),
    "partition_patches": lambda v: partition_patches(MESH, v, 1),
}

SHAPES = st.sampled_from(
    [(), (0,), (1,), (N,), (M,), (0, 8), (M, 8), (1, 8), (N, 3), (1, 3), (M, 19), (3, 4), (2, 2, 2)]
)
NUMBERS = st.sampled_from([0, 1, 2, -1, -2, 7.5, N, M, 2**31, -(2**40), 1e300, np.nan, np.inf, -np.inf])
TYPES = st.sampled_from(
    [bool, np.int8, np.int32, np.int64, np.uint64, np.float16, np.float64, complex, "U3", "S3", object]
)


@st.composite
def arrays(draw: st.DrawFn) -> np.ndarray:
    """Array of any shape and type, of one number with another at one position."""
    shape, number, odd, dtype = draw(SHAPES), draw(NUMBERS), draw(NUMBERS), draw(TYPES)
    with np.errstate(all="ignore"):
        array = np.full(shape, number, dtype=float)
        if array.size:
            array.flat[draw(st.integers(0, array.size - 1))] = odd
        return array.astype(dtype) if dtype is not complex else array + 1j


ODD = st.sampled_from(
    [None, "mesh", "", b"x", {}, {"a": 1}, [[0, 1], [2]], [None] * 8, object(), 10**30, -1, N, M, True]
)
NEAR = st.sampled_from(
    [np.where(np.arange(M)[:, None] == 5, odd, H) for odd in (np.nan, 7.5, -1, N, 2**31, 2**32, np.inf)]
)


@settings(max_examples=1800, deadline=None, derandomize=True, database=None)
@given(st.sampled_from(sorted(CALLS)), st.one_of(arrays(), ODD, NEAR))
def nothing_crashes(name: str, value: object) -> None:
    """Every call accepts the value, or raises an error of one sentence."""
    try:
        with np.errstate(all="ignore"):
            CALLS[name](value)
    except (HexmendError, TypeError) as error:
        words = str(error)
        assert words, f"{name} says nothing about {value!r}"
        assert "\n" not in words, f"{name} of {value!r} says several lines: {words}"


if __name__ == "__main__":
    nothing_crashes()
