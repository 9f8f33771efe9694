"""Off-screen pictures: shown and hidden hexes and colours, checked by pixels."""

import argparse
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from PySide6.QtGui import QOpenGLContext

from hexmend import FileError, write
from hexmend.cli.main import main
from hexmend_app.cli.render import command
from hexmend_app.cli.scene_options import parse_plane, scene
from hexmend_app.picture import ColourBarStyle, Cut, CutStyle, LineStyle, Page, Scene, Show, TextPlace
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.cut_shapes import Box, Depth, DepthUnit, Plane, Slab
from hexmend_app.scene.colour.colouring import INVERTED
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from tests.core.grids import grid, scrambled


@pytest.fixture
def pictures(tmp_path):
    """A function that draws a mesh with options of the command."""
    write(tmp_path / "mesh.vtu", scrambled(grid(5), 0.7))

    def draw(*words, call=main):
        assert call(["render", f"{tmp_path}/mesh.vtu", "-o", f"{tmp_path}/p.png", "--size", "320x240", *words]) == 0
        return np.asarray(Image.open(tmp_path / "p.png").convert("RGB")).astype(int)

    return draw


def ink(image):
    """Return the fraction of coloured pixels of the view, without the colour bar."""
    view = image[: int(image.shape[0] * 0.85), 60:]
    return np.mean(view.max(axis=2) - view.min(axis=2) > 40)


def test_structure_is_drawn_by_name(pictures):
    bare = pictures("--no-edges")
    black = np.array([0x11, 0x15, 0x1C])
    assert (bare == black).all(axis=2).sum() == 0
    assert (pictures("--no-edges", "--structure", "sharp,irregular") == black).all(axis=2).sum() > 50


def test_a_plane_hides_half(pictures):
    whole = ink(pictures("--view", "+z"))
    for cut in ((), ("--smooth",)):
        half = ink(pictures("--view", "+z", "--clip", "x:0.4", *cut))
        assert 0.25 * whole < half < 0.65 * whole


def without_a_display(words):
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run([sys.executable, "-m", "hexmend", *words], env=environment).returncode


@pytest.mark.slow
def test_a_smooth_cut_shows_inverted_elements_inside(pictures):
    inside = pictures("--view", "+z", "--clip", "z:0.5", "--smooth", call=without_a_display)[:200]
    assert (np.abs(inside - INVERTED).sum(axis=2) < 90).sum() > 50


def test_a_quality_range_hides_the_others(pictures):
    assert ink(pictures("--key", "show.quality=0.99,1")) < 0.3 * ink(pictures("--view", "iso"))


INVALID_OPTIONS = [
    (["--clip", "w"], "--clip 'w' cannot be used"),
    (["--clip", "0,0,0"], "normal = [0, 0, 0] is no direction"),
    (["--clip", "x:1.5"], "position = 1.5 is out of range: expected a number from 0 to 1"),
    (["--key", "cut.depth={ low = 1 }", "--smooth"], "has whole hexes"),
    (["--key", "cut.sphere={ size = 1 }"], "[cut] sphere has an unknown key 'size'"),
    (["--key", "cut.depth=deep"], "[cut] depth"),
    (["--key", "paper.margin=1"], "unknown key 'paper'"),
    (["--key", "page.margin"], "TABLE.KEY=VALUE"),
    (["--key", "page.margin=wide"], "[page] margin = 'wide' is not a number"),
    (["--size", "big"], "as in 1600x1000"),
    (["--size", "16x16"], "64 to 8192 pixels"),
    (["--key", "show.quality=0.8,0.2"], "the lower number first"),
    (["--colour-range", "0.5,0.5"], "the lower number first"),
    (["--metric", "beauty"], "there is no metric 'beauty'"),
    (["--colour-map", "jet"], "expected one of viridis"),
    (["--structure", "sharp,round"], "names among irregular, boundary, sharp, fixed, free, locked"),
    (["--view", "up"], "from = 'up' is unknown"),
    (["--view", "0,0,0"], "expected a nonzero vector"),
]


@pytest.mark.parametrize(("words", "message"), INVALID_OPTIONS)
def test_invalid_options_are_reported(words, message, tmp_path, run_command):
    write(tmp_path / "mesh.vtu", grid(2))
    assert message in run_command("render", tmp_path / "mesh.vtu", "-o", tmp_path / "out.png", *words, status=2).err


def test_at_most_12_meshes_are_drawn(tmp_path, run_command):
    write(tmp_path / "mesh.vtu", grid(2))
    printed = run_command("render", *[str(tmp_path / "mesh.vtu")] * 13, "-o", tmp_path / "none.png", status=2).err
    assert "at most 12" in printed
    assert not (tmp_path / "none.png").exists()


def sheet(*meshes, look=Look(), bar=True, names="abcdef", **page):  # noqa: B008
    page = replace(look.page, **page)
    scene = Scene.of(look, page=page, bar=ColourBarStyle(TextPlace.BELOW if bar else TextPlace.NONE))
    return draw_page(scene, [PageMesh.of(mesh, name) for mesh, name in zip(meshes, names, strict=False)])


def test_values_may_begin_with_a_minus():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    command.arguments(parser)
    args = parser.parse_args(["a.vtk", "-o", "a.png", "--view", "-x", "--clip", "-1,0,0:0.4", "--no-bar"])
    assert (args.view, args.clip, args.output, args.no_bar) == ("-x", ["-1,0,0:0.4"], "a.png", True)
    assert parser.parse_args(["a.vtk", "-o", "a.png", "--clip", "-.5,1,0"]).clip == ["-.5,1,0"]


def asked(mesh, *words):
    parser = argparse.ArgumentParser(allow_abbrev=False)
    command.arguments(parser)
    return scene(parser.parse_args(["a.vtk", "-o", "a.png", *words])).look(mesh).cut


def test_planes_are_named_by_axis_or_normal_and_position():
    mesh = grid(4)
    assert asked(mesh) == Cut()
    assert asked(mesh, "--clip", "x:0.25") == Cut.at((1, 0, 0), (1, 0, 0))
    assert asked(mesh, "--clip", "z", "--flip", "--smooth") == Cut.at((0, 0, -1), (0, 0, 2), CutStyle.SMOOTH)
    slanted = parse_plane("1,1,0:0.5").on(mesh)
    assert slanted.signed_distance(np.array([[2.0, 2.0, 0.0]]))[0] == pytest.approx(0)
    assert parse_plane("1e300,0,0:0.25").on(mesh) == Plane((1, 0, 0), point=(1, 0, 0))


def test_several_planes_and_boxes_are_asked_for():
    mesh = grid(4)
    two = asked(mesh, "--clip", "x:0.25", "--clip", "y:0.5", "--key", "cut.notch=true")
    assert two == Cut((Plane((1, 0, 0), point=(1, 0, 0)), Plane((0, 1, 0), point=(0, 2, 0))), notch=True)
    assert asked(mesh, "--key", "cut.box={ low = [0, 0.25, 0], high = [0.5, 1, 1], shares = true }") == Cut(
        box=Box((0, 1, 0), (2, 4, 4))
    )


def test_other_shapes_are_asked_for():
    mesh = grid(4)
    slab = Slab((1, 0, 0), point=(1, 0, 0), thickness=2)
    assert asked(mesh, "--key", "cut.slab={ position = 0.25, thickness = 0.5 }", "--smooth") == Cut(
        slab=slab, style=CutStyle.SMOOTH
    )
    sphere = "cut.sphere={ centre = [0.5, 0, 1], radius = 0.25, shares = true }"
    inside_out = asked(mesh, "--key", sphere, "--key", "cut.notch=true")
    assert (inside_out.sphere.centre, inside_out.notch) == ((2, 0, 4), True)
    assert inside_out.sphere.radius == pytest.approx(0.25 * 4 * 3**0.5)
    assert asked(mesh, "--key", 'cut.depth={ low = 0.5, high = 3, unit = "edges" }') == Cut(
        depth=Depth(0.5, 3, DepthUnit.EDGES)
    )


def test_a_picture_has_the_format_of_its_suffix(tmp_path, capsys):
    write(tmp_path / "mesh.vtu", grid(2))
    assert main(["render", str(tmp_path / "mesh.vtu"), "-o", str(tmp_path / "p.jpg")]) != 0
    assert "p.jpg: a picture cannot be written as .jpg. Use .png, .tif, .tiff, .pdf or .svg." in capsys.readouterr().err
    assert [one.name for one in tmp_path.iterdir()] == ["mesh.vtu"]
    page = sheet(grid(2), pixels=(40, 30))
    for name, kind in (("p.PNG", "PNG"), ("p", "PNG"), ("p.tif", "TIFF")):
        page.write(tmp_path / name)
        with Image.open(tmp_path / name) as read:
            assert (read.format, read.size) == (kind, (40, 30))
    with pytest.raises(FileError, match=r"Use \.png"):
        page.write(tmp_path / "p.jpg")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("panels", "lines"),
    [(1, {"lines": LineStyle()}), (2, {"show": Show()}), (1, {"structure": Structure.of("sharp")})],
)
def test_lines_are_as_thick_on_paper_in_every_size(panels, lines):
    if QOpenGLContext.currentContext() is not None:
        QOpenGLContext.currentContext().doneCurrent()  # a window's, in which VTK would draw by another library
    bare = {"lines": LineStyle(edges=0.0), "show": Show(outline=False), "page": Page(shading=False)}
    look = Look(**bare | lines)
    shares = []
    for size in ((1440, 900), (2880, 1800)):
        page = sheet(*[grid(2)] * panels, look=look, pixels=size, supersampling=1)
        image = np.asarray(page.image().convert("L"))[100 : round(0.75 * size[1])]  # without words and axes
        shares.append((image < 150).mean())
    assert shares[0] > 5e-4
    assert shares[1] == pytest.approx(shares[0], rel=0.2)
