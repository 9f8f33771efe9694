"""Figures of a divided mesh as a whole."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import elements
from hexmend.mesh.edge_length import edge_lengths, robust_mean, sample_stride
from hexmend.quality import measure
from hexmend.quality.measure import locked_hexes
from hexmend.quality.validity import least_jacobian
from hexmend.ranks.rank_part import RankPart
from hexmend.summary import Summary


def mean_edge_length(part: RankPart, hex_ids: np.ndarray) -> float:
    """Compute the mean edge length of the whole mesh; see `hexmend.mesh.edge_length.mean_edge_length`.

    All ranks call it together; `hex_ids` (m,) are the numbers of the hexes of the part.
    """
    mesh, ranks = part.mesh, part.ranks
    own = mesh.hexes[part.counted]
    total = elements.mean_edge_length(mesh.points, own) * len(own) if len(own) else 0.0
    sampled = part.counted & (hex_ids % sample_stride(part.n_hexes) == 0)
    sample = ranks.gather(edge_lengths(mesh.points, mesh.hexes[sampled]))
    return robust_mean(ranks.sum(total) / part.n_hexes, sample)


def summarise_part(part: RankPart, points: np.ndarray) -> Summary:
    """Summarise the whole mesh, whose part has points (n, 3); all ranks call it together."""
    ranks, own, hexes = part.ranks, part.counted, part.mesh.hexes
    quality = measure(points, hexes)
    q, m = quality.q[own], part.n_hexes
    mean = ranks.sum(float(q.sum())) / m
    locked = locked_hexes(points, hexes, part.mesh.fixed, quality.inverted)
    inverted = ranks.sum(int(np.count_nonzero(quality.inverted & own)))
    least = ranks.least(float(q.min(initial=np.inf)))
    squares = ranks.sum(float(np.sum(1 / np.square(q[q > 0]))))
    lowest = least_jacobian(points, np.ascontiguousarray(hexes[own])) if own.any() else 1.0
    total = ranks.sum(float(np.square(quality.eta[own]).sum())) if not inverted else np.inf
    return Summary(
        hexes=m,
        nodes=ranks.sum(int(np.count_nonzero(part.owned))),
        free_nodes=ranks.sum(int(np.count_nonzero(part.mesh.free & part.owned))),
        inverted=inverted,
        invalid=ranks.sum(int(np.count_nonzero(quality.invalid & own))),
        min_jacobian=ranks.least(lowest),
        locked_inverted=ranks.sum(int(np.count_nonzero(locked & own))),
        q_min=least,
        q_mean=mean,
        q_max=ranks.greatest(float(q.max(initial=-np.inf))),
        q_std=float(np.sqrt(ranks.sum(float(np.square(q - mean).sum())) / m)),
        q_norm=float(np.sqrt(m / squares)) if least > 0 else 0.0,
        scaled_jacobian_min=ranks.least(float(quality.scaled_jacobian[own].min(initial=np.inf))),
        objective=total if np.isfinite(total) else None,
    )
