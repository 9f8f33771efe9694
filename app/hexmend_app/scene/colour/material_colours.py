"""Colours and names of materials, for the mesh and for legends."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable

#: Colours of the first materials: Paul Tol's "muted", without its grey, those like magenta at the end.
_COLOURS = (
    *("88ccee", "ddcc77", "117733", "332288", "44aa99"),
    *("999933", "6699cc", "cc6677", "882255", "aa4499"),
)
#: Shares by which further materials have these colours mixed with white, or with black if negative.
_TINTS = (0.0, 0.45, -0.35)
#: Most letters of a name in a legend.
_MOST_LETTERS = 16


def material_table(count: int) -> np.ndarray:
    """Return the colours of materials, (count, 3) uint8; they repeat where there are more than thirty.

    >>> material_table(2).tolist()
    [[136, 204, 238], [221, 204, 119]]
    """
    base = np.array([list(bytes.fromhex(colour)) for colour in _COLOURS], dtype=float)
    tints = [base + share * (255 - base) if share >= 0 else base * (1 + share) for share in _TINTS]
    table = np.rint(np.concatenate(tints)).astype(np.uint8)
    return table[np.arange(count) % len(table)]


def material_names(mesh: Mesh) -> tuple[str, ...]:
    """Return the names of the materials of a mesh for legends; one name for a mesh without materials."""
    names = ("one material",) if mesh.materials is None else mesh.materials.names
    return tuple(shortened(printable(name)) for name in names)


def material_values(mesh: Mesh) -> np.ndarray:
    """Return the number of the material of each hex, (m,) float64."""
    return np.zeros(mesh.n_elements) if mesh.materials is None else mesh.materials.of_hex.astype(np.float64)


def shortened(name: str) -> str:
    """Return a name of at most sixteen letters.

    >>> shortened("a very long name of a block")
    'a very long nam…'
    """
    return name if len(name) <= _MOST_LETTERS else f"{name[: _MOST_LETTERS - 1]}…"
