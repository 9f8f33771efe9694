"""Arguments of kernels of smoothing methods."""

from collections.abc import Iterator

import numpy as np

from hexmend.kernels import local, patches, worst_first
from hexmend.kernels.line_search import LineSearch
from hexmend.kernels.sliding_surface import SurfaceTerm
from tests.core.kernels.arguments.rows import Row, case, common, row


def rows() -> Iterator[Row]:
    yield from _geometric()
    yield from _local()
    yield from _patches()


def _geometric() -> Iterator[Row]:
    n, m, k = case().n, case().m, case().k
    yield row("element_step.element_steps", "points", s=0.1, rho=0.5, places=m)
    yield row("getme.weighted_means", listed="nodes", places=m, weights=m, targets=n)
    yield row("getme.relax", listed="harmed", valid=m, harmed=2, moved=n)
    settings = worst_first.WorstFirstSettings(0.5, 0.5, 0.1, 0.1)
    yield row("worst_first.sweep", listed="candidates", candidates=[0, 1], q=m, valid=m, settings=settings)
    yield row("laplacian.in_place", listed="nodes")
    yield row("laplacian.simultaneous", listed="nodes", moved=n)
    yield row("laplacian.smart_sweep", listed="nodes", keep_least_quality=True)
    yield row("step_limits.shorten", step=k, reach=1.0)
    yield row("step_limits.displaced", step=k, alpha=1.0, moved=n)


def _local() -> Iterator[Row]:
    f, mesh = case().f, case().mesh
    colours = mesh.topology.colouring(mesh.free)
    groups = {"groups": colours.start, "nodes": colours.items}
    term = SurfaceTerm(np.ones((f, 4), np.uint8), np.ones((f, 3)), None, 1.0, 0.1)
    yield row("local.sweep", tangents=case().sliding.tangents(mesh.points), term=term, **groups)
    star, x = common()["corners"][:1], (1.0, 0.0, 0.0)
    yield row("local.patch_energy", "points", "star", star=star, factor=0.0)
    yield row("local.recorded_step", "points", "star", star=star)
    yield row("local.energy_along", "points", "star curve", star=star, factor=0.0, direction=x, curve=2)


def _patches() -> Iterator[Row]:
    mesh, m = case().mesh, case().m
    node_start, nodes, hex_start, patch_hexes, slots = patches.partition(mesh.topology.hex_mesh, mesh.free, 4, 0)
    there = {"hexes": mesh.hexes[patch_hexes], "slots": slots, "hex_start": hex_start, "node_start": node_start}
    settings = local.NodeStepSettings(local.Direction.NEWTON, 0.1, (2.0, 1.0), LineSearch())
    one = {"groups": [0, 1], "patches": [0], "settings": settings}
    yield row("patches.partition", size=4, overlap=0)
    yield row("patches.colours", hex_start=hex_start, patch_hexes=patch_hexes, hexes=m)
    yield row("patches.PatchPartition", nodes=nodes, **there)
    yield row("patches.sweep", "points", partition=patches.PatchPartition(*there.values(), nodes), **one)
