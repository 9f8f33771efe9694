"""Pictures that are too large to be rendered at once: tiles are joined without seams."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend_app.picture import Camera, Cut, CutStyle, Page, PicturePanel, Plane, Scene, WipeLayout
from hexmend_app.picture.appearance import Structure
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.rasters import rasters
from hexmend_app.scene.render.colour_count import count_colours
from hexmend_app.scene.render.tiles import AT_ONCE, Tiles
from tests.core.grids import grid, scrambled

#: Number of pixels at once, smaller than that of the pictures.
FEW = 2**17

MESHES = [PageMesh.of(scrambled(grid(6), share), name) for share, name in ((0.7, "a"), (0.2, "b"))]


def images(scene, **how):
    found = rasters(Layout.of(scene, MESHES[: 1 + bool(scene.panels)]), **how).images
    return [np.asarray(image).astype(int) for image in found]


PICTURES = [
    (1, "transparent", {"structure": Structure.of("sharp", "fixed"), "cut": Cut((Plane((0, 0, 1), 0.6),))}),
    (3, "white", {"camera": Camera((0.3, -1.0, 0.2)), "cut": Cut((Plane((1, 1, 0), 0.4),), style=CutStyle.SMOOTH)}),
    (1, "white", {"panels": (PicturePanel(wipe=WipeLayout(2, 0.37)),)}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("supersampling", "background", "tables"), PICTURES)
def test_a_picture_in_tiles_equals_the_one_rendered_at_once(tables, background, supersampling):
    scene = Scene(page=Page(pixels=(601, 400), supersampling=supersampling, background=background), **tables)
    (whole,), (parts,) = (images(scene, **how) for how in ({}, {"at_once": FEW}))
    assert parts.shape == whole.shape
    assert np.ptp(whole[..., :3]) > 100
    off = np.abs(parts - whole).max(axis=2)
    assert off.mean() < 0.05  # an edge that stands upright is rounded to one pixel or the next
    tiles = Tiles.of(whole.shape[1::-1], supersampling, supersampling * scene.page.line_width(scene.lines), FEW)
    seams = [off[:, tile.left - 2 : tile.left + 2] for tile in tiles if tile.left]
    seams += [off[tile.top - 2 : tile.top + 2] for tile in tiles if tile.top]
    assert len(seams) > 1
    assert max((seam > 16).mean() for seam in seams) < 0.02


@pytest.mark.parametrize("size", [(16, 16), (6000, 4000), (16384, 4096), (8192, 8192), (17, 16384)])
@pytest.mark.parametrize(("fine", "pen"), [(1, 1.0), (2, 5000.0), (4, 40.0)])
def test_tiles_cover_a_page_once_and_none_is_too_large(size, fine, pen):
    tiles = Tiles.of(size, fine, pen)
    assert max(tiles.drawn) <= 16384
    assert tiles.drawn[0] * tiles.drawn[1] <= AT_ONCE
    area = 0
    for tile in tiles:
        assert 0 < tile.width <= tiles.inner[0]
        assert 0 < tile.height <= tiles.inner[1]
        assert tile.left + tile.width <= size[0]
        assert tile.top + tile.height <= size[1]
        area += tile.width * tile.height
    assert area == size[0] * size[1]
    alone = fine * max(size) <= 16384 and fine * fine * size[0] * size[1] <= AT_ONCE
    assert (len(list(tiles)) == 1) == alone
    assert tiles.around == 0 or not alone


# Counts of colours, compared with those of rows.


@given(
    arrays(np.uint8, st.tuples(st.integers(0, 9), st.integers(1, 9), st.just(3)), elements=st.sampled_from([0, 1, 255]))
)
def test_counts_agree_with_those_of_unique_rows(pixels):
    colours, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    found = count_colours(pixels)
    np.testing.assert_array_equal(found[0], colours)
    np.testing.assert_array_equal(found[1], counts)
