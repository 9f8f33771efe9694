"""Hexahedral mesh: points, hexes, fixed nodes, and the sets and data of its file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, overload

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.hooks import hook
from hexmend.mesh.edge_length import mean_edge_length
from hexmend.mesh.element_target import Target
from hexmend.mesh.fields import check_cells
from hexmend.mesh.mesh_motion import NO_MOTION, SHARED, MeshMotion, TargetSurface
from hexmend.mesh.solid_cells import count_cells, same_solids
from hexmend.mesh.validation import check_finite, points_like
from hexmend.summary import Summary
from hexmend.terminal_text import count_phrase, printable

__all__ = ["Mesh", "TargetSurface"]

#: Fields from which the materials follow.
_OF_MATERIALS = {"hex_sets", "hex_data", "field_data", "cells"}


@dataclass(frozen=True, eq=False, repr=False)
class Mesh(MeshMotion):
    """Immutable mesh of hexes and other solid cells; a change returns a copy that shares everything else.

    Arrays are copied unless they are immutable: the caller's stay writable, and changes to them do not change the mesh.

    Parameters
    ----------
    points : (n, 3) float64
        Coordinates in any unit of length; kept read-only.
    hexes : (m, 8) int32
        Corner nodes from 0, numbered as in `hexmend.mesh.hexahedron`; kept read-only. There may be none if `cells` hold
        other solid cells.
    pinned : (n,) bool, optional
        Nodes that are fixed in addition to those of the boundary.
    node_data, hex_data : mapping of name to (n, ...) or (m, ...) array
        Ids, references and other values of the file.
    node_sets, hex_sets : mapping of name to (k,) int array
        Named groups of nodes and hexes.
    cells : tuple of Cells
        Cells of other kinds: tetrahedra, pyramids and wedges, which are `elements` beside the hexes; boundary quads
        with references, feature edges.
    name : str
        Name of the mesh; the file's stem.
    side_sets : mapping of name to (k, 2) int array
        Named groups of faces: the hex and the row of `hexmend.mesh.hexahedron.FACES`.
    mid_nodes : (m, 19) int32, optional
        Mid-nodes of second-order hexes, -1 where there is none; see `hexmend.mesh.second_order`. They follow the
        corners.
    field_data : mapping of name to array or list of str
        Values of the mesh as a whole.
    notes : tuple of str
        Changes made to the mesh on reading, as sentences.
    side_set_types : mapping of name to str
        Kinds of boundary that side sets are, by the names of OpenFOAM: wall, patch, symmetryPlane, empty, wedge...
    periodic_pairs : tuple of (str, str)
        Names of side sets of which one is a translated or rotated copy of the other.
    renumbered : str
        Hexes that were numbered left-handed in the file and have been renumbered on reading: "" for none, "parts" for
        whole parts of the mesh, "hexes" if some are unlike their neighbours.

    Raises
    ------
    MeshError
        For a coordinate that is not finite, a node number that is not whole or out of range, a set with members that
        do not exist, and an array of another shape or type (numbers that are booleans, complex or text).

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mesh = Mesh(UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 7]])
    >>> mesh.n_hexes, mesh.n_nodes, int(mesh.free.sum())
    (1, 8, 0)
    """

    @cached_property
    def mean_edge_length(self) -> float:
        """Mean edge length; see `hexmend.mesh.edge_length.mean_edge_length`."""
        return mean_edge_length(self.points, self.elements)

    @overload
    def quality(self) -> Summary: ...

    @overload
    def quality(self, metric: str) -> np.ndarray: ...

    def quality(self, metric: str | None = None) -> Summary | np.ndarray:
        """Return the values of a metric, or a summary of the mesh if none is named.

        Parameters
        ----------
        metric : str, optional
            Name in `hexmend.METRICS`, such as "q" or "scaled_jacobian"; underscores count as dashes.

        Returns
        -------
        Summary or (m,) float64
            Without a metric `hexmend.summarise` of the mesh, else a value for each hex.

        Raises
        ------
        ParameterError
            For a metric that does not exist; the message suggests the nearest.
        """
        return hook("summary")(self) if metric is None else hook("quality")(self, metric)

    def worst(self, count: int = 10, metric: str = "q") -> np.ndarray:
        """Return the numbers of the worst hexes by a metric, worst first; see `hexmend.quality.worst_hexes`."""
        return hook("worst_hexes")(self, count, metric)

    def region(
        self,
        *names: str,
        hexes: Sequence[int] | np.ndarray | None = None,
        box: Sequence[Sequence[float]] | np.ndarray | None = None,
        rings: int = 0,
    ) -> np.ndarray:
        """Return the numbers of the hexes of a region, ascending; see `hexmend.quality.selection.region`.

        Parameters
        ----------
        *names : str
            Names of materials and of sets, "inverted" or "invalid"; the hexes of all of them together.
        hexes : (k,) int or (m,) bool, optional
            Only hexes among these.
        box : ((x, y, z), (x, y, z)), optional
            Only hexes whose centre is in the box between two opposite corners.
        rings : int
            Rings of neighbours to be added, hexes that share a node with those before.

        Returns
        -------
        (k,) int64
            An index for `quality(metric)` and `elements`, which begin with `hexes`, and an argument of `plot` and
            `hexmend.fix_outside`.
        """
        return hook("region")(self, *names, hexes=hexes, box=box, rings=rings)

    @property
    def fixed_sets(self) -> tuple[str, ...]:
        """Names of the sets whose nodes all stay where they are, even if the boundary slides; see `hexmend.fix`."""
        return hook("fixed_sets")(self)

    def plot(self, metric: str = "q", *, hexes: Sequence[int] | np.ndarray | None = None, **options: Any) -> Any:
        """Show the mesh in the viewer's colours by PyVista; see `hexmend.notebook.plot`."""
        return hook("plot")(self, metric, hexes=hexes, **options)

    def __repr__(self) -> str:
        name = f" {printable(self.name)}" if self.name else ""
        cells, nodes = count_cells(self.elements), count_phrase(self.n_nodes, "node")
        known = self.__dict__.get("_invalid")  # once they have been counted
        return f"<Mesh{name}: {cells}, {nodes}{'' if known is None else f', {known:,} invalid'}>"

    def _repr_html_(self) -> str:
        """Return the HTML that a notebook shows."""
        return hook("html")(self)

    def with_points(self, points: np.ndarray) -> Mesh:
        """Return the mesh with other node positions; connectivity, topology, sets and data are shared.

        Mid-nodes of second-order cells follow the corners; their rows of `points` are not read.

        Parameters
        ----------
        points : (n, 3) float64
            Copied unless immutable, such as those of another mesh or of an iteration.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For another shape or type, and for a coordinate that is not finite.
        """
        points = points_like(points, self.points.shape)
        check_finite(points)
        return self._copy(*SHARED, points=as_immutable(self.with_mid_nodes_moved(points)))

    @property
    def element_target(self) -> Target | None:
        """Lengths that the hexes are to have; None if they are to be cubes. See `with_element_target`."""
        return self.__dict__.get("_element_target")

    def with_element_target(self, target: Target | None) -> Mesh:
        """Return the mesh with a target of its elements, which the energies of optimisers take from it.

        It is kept by meshes that are derived from this one, but not by `rebuilt`, which may have other hexes.

        Parameters
        ----------
        target : hexmend.mesh.element_target.Target or None
            None for cubes.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For a target of another number of hexes.
        """
        if target is not None and len(target.lengths) != self.n_elements:
            hexes = count_phrase(len(target.lengths), "hex", "hexes")
            raise MeshError(f"the target is for {hexes}: the mesh has {self.n_elements:,}")
        return self._copy(*SHARED, _element_target=target)

    def replace(self, **changes: object) -> Mesh:
        """Return a copy with other values of some fields, but not points or hexes; all else is shared.

        With other solid `cells` it is that of `rebuilt`.

        Parameters
        ----------
        **changes
            Values of fields by name.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For points or hexes, and for values that do not fit the mesh.
        TypeError
            For an unknown field.
        """
        if "points" in changes or "hexes" in changes:
            raise MeshError("replace() cannot change points or hexes: use with_points() or rebuilt()")
        if "cells" in changes:
            changes["cells"] = cells = check_cells(changes["cells"], self.n_nodes)
            if not same_solids(self.cells, cells):
                return self.rebuilt(**changes)
        unknown = changes.keys() - self._values().keys()
        if unknown:
            raise TypeError(f"a mesh has no {', '.join(sorted(unknown))}")
        copy = self._copy(*(() if changes.keys() & _OF_MATERIALS else ("materials",)))
        copy._set_checked(changes)
        return copy

    def rebuilt(self, **changes: Any) -> Mesh:
        """Return a new mesh with other values of any fields, points and hexes included; the rest is taken over.

        Other points may be other nodes: a linear motion is taken over only without them.
        """
        mesh = Mesh(**self._values() | changes)
        if self.target is not None:
            mesh._set(_target=self.target)
        if "_rules" in self.__dict__ and "hexes" not in changes:
            mesh._set(_rules=self.node_rules)
        if "points" not in changes:
            names = ("_linear",) if "hexes" in changes else ("_linear", "_linear_of_rules")
            for name in (name for name in names if name in self.__dict__):
                motion, start = self.__dict__[name]
                mesh._set(**{name: (motion.without_hanging().merge(mesh.hanging_motion), start)})
        return mesh

    @classmethod
    def of_cells(cls, points: np.ndarray, elements: np.ndarray, fixed: np.ndarray) -> Mesh:
        """Make the mesh of some cells for a computation, in which no node is searched that hangs.

        Parameters
        ----------
        points : (n, 3) float64
        elements : (m, 8) int32
            As of `elements`, of any kinds.
        fixed : (n,) bool
            The nodes that stay.

        Returns
        -------
        Mesh
        """
        return cls(points, elements).with_motion_of_rules(NO_MOTION).with_fixed(fixed)
