"""Blurred projection of hexes along an axis."""

from __future__ import annotations

import numpy as np

#: Side of the image in pixels, its margin around the hexes, and the radius of the blur, which is applied three times.
_SIDE, _MARGIN, _RADIUS = 64, 14, 4

#: Maximum number of sample points, and maximum number along each edge of a hex.
_MAX_SAMPLES, _MAX_ALONG = 60_000, 40

#: Signs of the corners of a hex, in its numbering.
_CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)


def footprint(points: np.ndarray, hexes: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Project hexes along an axis, and blur the result.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
        At least one hex.
    axis : int
        0, 1 or 2; the other two axes, in ascending order, are those of the image.

    Returns
    -------
    image : (64, 64) float64
        Coverage from 0 to 1; columns are along the first axis of the image, rows along the second.
    low, high : (2,) float64
        Corners of the image.
    """
    across = [k for k in range(3) if k != axis]
    samples = _samples(points[:, across], hexes)
    bottom, size = samples.min(axis=0), np.ptp(samples, axis=0)
    inner = _SIDE - 2 * _MARGIN
    pixel = max(float(size.max()) / inner, 1e-300)  # square pixels
    low = bottom + size / 2 - pixel * _SIDE / 2
    cell = np.clip(((samples - low) / pixel).astype(np.intp), 0, _SIDE - 1)
    image = np.zeros((_SIDE, _SIDE))
    image[cell[:, 1], cell[:, 0]] = 1.0
    for _ in range(3):
        image = _blurred(_blurred(image).T).T
    return image, low, low + pixel * _SIDE


def _samples(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Return points in hexes, (k, 2), whose distance is about a pixel of the image, from positions (n, 2)."""
    along = int(np.clip(np.ceil(2.0 * _SIDE / len(hexes) ** (1 / 3)), 1, _MAX_ALONG))
    along = max(1, min(along, int((_MAX_SAMPLES / len(hexes)) ** (1 / 3))))
    places = (np.arange(along) + 0.5) / along
    local = np.stack(np.meshgrid(places, places, places), axis=-1).reshape(-1, 1, 3)
    weights = np.where(_CORNERS > 0, local, 1 - local).prod(axis=-1)  # (along^3, 8), trilinear
    return np.einsum("sc,mcd->smd", weights, points[hexes]).reshape(-1, 2)


def _blurred(image: np.ndarray) -> np.ndarray:
    """Return the mean over the neighbouring pixels of each row."""
    width = 2 * _RADIUS + 1
    padded = np.pad(image, ((0, 0), (_RADIUS + 1, _RADIUS)))
    total = padded.cumsum(axis=1)
    return (total[:, width:] - total[:, :-width]) / width
