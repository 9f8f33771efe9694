"""Arguments of kernels of the window, and of texts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tests.core.kernels.arguments.rows import Row, case, row


def rows() -> Iterator[Row]:
    n, m, f, places = case().n, case().m, case().f, case().faces.ravel()
    planes = {"normals": 2, "offsets": 2}
    yield row("binning.count", values=m, inverted=m, low=0, scale=1, open_low=True, open_high=True, counts=4)
    yield row("clip_planes.centres_kept", "points", kept=m, notch=False, **planes)
    yield row("clip_planes.centre_heights", "points", normal=1, eightfold=m)
    yield row("clip_planes.opened", eightfold=m, extent=1.0, offset=0.0)
    yield row("clip_planes.touched", "points", answer=2 * m, notch=False, **planes)
    yield row("corner_values.largest", "of_nodes", of_nodes=n, of_hexes=m)
    yield row("corner_values.mean", "of_nodes", of_nodes=n, of_hexes=m)
    yield row("decimals.decimal_lines", empty="last", values=6, width=3, last=2)
    yield row("decimals.whole_lines", empty="values", values=6, width=3)
    polygons = {"start": 4 * np.arange(f + 1), "places": places}
    light = {"normals": f, "directions": 2, "side": 16, "light": 4 * f, "whole": 4 * f}
    yield row("occlusion.normals", "points", answer=f, **polygons)
    yield row("occlusion.shine", "points", "directions", **light, **polygons)
    yield row("polygons.before", "points", owner=f, **planes, **polygons)
    yield row("skin.visible", nodes=n)
    yield row("skin.faces_of", chosen=m, hidden=False)
    yield row("skin.outer", answer=m)
    yield row("skin.shrunk", "points", nodes=case().mesh.hexes.ravel(), shrink=0.5, places=8 * m)
    yield row("skin.edges_kept", edges=f, answer=f)
