"""Formulas in x, y and z: arithmetic on arrays, parsed to a tree; only listed kinds of nodes are computed."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping

import numpy as np

from hexmend.errors import ParameterError

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
