"""Arguments of kernels of the window, and of texts."""

from collections.abc import Iterator

import numpy as np

from tests.core.kernels.arguments.rows import Row, case, row


def rows() -> Iterator[Row]:
    n, f, places = case().n, case().f, case().faces.ravel()
    yield row("decimals.decimal_lines", empty="last", values=6, width=3, last=2)
    yield row("decimals.whole_lines", empty="values", values=6, width=3)
    polygons = {"start": 4 * np.arange(f + 1), "places": places}
    light = {"normals": f, "directions": 2, "side": 16, "light": 4 * f, "whole": 4 * f}
    yield row("occlusion.normals", "points", answer=f, **polygons)
    yield row("occlusion.shine", "points", "directions", **light, **polygons)
    yield row("skin.visible", nodes=n)
    yield row("skin.edges_kept", edges=f, answer=f)
