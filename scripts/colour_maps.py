"""Keeps matplotlib's colour maps in resources/colour_maps.npz: the viewer draws by them before matplotlib is loaded."""

from pathlib import Path

import numpy as np
from matplotlib import colormaps

from hexmend_app.picture.colour_map import COLOUR_MAPS


def of_matplotlib(name: str) -> np.ndarray:
    """A map as (256, 3) uint8."""
    return (colormaps[name](np.linspace(0, 1, 256))[:, :3] * 255).round().astype(np.uint8)


if __name__ == "__main__":
    path = Path(__file__).parents[1] / "resources" / "colour_maps.npz"
    np.savez_compressed(path, **{name: of_matplotlib(name) for name in COLOUR_MAPS})
