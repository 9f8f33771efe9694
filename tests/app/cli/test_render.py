"""`hexmend render` of scenes: the file, the options that override it, and the scene that is written."""

import signal

import numpy as np
import pytest
from PIL import Image

from hexmend import gallery, io, write
from hexmend.cli.main import main
from hexmend_app.picture import Camera, Colours, Cut, CutStyle, Isolate, PicturePanel, Plane, Range, Scene, Show
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.page import ColourBarStyle, LineStyle, Page, TextPlace
from hexmend_app.picture.scene_files import camera_text, read_scene, write_scene
from tests.core.grids import grid, scrambled
from tests.programs import run_python

FILE = Scene(
    cameras={"side": Camera("+y")},
    cut=Cut((Plane((0, 1, 0), 0.5),)),
    colours=Colours("scaled-jacobian", "plasma", Range.FITTED),
    lines=LineStyle(0.4),
    page=Page(60, 40, dpi=150, shading=False),
)


@pytest.fixture
def render(tmp_path, capsys):
    """Run the command on a mesh; return the scene that it draws, the picture and the output."""
    write(tmp_path / "mesh.vtu", scrambled(grid(3), 0.4))
    write_scene(tmp_path / "scene.toml", FILE)

    def run(*words, meshes=1, scene=True, name="p.png"):
        given = ["--scene", str(tmp_path / "scene.toml")] if scene else []
        out = ["-o", str(tmp_path / name), "--save-scene", str(tmp_path / "drawn.toml")]
        assert main(["render", *[str(tmp_path / "mesh.vtu")] * meshes, *given, *out, *words]) == 0
        with Image.open(tmp_path / name) as image:
            return read_scene(tmp_path / "drawn.toml"), image.copy(), capsys.readouterr().out

    return run


def test_a_scene_is_drawn_unchanged(render):
    scene, image, said = render()
    assert scene == FILE
    assert image.size == (354, 236)
    assert said.endswith("p.png: 354 × 236 pixels\n")
    assert float(image.info["dpi"][0]) == pytest.approx(150, rel=1e-3)


OVERRIDES = [
    (["--mm", "50x30"], "page", Page(50, 30, dpi=150, shading=False)),
    (["--dpi", "300"], "page", Page(60, 40, dpi=300, shading=False)),
    (["--size", "200x100"], "page", Page(pixels=(200, 100), dpi=150, shading=False)),
    (["--background", "#204060"], "page", Page(60, 40, dpi=150, shading=False, background="#204060")),
    (["--camera", "side"], "camera", Camera("+y")),
    (["--camera", camera_text(Camera((1.0, 2.0, 3.0), up="x"))], "camera", Camera((1.0, 2.0, 3.0), up="x")),
    (["--view", "-x"], "camera", Camera("-x")),
    (["--metric", "skew"], "colours", Colours("skew", "plasma", (0.0, 1.0))),
    (["--metric", "volume"], "colours", Colours("volume", "plasma", Range.FITTED)),
    (["--colour-range", "0.2,0.4"], "colours", Colours("scaled-jacobian", "plasma", (0.2, 0.4))),
    (["--clip", "x:0.25", "--flip"], "cut", Cut((Plane((-1, 0, 0), 0.75),))),
    (["--no-edges"], "lines", LineStyle(0.0)),
    (["--structure", "sharp"], "structure", Structure.of("sharp")),
    (["--no-bar"], "bar", ColourBarStyle(TextPlace.NONE)),
    (["--captions", "mended"], "panels", (PicturePanel(caption="mended"),)),
]


@pytest.mark.parametrize(("words", "field", "value"), OVERRIDES)
def test_options_override_the_scene(render, words, field, value):
    scene, _, _ = render(*words)
    assert getattr(scene, field) == value
    others = [name for name in ("page", "camera", "colours", "cut", "lines", "bar", "panels") if name != field]
    assert all(getattr(scene, name) == getattr(FILE, name) for name in others)


KEYS = [
    (
        ["--key", "page.margin=2", "--key", "page.crop=true"],
        "page",
        Page(60, 40, dpi=150, shading=False, margin=2, crop=True),
    ),
    (["--key", "page.figures=false"], "page", Page(60, 40, dpi=150, shading=False, figures=False)),
    (["--key", "bar.ticks=0,0.5", "--key", "bar.place=right"], "bar", ColourBarStyle(TextPlace.RIGHT, (0.0, 0.5))),
    (["--key", "bar.ticks=4", "--key", 'bar.title="6"'], "bar", ColourBarStyle(ticks=4, title="6")),
    (["--key", "show.hidden=3,1", "--key", "show.peel=1"], "show", Show(hidden=(3, 1), peel=1)),
    (["--key", "show.isolate={ hexes = [4], rings = 0 }"], "show", Show(isolate=Isolate((4,), 0))),
    (["--key", "show.quality=-inf,0.5"], "show", Show(quality=(-np.inf, 0.5))),
    (["--key", "camera.up=y", "--key", "camera.parallel=true"], "camera", Camera(up="y", parallel=True)),
    (["--colour-range", "full"], "colours", Colours("scaled-jacobian", "plasma", Range.FULL)),
    (["--smooth"], "cut", Cut((Plane((0, 1, 0), 0.5),), style=CutStyle.SMOOTH)),
]


@pytest.mark.parametrize(("words", "field", "value"), KEYS)
def test_every_key_of_a_scene_can_be_set(render, words, field, value):
    scene, _, _ = render(*words)
    assert getattr(scene, field) == value


def test_options_alone_are_saved_as_a_scene_that_draws_the_same(render, tmp_path):
    words = ["--clip", "z:0.4", "--smooth", "--metric", "edge-ratio", "--structure", "sharp", "--size", "300x200"]
    _, image, _ = render(*words, scene=False)
    (tmp_path / "drawn.toml").rename(tmp_path / "scene.toml")
    _, again, _ = render(name="q.png")
    assert np.array_equal(np.asarray(image), np.asarray(again))


def test_a_cut_that_names_hexes_shows_these(render, tmp_path, complaint):
    def drawn(hexes, name):
        cut = Cut((Plane((0, 0, 1), 0),), hexes=hexes)
        write_scene(tmp_path / "scene.toml", Scene(cut=cut, page=Page(pixels=(200, 150))))
        return np.asarray(render(name=name)[1]).astype(int)

    assert np.abs(drawn("0-8", "p.png") - drawn("0-26", "q.png")).mean() > 1
    write_scene(tmp_path / "scene.toml", Scene(cut=Cut((Plane(),), hexes="0-27")))
    words = ["--scene", tmp_path / "scene.toml", "-o", "p.png"]
    assert "[cut] names hex 27: expected one of the mesh, below 27" in complaint(
        "render", tmp_path / "mesh.vtu", *words
    )


def test_displacements_start_at_the_first_mesh(render, tmp_path, complaint):
    write_scene(tmp_path / "scene.toml", Scene(colours=Colours("moved-most", range=Range.FITTED)))
    render("--size", "200x120", meshes=2)
    words = ["--scene", tmp_path / "scene.toml", "-o", "p.png"]
    assert "name the mesh before the movement first, then the mesh" in complaint(
        "render", tmp_path / "mesh.vtu", *words
    )


ERRORS = [
    (["--camera", "front"], 2, "--camera 'front' cannot be used: expected the text of a camera, or a name in the"),
    (["--camera", "{ from = 'up' }"], 2, "[camera]: from = 'up' is unknown"),
    (["--mm", "170"], 2, "--mm '170' cannot be used: expected 2 numbers"),
    (["--mm", "2x3"], 2, "width = 2.0 is out of range: expected a number from 5 to 3,000 mm"),
    (["--dpi", "many"], 2, "--dpi 'many' cannot be used"),
    (["--background", "mauve"], 2, "background = 'mauve' is unknown"),
    (["--scene", "nowhere.toml"], 3, "nowhere.toml: there is no such file"),
    (["--captions", "a,b"], 2, "as many names as panels (1), separated by commas"),
    (["--save-scene", "scene.json"], 3, "a scene cannot be written as .json"),
]


@pytest.mark.parametrize(("words", "status", "said"), ERRORS)
def test_errors_are_reported_before_anything_is_written(tmp_path, run_command, words, status, said):
    write(tmp_path / "mesh.vtu", grid(2))
    assert said in run_command("render", tmp_path / "mesh.vtu", "-o", tmp_path / "p.png", *words, status=status).err
    assert not (tmp_path / "p.png").exists()


# Ctrl-C while VTK draws.


#: The program; a signal arrives while VTK calls back into Python.
PROGRAM = """
import os, signal, sys
from hexmend.cli.main import main
from hexmend_app.scene.render.stage import Stage
whole = Stage.__init__
def begin(self, size):
    whole(self, size)
    self.window.AddObserver("StartEvent", lambda *_: os.kill(os.getpid(), int(os.environ["SIGNAL"])))
Stage.__init__ = begin
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.slow
def test_a_signal_while_a_picture_is_drawn_ends_it_in_order(tmp_path):
    io.write(tmp_path / "mesh.vtu", gallery.make("cube", size=27, scramble=0.3))
    words = ["render", tmp_path / "mesh.vtu", "-o", tmp_path / "mesh.png"]
    done = run_python("-c", PROGRAM, *words, variables={"SIGNAL": str(int(signal.SIGTERM))})
    assert (done.returncode, done.stderr) == (128 + signal.SIGTERM, "hexmend: interrupted\n")
    assert [path.name for path in tmp_path.iterdir()] == ["mesh.vtu"]
