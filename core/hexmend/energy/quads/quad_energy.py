"""Energy of quads in the tangent planes of a surface: eta(Q), its first and its second derivative.

At a corner with the edges e1 to the next and e2 to the previous corner, and the outward unit normal n of the surface at
the quad, T = [e1, e2] and sigma = n . (e1 x e2). It is the area of the corner's parallelogram in the tangent plane,
negative where the quad is flipped. With h and r as of hexes, f = 1/(2 h), and directions V, W of T,

    eta          = f |T|^2
    d eta(V)     = 2 f [ (V, T) - |T|^2/(2 r) d sigma(V) ]
    d2 eta(V, W) = 2 f [ (V, W) - 1/r ((V, T) d sigma(W) + d sigma(V) (W, T)) - |T|^2/(2 r) d2 sigma(V, W)
                         + |T|^2/(2 r^2) (1 + sigma/r) d sigma(V) d sigma(W) ]

which are (3.1), (B.3) and (B.19), corrected, for matrices with two columns: Knupp, "Algebraic mesh quality metrics"
(2001), in the tangent plane as of Gargallo-Peiro, Roca, Peraire and Sarrate (2014). n is held: its derivative is not
among them. eta(Q) is the mean of the four eta minus the offset; a corner that does not count has eta = 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.arrays import cross_products

#: The next and the previous corner of each corner of a quad.
_NEIGHBOURS = [1, 2, 3, 0], [3, 0, 1, 2]


@dataclass(frozen=True, eq=False)
class QuadCorners:
    """Corners of quads: edges, determinant, and softened barrier of each.

    Parameters
    ----------
    edges : (2, f, 4, 3) float64
        Edges to the next and to the previous corner, divided by the lengths that they are to have.
    normals : (f, 1, 3) float64
        Outward unit normals of the surface at the quads.
    scales : (2, f, 4) float64
        Inverse lengths by which the edges are multiplied.
    counted : (f, 4) bool
    sigma, h, r : (f, 4) float64
        See the module.
    """

    edges: np.ndarray
    normals: np.ndarray
    scales: np.ndarray
    counted: np.ndarray
    sigma: np.ndarray
    h: np.ndarray
    r: np.ndarray

    @classmethod
    def of(
        cls, x: np.ndarray, normals: np.ndarray, scales: np.ndarray, counted: np.ndarray, delta: float
    ) -> QuadCorners:
        """Compute the corners of quads with nodes at x (f, 4, 3) and normals (f, 3)."""
        normals = normals[:, None]
        edges = np.empty((2, *x.shape))
        for edge, other in zip(edges, _NEIGHBOURS, strict=True):
            np.subtract(x[:, other], x, out=edge)
        edges *= scales[..., None]
        sigma = np.einsum("fki,fi->fk", cross_products(edges[0], edges[1]), normals[:, 0])
        if delta == 0:
            return cls(edges, normals, scales, counted, sigma, np.maximum(sigma, 0.0), np.abs(sigma))
        r = np.sqrt(sigma**2 + 4 * delta**2)
        total = np.abs(sigma) + r
        h = np.where(sigma >= 0, 0.5 * total, 2 * delta**2 / total)  # without cancellation
        return cls(edges, normals, scales, counted, sigma, h, r)

    @property
    def squares(self) -> np.ndarray:
        """|T|^2 of each corner, (f, 4)."""
        return np.einsum("efki,efki->fk", self.edges, self.edges)

    @property
    def slopes(self) -> np.ndarray:
        """Derivatives of sigma by the two edges, (2, f, 4, 3)."""
        return np.stack([cross_products(self.edges[1], self.normals), cross_products(self.normals, self.edges[0])])

    def energies(self, offset: float) -> np.ndarray:
        """Compute eta(Q), (f,): +inf where a counted corner has h = 0; with delta > 0 it may be negative."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            eta = np.where(self.counted, self.squares / (2 * self.h), 1.0).mean(axis=1) - offset
        return np.where(np.isnan(eta), np.inf, eta)

    @property
    def qualities(self) -> np.ndarray:
        """Mean of 2 sigma/|T|^2 over the counted corners of each quad, (f,), in which a corner of sigma <= 0 has 0."""
        q = _quotient(2 * self.sigma, self.squares)
        counts = np.maximum(self.counted.sum(axis=1), 1)
        return np.where(self.counted, np.maximum(q, 0.0), 0.0).sum(axis=1) / counts

    @property
    def scaled_jacobians(self) -> np.ndarray:
        """Least sigma/(|e1| |e2|) of the counted corners of each quad, (f,); 1 where none is counted."""
        lengths = np.sqrt(np.square(self.edges).sum(axis=3).prod(axis=0))
        return np.where(self.counted, _quotient(self.sigma, lengths), 1.0).min(axis=1, initial=1.0)

    def gradients(self) -> np.ndarray:
        """Compute the derivatives of eta(Q) by its nodes, (f, 4, 3)."""
        f, slopes = self._factors, self.slopes
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            rows = 2 * f[..., None] * (self.edges - (self.squares / (2 * self.r))[..., None] * slopes)
        rows = np.where(self.counted[..., None], rows, 0.0) * self.scales[..., None]
        return 0.25 * (np.roll(rows[0], 1, axis=1) + np.roll(rows[1], -1, axis=1) - rows.sum(axis=0))

    def hessians(self) -> np.ndarray:
        """Compute the second derivatives of eta(Q) by its nodes, (f, 4, 4, 3, 3): a 3 x 3 block for a pair of nodes."""
        f, r, squares = self._factors, self.r, self.squares
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            mixed, linear = 1 / r, squares / (2 * r)
            outer = squares / (2 * r**2) * (1 + self.sigma / r)
            edges, slopes = self.edges, self.slopes
            blocks = np.empty((2, 2, *f.shape, 3, 3))
            for i in range(2):
                for j in range(2):
                    block = -mixed[..., None, None] * (_outer(edges[i], slopes[j]) + _outer(slopes[i], edges[j]))
                    block += outer[..., None, None] * _outer(slopes[i], slopes[j])
                    if i == j:
                        block += np.eye(3)
                    else:  # d2 sigma: the columns of e1 x e2 . n by e1 and e2
                        block += (1 if i < j else -1) * linear[..., None, None] * _cross_matrices(self.normals)
                    scale = 2 * f * self.scales[i] * self.scales[j]
                    blocks[i, j] = np.where(self.counted[..., None, None], scale[..., None, None] * block, 0.0)
        return 0.25 * _by_nodes(blocks)

    @property
    def _factors(self) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return 0.5 / self.h


def power_derivatives(eta: np.ndarray, p: float) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative of max(eta, 0)^p by eta, (f,) each."""
    energy, second = np.maximum(eta, 0.0), np.zeros(eta.shape)
    if p == 1:
        return np.where(eta < 0, 0.0, 1.0), second
    first = p * np.power(energy, p - 1)
    if p == 2:
        return first, np.where(eta < 0, 0.0, 2.0)
    np.divide((p - 1) * first, energy, out=second, where=energy > 0)
    return first, second


def _by_nodes(blocks: np.ndarray) -> np.ndarray:
    """Sum second derivatives by the edges of corners, (2, 2, f, 4, 3, 3), at pairs of nodes, (f, 4, 4, 3, 3)."""
    (own, mixed), (turned, other) = blocks
    quads = np.zeros((own.shape[0], 4, 4, 3, 3))
    for corner in range(4):
        after, before = (corner + 1) % 4, (corner + 3) % 4
        e, m, t, o = own[:, corner], mixed[:, corner], turned[:, corner], other[:, corner]
        quads[:, corner, corner] += e + m + t + o
        quads[:, corner, after] -= e + t
        quads[:, corner, before] -= m + o
        quads[:, after, corner] -= e + m
        quads[:, before, corner] -= t + o
        quads[:, after, after] += e
        quads[:, after, before] += m
        quads[:, before, after] += t
        quads[:, before, before] += o
    return quads


def _quotient(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Quotients of a and b >= 0, of one shape; 0 where b is 0."""
    return np.divide(a, b, out=np.zeros_like(a), where=b > 0)


def _outer(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., :, None] * b[..., None, :]


def _cross_matrices(v: np.ndarray) -> np.ndarray:
    """Matrices [v] with [v] w = v x w, (..., 3, 3), of vectors (..., 3)."""
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
