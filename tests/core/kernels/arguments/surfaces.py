"""Arguments of kernels of surfaces: closest points, samples, sliding boundaries, fits."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from hexmend.kernels.closest_point import (
    BandSamples,
    BoxTrees,
    ClosestPointCache,
    NearPoints,
    build_trees,
    edges_of_faces,
)
from hexmend.kernels.sliding_surface import BoundaryQuads
from hexmend.kernels.surface_fit import FitSamples
from tests.core.kernels.arguments.rows import Row, case, row


@cache
def _trees() -> dict[str, Any]:
    """The tree of the boundary's faces, each divided into four triangles around its centre."""
    faces, n = case().faces, case().n
    points = np.concatenate([case().mesh.points, case().mesh.points[faces].mean(axis=1)])
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    pieces = np.column_stack([sides, n + np.repeat(np.arange(len(faces)), 4)]).astype(np.int32)
    order, boxes, links, _ = build_trees(points, pieces, np.array([0, len(pieces)], np.int32))
    return {"points": points, "pieces": pieces[order], "boxes": boxes, "links": links}


def rows() -> Iterator[Row]:
    yield from _closest_points()
    yield from _samples()
    yield from _points_and_edges()
    yield from _sliding()
    yield from _fit()


def _closest_points() -> Iterator[Row]:
    given, j = _trees(), 5
    trees, roots = BoxTrees(**given), np.zeros(j, np.int32)
    found = {"piece": j, "places": j, "weights": j}
    query = {"trees": trees, "x": j, "roots": roots}
    start = [0, 4, len(given["pieces"])]
    yield row("closest_point.BoxTrees", "points pieces", **given)
    yield row("closest_point.ClosestPointCache", listed="roots", trees=trees, roots=roots)
    cache = ClosestPointCache(trees, roots)
    yield row("closest_point.ClosestPointCache.closest", of=cache, slots=np.arange(j), x=j, **found)
    yield row("closest_point.build_trees", "points", points=given["points"], pieces=given["pieces"], start=start)
    yield row("closest_point.refit", "points pieces", **given)
    yield row("closest_point.closest", enough=0.0, **query, **found)


def _samples() -> Iterator[Row]:
    given, faces, n, f, j = _trees(), case().faces, case().n, case().f, 5
    roots, places = np.zeros(j, np.int32), np.zeros((j, 3))
    near = NearPoints(roots, places, places, roots)
    query = {"examined": j, "limits": j, "near": near}
    yield row("closest_point.NearPoints", piece=j, weights=j, places=j, roots=j)
    yield row("closest_point.means_beyond", "points", trees=BoxTrees(**given), samples=faces[:j], beyond=j, **query)
    yield row("closest_point.samples_beyond", "points pieces", x=j, **query, **given)
    on_faces = {"boundary": faces, "faces": faces, "face_of_piece": 4 * f, "pieces": j}
    yield row("closest_point.BandSamples", "faces face_of_piece", "boundary pieces", **on_faces)
    samples = BandSamples(faces, faces, np.zeros(4 * f, np.int64), roots)
    marks = {"boundary_before": f, "surface_before": j, "boundary": f, "surface": j}
    yield row("closest_point.moved_samples", samples=samples, points=n, earlier=n, **marks)


def _points_and_edges() -> Iterator[Row]:
    given, faces, n, f = _trees(), case().faces, case().n, case().f
    _, sides, first = edges_of_faces(faces.ravel(), 4, n)
    quads = {"faces": faces.ravel(), "width": 4, "nodes": n}
    corners = {"triangles": given["pieces"], "patch": 4 * f, "normals": 12 * f}
    yield row("closest_point.numbers_of_different_points", listed="points")
    yield row("closest_point.edges_of_faces", empty="faces", **quads)
    yield row("closest_point.count_fans", sides=sides, first=first, **quads)
    edges = {"edges": [[0, 1], [1, 2]], "start": [0, 1, 3, 4], "ends": [0, 1, 2, 3], "values": 2}
    yield row("closest_point.quantiles_around", listed="some", some=[0, 1], most=1.0, share=0.5, **edges)
    yield row("closest_point.vertex_normals", "points", points=given["points"], **corners)
    yield row("closest_point.means", "points", nodes=faces, x=f)


def _sliding() -> Iterator[Row]:
    trees, faces, n, f = BoxTrees(**_trees()), case().faces, case().n, case().f
    outward, start = np.zeros((f, 3)), np.array([0, 1, 2], np.int32)
    quads = BoundaryQuads(start, start[:2], faces, outward)
    cache = ClosestPointCache(trees, np.zeros(2, np.int32))
    yield row("sliding_surface.BoundaryQuads", start=start, corners=start[:2], quads=faces, outward=f)
    yield row("sliding_surface.SlidingSurface", listed="slots", slots=n, cache=cache, quads=quads)
    yield row("sliding_surface.SurfaceTerm", counted=f, normals=f, inverse_lengths=f, weight=1.0, delta=0.1)
    yield row("sliding_surface.flipped_quads", before=n, after=n, quads=faces, outward=f, flipped=f)
    directions = {"number": 4, "flat": 4, "smooth": 4, "interior": 0.1}
    closest = {"pieces": n, "weights": n, "of_curve": n}
    yield row("sliding_surface.tangent_bases", "number", bases=n, **directions, **closest)
    yield row("sliding_surface.tangent_projectors", bases=n, projectors=n)


def _fit() -> Iterator[Row]:
    given, faces, k, sparsity = _trees(), case().faces, case().k, case().sparsity
    trees, roots, j, t = BoxTrees(**given), np.zeros(5, np.int32), 5, 3
    surface, directions = ClosestPointCache(trees, roots), np.zeros((len(given["pieces"]), 3))
    first = {"nodes": faces[:j], "first": np.zeros((j, 3)), "slots": np.arange(j, dtype=np.int32), "roots": roots}
    on_surface = {"surface": surface, "directions": directions, "faces": faces}
    yield row("surface_fit.FitSamples", "nodes directions faces", **first, **on_surface)
    found = {"distances": j + t, "vectors": j + t, "directions": j + t, "weights": j + t}
    samples = FitSamples(**first, **on_surface)
    known = np.full(t, -1)
    compared = {"samples": samples, "moving": trees, "rows": np.arange(j + t), "known": known, "nodes": j + t}
    yield row("surface_fit.distances", listed="rows", **compared, **found)
    yield row("surface_fit.add_gradient", "gradient", nodes=j, weights=j, vectors=j, gradient=case().n)
    pattern = {"row_start": sparsity.row_start, "columns": sparsity.columns}
    blocks = {"off_diagonal": sparsity.blocks + 1, "diagonal": k}
    costs = {"first": j + t, "second": j + t, "of_line": j + t}
    yield row("surface_fit.hessian", slots=j + t, **found, **costs, **pattern, **blocks)
