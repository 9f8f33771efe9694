"""Data of the interactive mesh in a report, which the scripts `resources/report/*.js` draw."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from markupsafe import Markup

from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality, Metric, measure
from hexmend_app.picture.colour_map import COLOUR_MAPS, value_maps
from hexmend_app.report.templates import html, read
from hexmend_app.scene.colour.colouring import INVALID_COLOURS, invalid_kinds

#: Maximum number of hexes in a page; browsers cannot open larger pages.
MOST_HEXES = 250_000

#: Number of steps to which values are rounded, for metrics that a click shows exactly and for others; the number after
#: the last step means no value.
_EXACT, _STEPS = {"q": 65534, "scaled-jacobian": 65534}, 4000

#: Resolution of positions relative to the size of the mesh, below that of screens.
_FINEST = 2.0**-21

#: Quantiles at the ends of the colour range of a metric with an infinite range.
_ENDS = (0.005, 0.995)

#: Scripts of the page, in order.
_SCRIPTS = ("mesh.js", "camera.js", "steering.js", "painter.js", "viewer.js", "start.js")


@dataclass(frozen=True, eq=False)
class ViewerState:
    """Named state of a mesh.

    Parameters
    ----------
    name : str
    points : (n, 3) float64
    """

    name: str
    points: np.ndarray


def script() -> str:
    """Return the scripts of the page."""
    return "\n".join(map(read, _SCRIPTS))


def viewer(mesh: Mesh, states: Sequence[ViewerState], picture: Markup) -> Markup:
    """Return the HTML of an interactive view of a mesh.

    Parameters
    ----------
    mesh : Mesh
    states : sequence of ViewerState
        The original mesh first, then the results.
    picture : Markup
        Shown without WebGL and in print.
    """
    if mesh.n_hexes > MOST_HEXES:
        message = f"This mesh is too large to be interactive: {mesh.n_hexes:,} hexes, at most {MOST_HEXES:,}."
        message += " Open it in the viewer: hexmend MESH"
        return Markup('<div class="viewer">{}<p class="cannot screen">{}</p></div>').format(picture, message)
    head, blob = packed(mesh, states)
    return html.viewer(
        picture, ["#{:02x}{:02x}{:02x}".format(*special.colour) for special in INVALID_COLOURS], head, blob
    )


def packed(mesh: Mesh, states: Sequence[ViewerState]) -> tuple[dict[str, Any], str]:
    """Encode a mesh for the page.

    Returns
    -------
    head : dict
        Description of the arrays: offset in bytes and number of entries of each.
    blob : str
        The arrays, compressed by gzip, in base64. For better compression, the first bytes of all numbers of an array
        come first, then the second bytes, and so on.
    """
    used = mesh.topology.used
    low, high = (end(axis=0) for end in (mesh.points[used].min, mesh.points[used].max))
    middle, size = (low + high) / 2, float(np.linalg.norm(high - low)) / 2 or 1.0
    places = [np.where(used[:, None], (one.points - middle) / size, 0.0) for one in states]
    figures = [measure(one.points, mesh.hexes, mesh.mid_nodes) for one in states]
    arrays = _Arrays()
    kinds, values = zip(*(_metric(one, mesh, states, figures) for one in METRICS.values()), strict=True)
    head = {
        "hexes": arrays.add(np.diff(mesh.hexes, axis=0, prepend=0).astype(np.int32)),
        "box": {"low": ((low - middle) / size).tolist(), "high": ((high - middle) / size).tolist()},
        "metrics": kinds,
        "states": [
            {
                "name": one.name,
                "points": arrays.add((np.rint(places[k] / _FINEST) * _FINEST).astype(np.float32)),
                "kinds": arrays.add(invalid_kinds(figures[k])),
                "values": [arrays.add(metric[k]) for metric in values],
            }
            for k, one in enumerate(states)
        ],
        "maps": [{"name": name, "table": arrays.add(COLOUR_MAPS[name].table)} for name in value_maps()],
        "apart": [special.colour for special in INVALID_COLOURS],
    }
    return head, arrays.blob()


class _Arrays:
    """Bytes of arrays, concatenated."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._size = 0

    def add(self, array: np.ndarray) -> tuple[int, int]:
        """Append an array; return its offset in bytes and its number of entries."""
        data = np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<"), copy=False)
        start = self._size
        self._pieces.append(data.reshape(-1, 1).view(np.uint8).T.tobytes())
        self._size += data.nbytes
        return start, data.size

    def blob(self) -> str:
        return base64.b64encode(gzip.compress(b"".join(self._pieces), 9, mtime=0)).decode("ascii")


def _metric(
    metric: Metric, mesh: Mesh, states: Sequence[ViewerState], figures: Sequence[ElementQuality]
) -> tuple[dict[str, Any], list[np.ndarray]]:
    """Return the description of a metric for the page, and its values of each state, (m,) uint16."""
    meshes = [mesh.with_points(state.points) for state in states]
    values = [metric.values(moved, quality) for moved, quality in zip(meshes, figures, strict=True)]
    low, high = _range(metric, values, figures)
    last = _EXACT.get(metric.name, _STEPS)
    with np.errstate(invalid="ignore", over="ignore"):
        steps = [np.rint(np.clip((array - low) / (high - low), 0, 1) * last) for array in values]
    numbers = [np.where(np.isnan(array), last + 1, array).astype(np.uint16) for array in steps]
    declared = bool(np.isfinite(metric.full_range).all())
    kind = {
        "name": metric.name,
        "title": metric.title,
        "unit": metric.unit,
        "better": metric.better,
        "steps": last,
        "from": low,
        "to": high,
        "open": not declared,  # values beyond these two are clipped
        "low": max(low, 0.0) if declared else low,  # invalid hexes have separate colours
        "high": high,
    }
    return kind, numbers


def _range(metric: Metric, values: Sequence[np.ndarray], figures: Sequence[ElementQuality]) -> tuple[float, float]:
    """Return the range of the metric or, if that is infinite, the range of most values of valid hexes."""
    if np.isfinite(metric.full_range).all():
        return float(metric.full_range[0]), float(metric.full_range[1])
    merged = np.concatenate(values)
    valid = merged[np.isfinite(merged) & ~np.concatenate([one.invalid for one in figures])]
    low, high = np.quantile(valid, _ENDS).tolist() if valid.size else (0.0, 1.0)
    missing = max(1e-6 * max(abs(low), abs(high)), 1e-300) - (high - low)
    return (low, high) if missing <= 0 else (low - missing / 2, high + missing / 2)
