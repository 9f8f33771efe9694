"""Direction of steepest descent of a node's energy, as far as it is more than rounding."""

from __future__ import annotations

import numpy as np

#: Rounding of a position in units of eps (1 + |x|): the corners of a patch are rounded each, and the sums over its
#: hexes add to that. At the nodes of regular grids, sheared, rotated and shifted, the gradient is at most
#: 0.3 |H| eps (1 + |x|); a node moved by 1e-12 edge lengths has 600 times |H| eps (1 + |x|).
_ROUNDINGS = 64.0


def descent(gradient: np.ndarray, hessian: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Return the negative gradient of an energy by the position of a node; zero if it is within rounding.

    Coordinates are stored with a relative precision of eps = 2^-52, so that a node at its minimum is away from it by a
    distance of the order r = eps (1 + |x|). The gradient there is up to |H| r for a Hessian H. A gradient that is no
    larger, up to a factor of 64, has no meaningful direction.

    Parameters
    ----------
    gradient : (3,) float64
    hessian : (3, 3) float64
    position : (3,) float64
        Position of the node, in the unit of length of the derivatives.

    Returns
    -------
    (3,) float64
        Zero also if the gradient is not finite.

    Examples
    --------
    >>> descent(np.array([1e-3, 0, 0]), np.eye(3), np.zeros(3)).tolist()
    [-0.001, -0.0, -0.0]
    >>> descent(np.array([1e-15, 0, 0]), np.eye(3), np.zeros(3)).tolist()
    [0.0, 0.0, 0.0]
    """
    if not (np.isfinite(gradient).all() and np.isfinite(hessian).all()):
        return np.zeros(3)
    rounding = _ROUNDINGS * np.finfo(float).eps * (1 + np.abs(position).max())
    significant = np.linalg.norm(gradient) > rounding * np.linalg.norm(hessian)
    return -gradient if significant else np.zeros(3)
