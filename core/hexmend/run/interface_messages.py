"""Messages about the interfaces between the materials of a mesh."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.material_volumes import MaterialVolume
from hexmend.terminal_text import count_phrase

#: Displacements below this share of the mean edge length are rounding.
_ROUNDING = 1e-9


def describe_interfaces(mesh: Mesh, interfaces: str = "") -> str:
    """Describe the interfaces of a mesh, and what its rules make of them; "" for one material.

    Parameters
    ----------
    mesh : Mesh
    interfaces : str
        Rule for the interfaces in place of that of the mesh; the sentence does not name options then.

    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=64).replace(hex_sets={"low": np.arange(32), "high": np.arange(32, 64)})
    >>> describe_interfaces(cube)
    '2 materials; 9 nodes on their interfaces are kept (--interfaces slide or free lets them move).'
    """
    materials = mesh.materials
    if materials is None:
        return ""
    nodes = count_phrase(_inner_nodes(mesh).size, "node on their interfaces is", "nodes on their interfaces are")
    fates = {"keep": "kept", "slide": "to slide along them", "free": "free to move"}
    rule = interfaces or mesh.node_rules.interfaces
    options = " (--interfaces slide or free lets them move)" if rule == "keep" and not interfaces else ""
    return f"{len(materials)} materials; {nodes} {fates[rule]}{options}."


def describe_embedded(mesh: Mesh) -> str:
    """Tell that nodes of faces, edges and points inside the mesh stay; "" if there are none, or they may move."""
    n_embedded = int(np.count_nonzero(mesh.embedded & mesh.immovable))
    if not n_embedded:
        return ""
    stay = count_phrase(n_embedded, "node stays", "nodes stay")
    return f"{stay}: of faces, edges or points that the file has inside the mesh (--interfaces free lets them move)."


def interface_message(before: Mesh, after: Mesh, volumes: Mapping[str, MaterialVolume]) -> str:
    """Tell what a run did to the interfaces of a mesh; "" for one material.

    Parameters
    ----------
    before, after : Mesh
    volumes : mapping of str to MaterialVolume
        Volumes of the materials.
    """
    if before.materials is None:
        return ""
    nodes = _inner_nodes(before)
    displacements = np.linalg.norm(after.points[nodes] - before.points[nodes], axis=1)
    has_moved = displacements > _ROUNDING * (before.mean_edge_length or 1.0)
    moved = int(np.count_nonzero(has_moved))
    many = f"{len(before.materials)} materials"
    if not moved:
        kept = count_phrase(nodes.size, "node on their interfaces was", "nodes on their interfaces were")
        return f"{many}: {kept} kept."
    largest = max((abs(volume.change) for volume in volumes.values()), default=0.0)
    return (
        f"{many}: {moved:,} of {count_phrase(nodes.size, 'node')} on their interfaces moved; no material's volume "
        f"changed by more than {100 * largest:.2g} %."
    )


def _inner_nodes(mesh: Mesh) -> np.ndarray:
    """Nodes of the interfaces that are not on the boundary, (k,) int64."""
    materials = mesh.materials
    if materials is None:
        return np.empty(0, np.int64)
    return np.flatnonzero(materials.interface_nodes & ~mesh.topology.boundary)
