"""Rules of mutation: which syntax is replaced by which text."""

from __future__ import annotations

import ast
from collections.abc import Iterator

#: Functions that only describe, and calls that only describe or declare (a test compares declarations with the docs).
SILENT_FUNCTIONS = {"__repr__", "__str__", "_repr_html_"}
SILENT_CALLS = {"parameter", "debug", "info", "warning", "warn", "error", "exception"}

_COMPARISONS = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
_ARITHMETIC = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
_PAIRS = [("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("nanmin", "nanmax"), ("any", "all")]
_PAIRS += [("floor", "ceil"), ("sin", "cos"), ("zeros", "ones"), ("fmin", "fmax")]
_OTHERS = dict(_PAIRS) | {b: a for a, b in _PAIRS}

#: An operator's name, the node that is replaced, and the text in its place.
Replacement = tuple[str, ast.AST, str]


def replacements(node: ast.AST) -> Iterator[Replacement]:
    """Yield what a node may be replaced by.

    Parameters
    ----------
    node : ast.AST

    Yields
    ------
    operator : str
    part : ast.AST
        The node or a part of it.
    text : str
        What stands in its place.
    """
    match node:
        case ast.Compare(ops=[op]):
            for other in _COMPARISONS[type(op)]:
                yield "comparison", node, ast.unparse(ast.Compare(node.left, [other()], node.comparators))
        case ast.BoolOp(op=op):
            other = ast.Or() if isinstance(op, ast.And) else ast.And()
            yield "and, or", node, ast.unparse(ast.BoolOp(other, node.values))
        case ast.BinOp(left, op, right) if type(op) in _ARITHMETIC and not (_is_list(left) or _is_list(right)):
            yield "arithmetic", node, ast.unparse(ast.BinOp(left, _ARITHMETIC[type(op)](), right))
        case ast.UnaryOp(op=ast.Not() | ast.Invert(), operand=operand):
            yield "not", node, ast.unparse(operand)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield "sign", node, ast.unparse(operand)
        case ast.Constant(value=bool(value)):
            yield "constant", node, str(not value)
        case ast.Constant(value=int(value) | float(value)) if value in (0, 1):
            yield "constant", node, repr(type(value)(1 - value))
        case ast.Subscript(slice=ast.Constant(value=int(value))):
            yield "index", node.slice, str(value + 1)
        case ast.Call():
            yield from _calls(node)
        case ast.Expr(value=ast.Call()):
            yield "statement removed", node, "pass"
        case ast.AugAssign() | ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            yield "statement removed", node, "pass"
        case ast.Return(value=value) if value is not None:
            yield from _returns(value)
        case ast.Break():
            yield "break, continue", node, "continue"
        case ast.Continue():
            yield "break, continue", node, "break"
    tests = getattr(node, "ifs", None) or ([node.test] if isinstance(node, ast.If | ast.While | ast.IfExp) else [])
    for test in tests:
        if isinstance(test, ast.Name | ast.Attribute | ast.Call):
            yield "condition", test, f"not {ast.unparse(test)}"


def _calls(node: ast.Call) -> Iterator[Replacement]:
    name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
    if name in _OTHERS:
        if isinstance(node.func, ast.Name):
            yield "min, max", node.func, _OTHERS[name]
        else:
            yield "min, max", node.func, f"{ast.unparse(node.func.value)}.{_OTHERS[name]}"
    if name in ("abs", "absolute") and len(node.args) == 1:
        yield "abs", node, ast.unparse(node.args[0])
    if name in ("where", "clip", "cross", "arctan2", "subtract", "divide") and len(node.args) >= 2:
        *rest, a, b = node.args
        yield "arguments swapped", node, ast.unparse(ast.Call(node.func, [*rest, b, a], node.keywords))


def _returns(value: ast.expr) -> Iterator[Replacement]:
    if isinstance(value, ast.Compare | ast.BoolOp) or (
        isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not)
    ):
        yield "return value", value, f"not ({ast.unparse(value)})"
    elif not (isinstance(value, ast.Constant) and value.value is None):
        yield "return value", value, "None"


def _is_list(node: ast.expr) -> bool:
    """Return True if a node is a text, a list or a tuple, which can be added but not subtracted."""
    return isinstance(node, ast.JoinedStr | ast.List | ast.Tuple | ast.ListComp) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)
    )
