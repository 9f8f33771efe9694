"""Data of the interactive mesh in a report, which the scripts `resources/report/*.js` draw."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Sequence
from typing import Any

import numpy as np
from markupsafe import Markup

from hexmend.mesh.solid_cells import TETRAHEDRON, WEDGE, nouns, rows_by_kind
from hexmend.quality import METRICS, Metric
from hexmend.terminal_text import count_phrase
from hexmend_app.picture.colour_map import COLOUR_MAPS, value_maps
from hexmend_app.picture.colours import Colours
from hexmend_app.report.case import Version
from hexmend_app.report.templates import html, read
from hexmend_app.scene.colour.colouring import INVALID_COLOURS, invalid_kinds, resolve

#: Maximum number of hexes in a page; browsers cannot open larger pages.
MOST_HEXES = 250_000

#: Number of steps to which values are rounded, for metrics that a click shows exactly and for others; the number after
#: the last step means no value.
_EXACT, _STEPS = {"q": 65534, "scaled-jacobian": 65534}, 4000

#: Resolution of positions relative to the size of the mesh, below that of screens.
_FINEST = 2.0**-21

#: Scripts of the page, in order.
_SCRIPTS = ("mesh.js", "camera.js", "steering.js", "painter.js", "viewer.js", "start.js")


def script() -> str:
    """Return the scripts of the page."""
    return "\n".join(map(read, _SCRIPTS))


def viewer(versions: Sequence[Version], picture: Markup) -> Markup:
    """Return the HTML of an interactive view of a mesh.

    Parameters
    ----------
    versions : sequence of Version
        The original mesh first, then the results.
    picture : Markup
        Shown without WebGL and in print.
    """
    mesh = versions[0].mesh
    if mesh.n_elements > MOST_HEXES:
        cells = count_phrase(mesh.n_elements, *nouns(mesh.elements))
        message = f"This mesh is too large to be interactive: {cells}, at most {MOST_HEXES:,}."
        message += " Open it in the viewer: hexmend MESH"
        return Markup('<div class="viewer">{}<p class="cannot screen">{}</p></div>').format(picture, message)
    head, blob = packed(versions)
    return html.viewer(
        picture, ["#{:02x}{:02x}{:02x}".format(*special.colour) for special in INVALID_COLOURS], head, blob
    )


def packed(versions: Sequence[Version]) -> tuple[dict[str, Any], str]:
    """Encode the versions of a mesh for the page.

    Returns
    -------
    head : dict
        Description of the arrays: offset in bytes and number of entries of each.
    blob : str
        The arrays, compressed by gzip, in base64. For better compression, the first bytes of all numbers of an array
        come first, then the second bytes, and so on.
    """
    mesh = versions[0].mesh
    used = mesh.topology.used
    low, high = (end(axis=0) for end in (mesh.points[used].min, mesh.points[used].max))
    middle, size = (low + high) / 2, float(np.linalg.norm(high - low)) / 2 or 1.0
    places = [np.where(used[:, None], (one.mesh.points - middle) / size, 0.0) for one in versions]
    arrays = _Arrays()
    kinds, values = zip(*(_metric(one, versions) for one in METRICS.values()), strict=True)
    head = {
        "hexes": arrays.add(np.diff(_as_hexes(mesh.elements), axis=0, prepend=0).astype(np.int32)),
        "nouns": nouns(mesh.elements),
        "box": {"low": ((low - middle) / size).tolist(), "high": ((high - middle) / size).tolist()},
        "metrics": kinds,
        "states": [
            {
                "name": one.name,
                "points": arrays.add((np.rint(places[k] / _FINEST) * _FINEST).astype(np.float32)),
                "kinds": arrays.add(invalid_kinds(one.quality)),
                "values": [arrays.add(metric[k]) for metric in values],
            }
            for k, one in enumerate(versions)
        ],
        "maps": [{"name": name, "table": arrays.add(COLOUR_MAPS[name].table)} for name in value_maps()],
        "apart": [special.colour for special in INVALID_COLOURS],
    }
    return head, arrays.blob()


def _as_hexes(elements: np.ndarray) -> np.ndarray:
    """Return cells (m, 8) as hexes with collapsed edges, whose faces are those of the cells or have no area."""
    answer = elements.copy()
    for kind, rows in rows_by_kind(elements):
        if kind is WEDGE or kind is TETRAHEDRON:
            answer[rows] = elements[rows][:, [0, 1, 2, 2, 3, 4, 5, 5]]
    return answer


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


def _metric(metric: Metric, versions: Sequence[Version]) -> tuple[dict[str, Any], list[np.ndarray]]:
    """Return the description of a metric for the page, and its values of each version, (m,) uint16."""
    values = [metric.values(version.mesh, version.quality) for version in versions]
    invalid = np.concatenate([version.quality.invalid for version in versions])
    colouring = resolve(Colours(metric.name), np.concatenate(values), invalid)
    declared = bool(np.isfinite(metric.full_range).all())
    low, high = metric.full_range if declared else (colouring.low, colouring.high)
    last = _EXACT.get(metric.name, _STEPS)
    with np.errstate(invalid="ignore", over="ignore"):
        steps = [np.rint(np.clip((array - low) / (high - low), 0, 1) * last) for array in values]
    numbers = [np.where(np.isnan(array), last + 1, array).astype(np.uint16) for array in steps]
    kind = {
        "name": metric.name,
        "title": metric.title,
        "unit": metric.unit,
        "better": metric.better,
        "steps": last,
        "from": low,
        "to": high,
        "open": not declared,  # values beyond these two are clipped
        "low": colouring.low,  # invalid hexes have separate colours
        "high": colouring.high,
    }
    return kind, numbers
