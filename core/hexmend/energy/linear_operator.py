"""Symmetric linear operator, the interface of Hessians for linear solvers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.validation import as_reals

if TYPE_CHECKING:
    pass


class SymmetricOperator(ABC):
    """Symmetric matrix given by its products with vectors, in double precision; SciPy's solvers accept it.

    Parameters
    ----------
    size : int
        Number of rows, and of columns.
    """

    dtype = np.dtype(np.float64)

    def __init__(self, size: int):
        self.shape = size, size

    def matvec(self, v: np.ndarray) -> np.ndarray:
        """Return the product with a vector v (size,), (size,) float64.

        Raises
        ------
        MeshError
            For a vector of another shape or type.
        """
        return self._product(self._vector(v))

    @abstractmethod
    def _product(self, v: np.ndarray) -> np.ndarray:
        """Return the product with a checked vector v (size,): float64, contiguous."""

    def _vector(self, v: object, label: str = "the vector") -> np.ndarray:
        """Convert a vector to contiguous (size,) float64; raises `MeshError` for another shape or type."""
        array = as_reals(v, label)
        if array.shape != self.shape[1:]:
            raise MeshError(f"{label} has shape {array.shape}: expected {self.shape[1:]}")
        return array

    def __matmul__(self, v: np.ndarray) -> np.ndarray:
        if v.shape[0] != self.shape[1]:
            raise ValueError(f"a matrix of {self.shape[1]} columns times an array of {v.shape[0]} rows")
        if v.ndim == 1:
            return self.matvec(v)
        return np.stack([self.matvec(column) for column in v.T], axis=1) if v.shape[1] else np.zeros(v.shape)
