"""Targets by their names: ideal, given-shape, given-size, given, or a field or formula."""

from __future__ import annotations

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.element_target import Target
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import centres
from hexmend.quality import ElementQuality
from hexmend.target.edge_lengths import given_lengths
from hexmend.target.formula import evaluate
from hexmend.target.sheets import recovered_lengths

#: Targets that are no fields: name and meaning.
SPECIFICATIONS = {
    "ideal": "cubes of any size",
    "given-shape": "each hex's own three lengths as given, of which only the ratios count",
    "given-size": "cubes of each hex's own size",
    "given": "each hex's own three lengths, shape and size",
}
#: Weight of the size relative to the shape where none is named.
SIZE_WEIGHT = 1.0
#: Largest ratio, either way, of lengths of a field to the median length of the mesh: beyond it energies overflow.
MAX_RATIO = 1e15
#: Targets of which only ratios of lengths count.
WITHOUT_SIZES = ("ideal", "given-shape")


def make_target(
    mesh: Mesh, specification: str, size_weight: float = SIZE_WEIGHT, quality: ElementQuality | None = None
) -> Target | None:
    """Make the target of a mesh's elements.

    Parameters
    ----------
    mesh : Mesh
        The mesh as given; where it is noisy or tangled, its lengths are recovered along dual sheets.
    specification : str
        A name in `SPECIFICATIONS`, the name of hex or node data with one or three values, or a formula in x, y, z (the
        centres of hexes) with one value, or three with commas between them. Names of data that are words can be used
        in a formula too.
    size_weight : float
        Weight of the size relative to the shape; "given-shape" has none.
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    Target or None
        None for "ideal".

    Raises
    ------
    ParameterError
        For a name or formula that is unknown, and for lengths that are not positive and finite, or out of
        proportion to the mesh (`MAX_RATIO`).

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=8)
    >>> make_target(mesh, "given").lengths[0], make_target(mesh, "0.1 + x").lengths[0]
    (array([0.5, 0.5, 0.5]), array([0.35, 0.35, 0.35]))
    """
    if specification == "ideal":
        return None
    if specification not in SPECIFICATIONS:
        return Target(_field(mesh, specification), size_weight, specification)
    lengths = recovered_lengths(mesh, quality)
    if specification == "given-size":
        lengths = np.repeat(np.exp(np.log(lengths).mean(axis=1, keepdims=True)), 3, axis=1)
    return Target(lengths, 0.0 if specification == "given-shape" else size_weight, specification)


def _field(mesh: Mesh, text: str) -> np.ndarray:
    """Lengths (m, 3) from data of the mesh, or by a formula."""
    if text in mesh.hex_data or text in mesh.node_data:
        values = _data(mesh, text)
        columns = [values] if values.ndim == 1 else list(values.T)
    else:
        try:
            columns = evaluate(text, _names(mesh))
        except ParameterError as error:
            message = f"there is no target {text!r}: expected {_expected(mesh)}. As a formula: {error}"
            raise ParameterError(message) from None
    if len(columns) not in (1, 3):
        raise ParameterError(f"target {text!r} has {len(columns)} values a hex: expected one length, or three")
    lengths = np.empty((mesh.n_elements, 3))
    lengths.T[:] = [np.broadcast_to(column, mesh.n_elements) for column in columns]
    unit = float(np.median(given_lengths(mesh)))
    least, greatest = unit / MAX_RATIO, unit * MAX_RATIO
    wrong = np.argwhere(~((lengths >= least) & (lengths <= greatest)))
    if len(wrong):
        hex_, direction = wrong[0]
        raise ParameterError(
            f"target {text!r} is {lengths[hex_, direction]:g} at hex {hex_} (counted from 0): expected positive finite "
            f"lengths in the unit of the mesh, from {least:.3g} to {greatest:.3g} (its median length divided and "
            f"multiplied by {MAX_RATIO:g})"
        )
    return lengths


def _data(mesh: Mesh, name: str) -> np.ndarray:
    """Values of hex data, or of node data at the centres of hexes, (m,) or (m, k) float64."""
    values = mesh.hex_data.get(name)
    if values is None:
        values = centres(np.asarray(mesh.node_data[name]), mesh.elements)
    values = np.asarray(values)
    if values.dtype.kind not in "iufb" or values.ndim > 2:
        raise ParameterError(f"data {name!r} are not lengths: expected one number, or three, for each hex or node")
    return values.astype(np.float64)


def _names(mesh: Mesh) -> dict[str, np.ndarray]:
    """Values that formulas can use: coordinates of the centres, and data with one number a hex or node."""
    names = dict(zip("xyz", centres(mesh.points, mesh.elements).T, strict=True))
    for data in (mesh.node_data, mesh.hex_data):
        for name, values in data.items():
            if name.isidentifier() and name not in "xyz" and values.ndim == 1 and values.dtype.kind in "iuf":
                names[name] = _data(mesh, name)
    return names


def _expected(mesh: Mesh) -> str:
    """The targets that a mesh can have, in words."""
    data = [*mesh.hex_data, *mesh.node_data]
    named = f", data ({', '.join(data)})" if data else ""
    return f"{', '.join(SPECIFICATIONS)}{named}, or a formula in x, y, z"
