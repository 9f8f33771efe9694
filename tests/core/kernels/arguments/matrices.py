"""Arguments of kernels of the energy, of its matrices, and of linear programs."""

from collections.abc import Iterator

import numpy as np

from hexmend.kernels import conjugate_gradients
from tests.core.kernels.arguments.rows import Row, case, row


def rows() -> Iterator[Row]:
    yield from _energies()
    yield from _patterns()
    yield from _matrices()


def _energies() -> Iterator[Row]:
    m, k, sparsity = case().m, case().k, case().sparsity
    blocks = {"off_diagonal": sparsity.blocks + 1, "diagonal": k}
    yield row("target.TargetMatrices", listed="inverse_lengths", inverse_lengths=m, size_weight=0.0)
    yield row("objective.energies", "points", eta=m)
    yield row("objective.gradient", "points", shares=m)
    yield row("objective.hessian_product", "points values", slots=sparsity.slots, values=k, shares=m)
    yield row("objective.gather", shares=8 * m, rows=k)
    bands = {"jacobian_band": 0.1, "quality_band": 0.1, "weight": 1.0}
    yield row("floor_barrier.Floors", jacobians=m, qualities=m, ignored=m, **bands)
    yield row("floor_barrier.qualities", "points", values=m)
    yield row("floor_barrier.values", "points", values=m)
    yield row("floor_barrier.add_gradient", "points", shares=m)
    yield row("floor_barrier.assemble", **blocks)
    yield row("assembly.assemble", **blocks)
    yield row("assembly.assemble_packed", first_separator=k, **blocks)


def _patterns() -> Iterator[Row]:
    m, k, sparsity = case().m, case().k, case().sparsity
    slots, pattern = sparsity.slots, {"row_start": sparsity.row_start, "columns": sparsity.columns}
    slot_of_node = np.full(case().n, -1)
    slot_of_node[sparsity.nodes] = np.arange(k)
    halves = {"bounds": [0, k // 2, k], "start": [0, m, 2 * m], "numbers": np.tile(np.arange(m), 2)}
    yield row("assembly.HexShares", "hexes slots", slots=slot_of_node, **halves, **pattern)
    yield row("conjugate_gradients.BlockPattern", bounds=sparsity.bounds, **pattern)
    aggregates = dict(zip(("aggregate", "row_start", "columns"), sparsity.aggregates(1), strict=True))
    yield row("conjugate_gradients.CoarsePattern", **aggregates)
    given = {"slots": slots, "slot_of_node": slot_of_node, "distance": 1}
    yield row("conjugate_gradients.coarse_pattern", "nodes", **given)
    yield row("ordering.slots", listed="hexes", parts=1)
    yield row("sparsity.pattern", "nodes", slots=slots, opposite=True, max_items=1000)


def _matrices() -> Iterator[Row]:
    k, sparsity = case().k, case().sparsity
    order, pattern, size = sparsity.order, sparsity.pattern, sparsity.blocks + 1
    matrix = {"pattern": pattern, "off_diagonal": size, "diagonal": k}
    family, two = "conjugate_gradients", [0, 1]
    yield row(f"{family}.complete_diagonal", **matrix)
    yield row(f"{family}.product", order=order, x=k, y=k, **matrix)
    limits = {"damping": 0.0, "tolerance": 0.1, "max_iterations": 2, "ghosts": 0}
    none = {"sum": None, "exchange": None, "coarse": None}
    work = conjugate_gradients.workspace_size(pattern)
    yield row(f"{family}.solve", rhs=k, x=k, work=work, **matrix, **limits, **none)
    yield row(f"{family}.to_slots", of_nodes=k, order=order, scale=1.0, of_slots=k)
    yield row(f"{family}.from_slots", of_nodes=k, order=order, scale=1.0, of_slots=k)
    yield row(f"{family}.turn_blocks", "turn off_diagonal", turn=k, at=two, rows=2, columns=2, off_diagonal=size)
    yield row(f"{family}.turn_diagonal", "diagonal", turn=2, slots=two, diagonal=k)
    yield row(f"{family}.project_diagonal", "diagonal", projectors=2, slots=two, diagonal=k)
