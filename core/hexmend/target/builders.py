"""Targets by their names: ideal, given-shape, given-size, given, or a field or formula.

Formulas in x, y and z: arithmetic on arrays, parsed to a tree; only listed kinds of nodes are computed.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.element_target import Target
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import centres
from hexmend.quality import ElementQuality
from hexmend.target.sheets import given_lengths, recovered_lengths

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


#: Functions by their names in formulas.
FUNCTIONS: Mapping[str, Callable[..., np.ndarray]] = {
    "abs": np.abs, "acos": np.arccos, "asin": np.arcsin, "atan": np.arctan, "atan2": np.arctan2, "cos": np.cos,
    "cosh": np.cosh, "exp": np.exp, "hypot": np.hypot, "log": np.log, "max": np.maximum, "min": np.minimum,
    "sin": np.sin, "sinh": np.sinh, "sqrt": np.sqrt, "tan": np.tan, "tanh": np.tanh, "where": np.where,
}  # fmt: skip
_CONSTANTS = {"pi": np.pi, "e": np.e}
_OPERATORS: Mapping[type, Callable[..., np.ndarray]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide, ast.Pow: np.power,
    ast.USub: np.negative, ast.UAdd: np.positive,
    ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal,
}  # fmt: skip
#: Longest text of a formula.
_MAX_LETTERS = 500


def evaluate(text: str, values: Mapping[str, np.ndarray]) -> list[np.ndarray]:
    """Compute a formula, or several with commas between them.

    Nothing but numbers, the names of `values`, pi and e, + - * / **, comparisons and `FUNCTIONS` is computed: a formula
    runs no code.

    Parameters
    ----------
    text : str
        Such as "0.1 + 0.02 * sqrt(x**2 + y**2)".
    values : mapping of str to (m,) float64
        Values by the names that formulas may use.

    Returns
    -------
    list of float64 arrays that have, or broadcast to, the shape (m,)
        One for each formula. Values may be infinite or NaN.

    Raises
    ------
    ParameterError
        For a text that is no such formula; the message names the part.

    Examples
    --------
    >>> evaluate("2 * x + 1", {"x": np.array([1.0, 2.0])})
    [array([3., 5.])]
    >>> evaluate("x, sqrt(2 * x)", {"x": np.array([8.0])})
    [array([8.]), array([4.])]
    """
    if len(text) > _MAX_LETTERS:
        raise ParameterError(f"the formula has {len(text)} characters: expected at most {_MAX_LETTERS}")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise ParameterError(f"formula {text!r} cannot be parsed: expected such as 0.1 + 0.02 * x") from None
    names: dict[str, np.ndarray | float] = {**_CONSTANTS, **values}
    parts = tree.elts if isinstance(tree, ast.Tuple) else [tree]
    with np.errstate(all="ignore"):
        return [_value(part, names, text) for part in parts]


def _value(node: ast.expr, names: Mapping[str, np.ndarray | float], text: str) -> np.ndarray:
    """Compute a node of the tree."""

    def of(child: ast.expr) -> np.ndarray:
        return _value(child, names, text)

    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return _as_float(number, text)
        case ast.Name(id=name) if name in names:
            return np.asarray(names[name], dtype=np.float64)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](of(left), of(right))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](of(operand))
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](of(left), of(right))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS and name not in names:
            return _called(name, [of(one) for one in args], text)
    names_listed = ", ".join([*(name for name in names if name not in _CONSTANTS), *sorted(_CONSTANTS)])
    raise ParameterError(
        f"formula {text!r}: {ast.unparse(node)} is not allowed: expected numbers, the names {names_listed}, "
        f"+ - * / ** and the functions {', '.join(FUNCTIONS)}"
    )


def _as_float(number: float, text: str) -> np.ndarray:
    try:
        return np.asarray(float(number))
    except OverflowError:
        raise ParameterError(f"formula {text!r} has a number that is too large: expected at most 1e308") from None


def _called(name: str, args: list[np.ndarray], text: str) -> np.ndarray:
    """Call a function; where it is called with another number of arguments, `ParameterError`."""
    expected = {"atan2": 2, "hypot": 2, "max": 2, "min": 2, "where": 3}.get(name, 1)
    if len(args) != expected:
        raise ParameterError(f"formula {text!r}: {name} has {len(args)} arguments: expected {expected}")
    return FUNCTIONS[name](*args)
