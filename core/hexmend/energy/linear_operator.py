"""What a Hessian is to whoever solves with it: something that vectors are multiplied by."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.validation import as_reals


class SymmetricOperator(ABC):
    """A symmetric matrix of double precision, known by its products; SciPy's solvers take it as it is.

    Parameters
    ----------
    size : int
        Of its rows, and of its columns.
    """

    dtype = np.dtype(np.float64)

    def __init__(self, size: int):
        self.shape = size, size

    def matvec(self, v: np.ndarray) -> np.ndarray:
        """The product with v (size,), float64.

        Raises
        ------
        MeshError
            For a vector of another shape or type.
        """
        return self._product(self._vector(v))

    @abstractmethod
    def _product(self, v: np.ndarray) -> np.ndarray:
        """The product with v (size,), checked: float64, contiguous."""

    def _vector(self, v: object, what: str = "the vector") -> np.ndarray:
        """A vector as (size,) float64, contiguous; `MeshError` where it has another shape or type."""
        array = as_reals(v, what)
        if array.shape != self.shape[1:]:
            raise MeshError(f"{what} has shape {array.shape}: expected {self.shape[1:]}")
        return array

    def __matmul__(self, v: np.ndarray) -> np.ndarray:
        if v.shape[0] != self.shape[1]:
            raise ValueError(f"a matrix of {self.shape[1]} columns times an array of {v.shape[0]} rows")
        if v.ndim == 1:
            return self.matvec(v)
        return np.stack([self.matvec(column) for column in v.T], axis=1) if v.shape[1] else np.zeros(v.shape)
