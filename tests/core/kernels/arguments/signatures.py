"""The functions, methods and constructors of compiled kernels that take arrays, by their signatures."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from hexmend import kernels

_ARRAY = re.compile(r"(\w+): ndarray\[dtype=(\w+), shape=\(([^)]*)\)")
_NAME = re.compile(r"(?:\(|, )(\w+): ")


@dataclass(frozen=True)
class Overload:
    """A signature: names of all arguments, and type and shape of a row of those that are arrays."""

    names: tuple[str, ...]
    arrays: dict[str, tuple[np.dtype, tuple[int, ...]]]

    @classmethod
    def of(cls, signature: str) -> Overload:
        given = signature.rpartition(" -> ")[0]
        arrays = {
            name: (np.dtype(kind), tuple(int(width) for width in shape.split(",")[1:] if width.strip()))
            for name, kind, shape in _ARRAY.findall(given)
        }
        return cls(tuple(_NAME.findall(given.replace("(self, ", "("))), arrays)

    def array(self, name: str, value: int | np.ndarray) -> np.ndarray:
        """A copy of an array, or zeros with so many rows, of the type and the shape that the signature states."""
        kind, row = self.arrays[name]
        given = np.zeros((value, *row), kind) if isinstance(value, int) else np.array(value, kind)
        return np.ascontiguousarray(given).reshape(-1, *row)


def _families() -> Iterator[tuple[str, ModuleType]]:
    for name, family in sorted(vars(kernels).items()):
        if isinstance(family, ModuleType) and family.__name__ == f"hexmend.kernels._{kernels.BUILD}.{name}":
            yield name, family


def _callables() -> Iterator[tuple[str, Callable, Any]]:
    """The name of each function, method and constructor; what is called; and what has its signatures."""
    for family, module in _families():
        for name, found in vars(module).items():
            if not isinstance(found, type):
                yield f"{family}.{name}", found, found
                continue
            yield f"{family}.{name}", found, found.__init__
            for method, bound in vars(found).items():
                if not method.startswith("__"):
                    yield f"{family}.{name}.{method}", bound, bound


def _with_arrays() -> Iterator[tuple[str, Callable, list[Overload]]]:
    for name, kernel, described in _callables():
        overloads = [Overload.of(line) for line, *_ in getattr(described, "__nb_signature__", ())]
        if any(overload.arrays for overload in overloads):
            yield name, kernel, overloads


#: By name, as `elements.measure` or `laplacian.LaplacianSweeps.next`: what is called, and its signatures.
KERNELS = {name: (kernel, overloads) for name, kernel, overloads in _with_arrays()}
