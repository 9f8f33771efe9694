"""Pages: sizes, formats, backgrounds and texts."""

import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from hexmend_app.picture import Camera, Colours, Cut, PicturePanel, Plane, Range, Scene, Show
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.picture.page import AxesStyle, Captions, ColourBarStyle, Page, TextPlace
from hexmend_app.scene.colour.colouring import INVERTED
from hexmend_app.scene.film.film_frames import pictures
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer, draw_page
from hexmend_app.scene.page.rasters import rasters
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from tests.core.grids import grid, scrambled

BARE = {"bar": ColourBarStyle(TextPlace.NONE), "axes": AxesStyle(show=False)}


def page_meshes(*meshes):
    return [PageMesh.of(mesh, name) for mesh, name in zip(meshes, "abcd", strict=False)]


def drawn(*meshes, scene=None, **tables):
    scene = Scene(**tables) if scene is None else scene
    return draw_page(scene, page_meshes(*meshes))


def pixels(sheet):
    return np.asarray(sheet.image()).astype(int)


SIZES = [
    (Page(85, 60), (1004, 709)),
    (Page(85, 60, dpi=127), (425, 300)),
    (Page(pixels=(333, 217)), (333, 217)),
    (Page(pixels=(400, 300), dpi=97.3), (400, 300)),
    (Page(width=80, dpi=100), (315, 197)),
    (Page(pixels=(17, 16)), (17, 16)),
]


@pytest.mark.parametrize(("page", "size"), SIZES)
def test_a_page_has_exactly_the_pixels_asked_for(tmp_path, page, size):
    sheet = drawn(grid(2), page=page)
    assert sheet.size == page.size == size
    for name in ("p.png", "p.tif"):
        sheet.write(tmp_path / name)
        with Image.open(tmp_path / name) as image:
            assert image.size == size
            assert float(image.info["dpi"][0]) == pytest.approx(page.resolution, rel=1e-3)


@pytest.mark.slow
def test_the_same_page_is_the_same_file(tmp_path):
    pages = [drawn(scrambled(grid(3), 0.5), grid(3), page=Page(85, 50, dpi=150)) for _ in range(2)]
    for name in ("p.pdf", "p.svg", "p.png", "p.tif"):
        files = []
        for page in pages:
            page.write(tmp_path / name)
            files.append((tmp_path / name).read_bytes())
        assert files[0] == files[1]
        assert b"Date" not in files[0].replace(b"CreationDate (D", b"")


@pytest.mark.slow
def test_vector_files_have_the_size_in_millimetres_and_contain_texts(tmp_path):
    sheet = drawn(grid(2), grid(2), page=Page(170, 80), bar=ColourBarStyle(title="quality $x_1$ <b>"))
    sheet.write(tmp_path / "p.svg")
    text = (tmp_path / "p.svg").read_text()
    sides = re.search(r'<svg [^>]*width="([0-9.]+)pt" height="([0-9.]+)pt"', text).groups()
    assert [float(side) / 72 * 25.4 for side in sides] == pytest.approx([170, 80], abs=0.1)
    texts = re.findall(r"<text[^>]*>([^<]*)</text>", text)
    assert {"quality $x_1$ &lt;b&gt;", "a", "b", "X", "Y", "Z", "0", "1", "inverted"} <= set(texts)
    assert text.count("<image") == 3  # two panels and the gradient
    sheet.write(tmp_path / "p.pdf")
    box = re.search(rb"/MediaBox \[ ?0 0 ([0-9.]+) ([0-9.]+) ?\]", (tmp_path / "p.pdf").read_bytes())
    assert [float(side) / 72 * 25.4 for side in box.groups()] == pytest.approx([170, 80], abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("place", [TextPlace.BELOW, TextPlace.RIGHT])
def test_the_gradient_of_the_bar_has_no_seams(place):
    image = pixels(
        drawn(grid(1), page=Page(pixels=(1600, 1000)), bar=ColourBarStyle(place), show=Show(quality=(0, 0.1)))
    )
    colours = COLOUR_MAPS["viridis"].table.astype(int)
    apart = np.abs(image[:, :, None] - colours[[0, 255]]).sum(axis=3)
    dark = np.argwhere(apart[:, :, 0] < 12).mean(axis=0).astype(int)
    line = image[dark[0]] if place is TextPlace.BELOW else image[::-1, dark[1]]
    distance = np.abs(line[:, None] - colours[None]).sum(axis=2)
    inside = np.flatnonzero(distance.min(axis=1) < 12)
    run = distance[inside[0] : inside[-1] + 1]
    assert (run.min(axis=1) < 12).all()  # nothing that is no colour of the map
    assert (np.diff(run.argmin(axis=1)) >= 0).all()
    assert len(np.unique(run.argmin(axis=1))) > 250


def test_a_transparent_picture_over_a_background_equals_the_opaque_picture():
    on, off = (drawn(scrambled(grid(3), 0.5), page=Page(pixels=(400, 250), background=ground)).image()
               for ground in ("#e0a080", "transparent"))  # fmt: skip
    assert off.mode == "RGBA"
    assert off.getpixel((2, 2))[3] == 0
    paper = Image.new("RGBA", off.size, "#e0a080")
    paper.alpha_composite(off)
    assert np.abs(np.asarray(paper.convert("RGB")).astype(int) - np.asarray(on)).mean() < 0.5


def test_a_cropped_page_has_the_mesh_at_its_sides():
    whole = drawn(grid(2), page=Page(pixels=(900, 300)), **BARE)
    cropped = drawn(grid(2), page=Page(pixels=(900, 300), crop=True), **BARE)
    assert whole.size == (900, 300)
    assert cropped.size[0] < 500
    seen = (pixels(cropped) < 250).any(axis=2)
    assert seen[:, 0].any() and seen[:, -1].any() and seen[0].any() and seen[-1].any()  # noqa: PT018
    nothing = drawn(grid(2), page=Page(pixels=(90, 70), crop=True), show=Show(quality=(0, 0.1), outline=False), **BARE)
    assert nothing.size == (90, 70)
    with_bar = drawn(grid(2), page=Page(pixels=(900, 300), crop=True))
    assert with_bar.size[1] < 300 or with_bar.size[0] < 900


def test_one_mesh_is_seen_from_several_directions():
    scene = Scene(
        cameras={"side": Camera("+x"), "top": Camera("+z", parallel=True)},
        panels=(PicturePanel("side", caption="side"), PicturePanel("top", caption="top")),
        page=Page(pixels=(800, 420), captions=Captions.LETTERS),
        cut=Cut((Plane((0, 0, 1), 0.5),)),
    )
    sheet = drawn(scrambled(grid(5), 0.7), scene=scene)
    image = pixels(sheet)
    magenta = (np.abs(image[:340] - INVERTED).sum(axis=2) < 60).sum(axis=0)
    assert magenta[400:].sum() > 0
    left, right = image[40:330, :390], image[40:330, 410:]
    assert np.abs(left - right).mean() > 10


def test_panels_share_a_range_that_is_fitted():
    scene = Scene(colours=Colours(range=Range.FITTED), page=Page(pixels=(600, 300)))
    good, bad = grid(3), scrambled(grid(3), 0.3)
    drawn_together = pixels(drawn(good, bad, scene=scene))
    pinned = Scene(colours=Colours(range=(float(PageMesh.of(bad).quality.q.min()), 1.0)), page=scene.page)
    assert np.abs(drawn_together - pixels(drawn(good, bad, scene=pinned))).mean() < 0.5


@pytest.mark.slow
def test_a_name_is_drawn_verbatim_and_stays_within_its_panel():
    page = Page(pixels=(500, 260))
    plain, *others = (
        pixels(draw_page(Scene(page=page, **BARE), [PageMesh.of(grid(2), "b"), PageMesh.of(grid(2), name)]))
        for name in ("", "a" * 300, "$x^2$ \\alpha {", "‮×")
    )
    assert all(np.array_equal(plain[:, :245], other[:, :245]) for other in others)


@pytest.mark.parametrize("before", [False, True])
def test_a_later_frame_of_a_film_equals_the_page_of_its_mesh(before):
    camera = Camera(position=(9.0, -9.0, 7.0), focal=(1.5, 1.5, 1.5), view_up=(0.0, 0.0, 1.0), scale=3.0)
    scene = Scene(camera=camera, page=Page(pixels=(480, 300), supersampling=1))
    first = scrambled(grid(3), 0.7)
    last = first.with_points(scrambled(grid(3), 0.2).points)
    states, name = [MeasuredMesh.of(mesh) for mesh in (first, last)], "iteration 1 of 1"
    record = History().begin("run", states[0])
    record.rows = [{}, {}]
    _, drawn = pictures(record, (0, 1), states.__getitem__, scene, histogram=True, before=before)
    named = [(first, "Before"), (last, name)] if before else [(last, f"run, {name}")]
    panels = tuple(PicturePanel(mesh=number, caption=name) for number, (_, name) in enumerate(named, 1))
    meshes = [PageMesh.of(mesh, name) for mesh, name in named]
    layout = Layout.of(replace(scene, panels=panels), meshes, figures=True, histogram=True)
    afresh = np.asarray(PageRenderer(layout, rasters(layout)).image()).astype(int)
    assert np.ptp(afresh) > 200
    assert np.abs(np.asarray(drawn) - afresh).max() <= 2
