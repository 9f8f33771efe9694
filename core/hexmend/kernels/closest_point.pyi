"""
The closest point of a surface, by a tree of bounding boxes for each of its curves and patches.

A piece, a row of pieces (k, 3) int32, is a triangle (a, b, c) of points (n, 3), or a segment (a, b, b).
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


class BoxTrees:
    """Trees over pieces."""

    def __init__(self, points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], boxes: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu', writable=False)], links: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)]) -> None:
        """
        pieces (k, 3) int32 are in the order that `build_trees` returns, with its boxes (6 b, 4) float64 and
        links (b, 4) int32.
        """

class ClosestPointCache:
    """
    Pieces near to points that move little from one query to the next.

    They prove in most queries which point is the closest, without a search of the
    tree. Results do not depend on them.
    """

    def __init__(self, trees: BoxTrees, roots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """For a point in each slot, in the tree of its root (s,) int32."""

    def closest(self, slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], piece: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')], places: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
        """
        The point closest to each of x (j, 3), the points in slots (j,) int32.

        Writes the piece (j,) int32, -1 where x is not finite, the point on it (j, 3), and its barycentric
        weights in the piece (j, 3).
        """

def build_trees(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None, 4))], Annotated[NDArray[numpy.int32], dict(shape=(None, 4))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Trees over pieces: tree t is made of pieces[start[t]:start[t + 1]], one at least; start (t + 1,) int32.

    Returns the order (k,) int32 that the pieces are to be put in, boxes (6 b, 4) float64 and links (b, 4)
    int32 of the nodes of all trees, and the node that is the root of each, (t,) int32.
    """

def refit(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], links: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], boxes: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')]) -> None:
    """
    Write the boxes of trees whose points have moved; pieces are in the order that `build_trees` returns.
    """

def closest(trees: BoxTrees, x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], roots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], enough: float, piece: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')], places: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    The point closest to each of x (j, 3) in the tree of its root (j,).

    A point at a distance of at most `enough` counts as closest. Writes the piece (j,) int32, -1 where x is
    not finite, the point on it (j, 3), and its barycentric weights in the piece (j, 3). On entry, piece has
    one of the tree that is near and shortens the search, or -1.
    """

class NearPoints:
    """Points that were near samples before."""

    def __init__(self, piece: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], places: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], roots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        The piece (s,) int32 on which each lies, -1 for none, its barycentric weights there (s, 3), and its
        position (s, 3), infinite for none; the root (s,) int32 of the tree that is searched for each. All
        but the roots are written.
        """

def means_beyond(trees: BoxTrees, points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], samples: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], examined: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], limits: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], near: NearPoints, beyond: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Write beyond (s,) bool: True where the mean of the four points of a row of samples (s, 4) int32, which
    must exist, is further from its tree than its limit (s,). False where examined (s,) bool is.
    Points that are found become the near ones.
    """

def samples_beyond(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], links: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], boxes: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], examined: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], limits: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], near: NearPoints) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    The numbers, ascending int32, of the examined (s,) bool of x (s, 3) that are further than their limits (s,)
    from their trees, whose points have moved.

    Boxes are written where a search is needed. Points that are found become the near ones, without their
    positions.
    """

class BandSamples:
    """Samples of a boundary and of the surface on which it slides."""

    def __init__(self, boundary: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], faces: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], face_of_piece: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        A sample of the boundary is the mean of four nodes, boundary (s, 4) int32. A sample of the surface is
        near to one of pieces (t,) int32, -1 for none, of a face of the boundary, faces (f, 4) int32 by
        face_of_piece (p,) int64. Numbers must exist.
        """

def moved_samples(samples: BandSamples, points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], earlier: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], boundary_before: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], surface_before: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], boundary: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')], surface: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Mark samples of the boundary, boundary (s,) bool, and of the surface, surface (t,) bool: the samples marked
    before, and those with a node that differs between points and earlier, both (n, 3). The nodes of a sample of
    the surface are the nodes of the face near to it.
    """

def numbers_of_different_points(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    The number (n,) int32 of each of points (n, 3) among the different ones, in the order in which they first
    appear.
    """

def edges_of_faces(faces: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int, nodes: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None, 2))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    The edges of faces: nodes (e, 2) int32, the lower one first, ascending; the sides on each (s,) int32,
    ascending; and where those of each edge begin, (e + 1,) int32.

    faces (k * width,) int32 are the nodes of faces one after the other, below `nodes`; its side s runs from
    the node in place s to the next of the face. A side between equal nodes lies on no edge.
    """

def count_fans(faces: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int, sides: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    The number of fans at each of `nodes` nodes, faces connected by edges (nodes,) int32.

    faces (k * width,) int32 are the nodes of faces one after the other; its side s runs from the node in
    place s to the next of the face. Edge e has sides[first[e]:first[e + 1]], all int32.
    """

def quantiles_around(edges: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ends: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], some: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], most: float, share: float) -> Annotated[NDArray[numpy.float64], dict(shape=(None,))]:
    """
    Quantile of the values around each of some edges (s,) int32, (s,) float64.

    Around an edge are those at its two nodes and at the neighbours of these, without the edge itself and
    without values above `most`; the quantile is 0 where none is left. edges (e, 2) int32 have values (e,);
    those at node i are ends[start[i]:start[i + 1]] // 2. A share of the values is less than the quantile.
    """

def vertex_normals(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], triangles: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], patch: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Write the unit normals (3 t, 3) at the corners of each of triangles (t, 3) int32: the mean over those of the
    same patch (t,) int32 at the vertex, weighted by their angles; 0 where they have none.
    """

def means(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Write the mean (j, 3) of the four points of each row of nodes (j, 4) int32, which must exist.
    """
