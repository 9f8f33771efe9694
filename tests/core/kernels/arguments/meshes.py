"""Arguments of kernels of meshes: metrics, incidence, rows, structure."""

from collections.abc import Iterator

import numpy as np

from tests.core.kernels.arguments.rows import Row, case, row


def rows() -> Iterator[Row]:
    yield from _metrics()
    yield from _incidence()
    yield from _structure()


def _metrics() -> Iterator[Row]:
    n, m, k = case().n, case().m, 10
    yield row("elements.measure", "points", q=m, sigma=m, jacobian=m, eta=m)
    yield row("elements.measure_against", "points", q=m, eta=m)
    yield row("elements.mean_edge_length", "points", "hexes")
    yield row("elements.lower_to_edges", listed="hexes", lengths=n)
    yield row("elements.corner_qualities", "points", q=m)
    yield row("elements.corner_determinants", "points", sigma=m)
    yield row("elements.corner_jacobians", "points", jacobians=m)
    yield row("faces.angles", "points", smallest=m, largest=m)
    yield row("faces.warpage", "points", worst=m)
    yield row("faces.volume", "points", enclosed=m)
    yield row("metrics.lengths", "points", edge_ratio=m, stretch=m, diagonal=m)
    yield row("metrics.axes", "points", aspect_ratio=m, skew=m, taper=m)
    yield row("metrics.corners", "points", shape=m, condition=m)
    yield row("metrics.centre", "points", jacobian=m)
    yield row("validity.certify", "points", validity=m)
    yield row("validity.jacobian_bounds", "points", bounds=m)
    yield row("validity.jacobian_coefficients", "points", coefficients=m)
    yield row("validity.least_jacobian", "points", "hexes")
    yield row("validity.certify_quadratic", nodes=k, validity=k)
    yield row("validity.jacobian_bounds_quadratic", nodes=k, bounds=k)
    yield row("validity.least_jacobian_quadratic", listed="nodes", nodes=k)


def _incidence() -> Iterator[Row]:
    n, nodes = case().n, case().nodes
    yield row("hex_mesh.HexMesh")
    yield row("incidence.node_corners", listed="hexes", n=n)
    yield row("incidence.face_neighbours", opposed=True)
    yield row("incidence.overlapping_corners")
    yield row("incidence.join", "parent", empty="items", parent=np.arange(n), items=[1, 2, 3, 4], width=2)
    yield row("incidence.node_rings", max_items=1000)
    yield row("incidence.greedy_colours", chosen=n)
    yield row("incidence.grouped", listed="colour", colour=n, count=1)
    yield row("wavefronts.levels", start=n)
    yield row("wavefronts.wavefronts", listed="sequence", sequence=nodes)


def _structure() -> Iterator[Row]:
    n, k = case().n, 10
    yield row("structure.edges", max_items=1000)
    yield row("structure.average_along_sheets", listed="groups", groups=k, values=k, average=k, count=k)
    yield row("structure.coarse_blocks")
    yield row("structure.interpolate_blocks", listed="blocks", blocks=1, kept=n, values=n)
