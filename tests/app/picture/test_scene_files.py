"""Scenes as TOML: written scenes are read, and errors are reported with their position."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from hexmend.errors import FileError, ParameterError
from hexmend_app.picture import Camera, Colours, Cut, CutStyle, Isolate, PicturePanel, Range, Scene, Show, WipeLayout
from hexmend_app.picture.appearance import Measurement, Structure, Traces
from hexmend_app.picture.cut_shapes import Box, Depth, DepthUnit, Plane, Slab, Sphere
from hexmend_app.picture.page import AxesStyle, Captions, ColourBarStyle, Corner, LineStyle, Page, TextPlace
from hexmend_app.picture.scene_files import camera_from, camera_text, from_toml, read_scene, to_toml, write_scene

POSE = Camera(position=(0.1, -2.0, 3e-7), focal=(0.0, 0.0, 0.0), view_up=(0.0, 0.0, 1.0), scale=1 / 3, parallel=True)
FULL = Scene(
    camera=POSE,
    cameras={"a b": Camera("+x", up="y"), "side": Camera((1.0, 2.0, 3.0))},
    panels=(PicturePanel("side", 2, 'quoted " \\ $x$ ×', WipeLayout(1, 0.25)), PicturePanel()),
    cut=Cut((Plane((1, 1, 0), 0.3), Plane((0, 0, 1), point=(0.1, 0.2, 0.3))), style=CutStyle.SMOOTH, notch=True),
    show=Show((float("-inf"), 0.5), "scaled-jacobian", True, 2, Isolate((3, 4), 2), (1, 7), 0.1, False, (2, 9)),
    structure=Structure(frozenset({"sharp"})),
    movement=Traces(factor=3.0),
    colours=Colours("edge-ratio", "plasma", (1.0, 4.5), True),
    lines=LineStyle(0.4),
    measurement=Measurement(((0.1, 0, 0), (1, 2, 3))),
    bar=ColourBarStyle(TextPlace.RIGHT, (1.0, 2.0), "ratio"),
    axes=AxesStyle(False, Corner.UPPER_RIGHT),
    page=Page(170, 90, dpi=600, background="#102030", margin=2, columns=1, captions=Captions.LETTERS, font_size=7.5),
)


SCENES = [
    Scene(),
    FULL,
    Scene(cut=Cut(box=Box(shares=True)), colours=Colours(range=Range.FITTED)),
    Scene(cut=Cut(slab=Slab((0, 1, 1), 0.25, thickness=0.2), style=CutStyle.SMOOTH)),
    Scene(cut=Cut(slab=Slab((0, 1, 0), point=(1, 2, 3), thickness=4), notch=True)),
    Scene(cut=Cut(sphere=Sphere((1, 2, 3), 0.5), hexes="0-3")),
    Scene(cut=Cut(depth=Depth(0.5, 2, DepthUnit.EDGES))),
    Scene(cut=Cut((Plane(),), hexes="0-7, 9, 20-2000000000")),
]


@pytest.mark.parametrize("scene", SCENES)
def test_written_scenes_are_read(scene, tmp_path):
    assert from_toml(to_toml(scene)) == scene
    write_scene(tmp_path / "scene.toml", scene)
    assert read_scene(tmp_path / "scene.toml") == scene


@pytest.mark.parametrize("scene", [Scene(), FULL])
def test_default_values_can_be_omitted(scene):
    short = to_toml(scene, whole=False)
    assert len(short) < len(to_toml(scene))
    assert from_toml(short) == scene


@pytest.mark.parametrize("camera", [Camera(), POSE, Camera((1.0, 0.0, -2.5), up="x")])
def test_a_camera_is_one_line(camera):
    text = camera_text(camera)
    assert "\n" not in text
    assert camera_from(text) == camera_from(f" camera = {text}\n") == camera


ERRORS = [
    ("[bar]\ntick = 3", "[bar] has an unknown key 'tick': expected place, ticks, title"),
    ("bars = 1", "the file has an unknown key 'bars': expected cut, show"),
    ("format = 2", "format = 2 is not read: expected 1; use the Hexmend that wrote it"),
    ("cut = 3", "[cut] is not a table"),
    ("[page]\ndpi = 'x'", "[page] dpi = 'x' is not a number: expected a number from 5 to 4,800"),
    ("[page]\nwidth = nan", "[page] width = nan is out of range: expected a number from 5 to 3,000 mm"),
    ("[page]\npixels = [16384, 16384]", "[page]: the page has 16,384 × 16,384 pixels: expected at most 67,108,864"),
    ("[page]\nwidth = 3000\ndpi = 4800", "expected sides of 16 to 16,384"),
    ("[page]\nwidth = 30\npixels = [64, 64]", "expected one of them"),
    ("[page]\nmargin = 300", "margin = 300 leaves no space"),
    ("[page]\nbackground = 'red'", "expected white, transparent or #rrggbb"),
    ("[[panels]]\n[[panels]]\nmesh = 0", "[panels 2] mesh = 0 is out of range"),
    ("[[panels]]\ncamera = 'a'", "there is no camera 'a': [cameras] has none"),
    ("[cut]\nplanes = [{}, { normal = [1, 2] }]", "[cut] planes 2 normal = [1, 2] has 2 entries: expected 3"),
    ("[cut]\nplanes = [{ normal = [0, 0, 0] }]", "[cut] planes 1: normal = [0, 0, 0] is no direction"),
    ("[cut]\nplanes = [{ position = 0.1, point = [0, 0, 0] }]", "a position and a point"),
    ("[cut]\nplanes = [{}]\nbox = {}", "planes and a box"),
    ("[cut]\nplanes = [{}]\nhexes = '3-1'", "hexes: hexes 3 to 1 follow -1: expected ascending ranges"),
    (
        "[cut]\nplanes = [{}]\nhexes = '0-2, all'",
        "hexes: 'all' is not a range of numbers: expected, for example, 0-120, 130",
    ),
    ("[cut]\nplanes = [{}]\nhexes = '0'\nstyle = 'smooth'", "require a cut by whole hexes"),
    ("[cut]\nstyle = 'rough'", "[cut] style = 'rough' is unknown: expected crinkle, smooth"),
    ("[camera]\nfrom = 'up'", "[camera]: from = 'up' is unknown"),
    ("[camera]\nposition = [1, 2, 3]", "the exact pose is incomplete"),
    ("[cameras.a]\nup = 'w'", "[cameras.a]: up = 'w' is unknown"),
    ("[show]\nisolate = { hexes = [1, 2.5] }", "[show] isolate hexes = 2.5 is not a whole number"),
    ("[show]\nquality = [1, 0]", "expected the lower number first"),
    ("[colours]\nmetric = 'beauty'", "metric = 'beauty' is unknown: expected one of q"),
    ("[colours]\nrange = [1]", "[colours] range = [1] has 1 entries: expected 2"),
    ("[structure]\non = 1", "[structure] on = 1 is not a list"),
    ('[bar]\ntitle = "a\\u001b"', "is not a line of text"),
    ("[lines]\nedges = " + "9" * 400, "a huge number"),
    ("[lines]\nedges = " + "9" * 5000, "is not TOML"),
    ("a" + ".a" * 40 + " = 1", "a key of more than 8 parts"),
    ("a = " + "[" * 5000, "nested too deeply"),
    ("[page]\nwidth = " + "{a.a.a.a.a.a.a.a=" * 150 + "1" + "}" * 150, "[page] width = a table is not a number"),
    ("[bar", "is not TOML: expected"),
]


@pytest.mark.parametrize(("text", "message"), ERRORS)
def test_errors_are_reported_with_their_position(text, message, tmp_path):
    with pytest.raises(ParameterError) as error:
        from_toml(text)
    assert message in str(error.value)
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(FileError, match=r"scene\.toml: "):
        read_scene(tmp_path / "scene.toml")


@pytest.mark.parametrize("text", ["", "iso", "{", "{ from = 'iso' }\nx = 1", "{ a = 1 }", "[1]"])
def test_invalid_cameras_are_rejected(text):
    with pytest.raises(ParameterError):
        camera_from(text)


VALUES = st.recursive(
    st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.sampled_from(["q", "iso", "white"]),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(["normal", "hexes", "a"]), inner, max_size=3)
    ),
    max_leaves=6,
)
KEYS = [f"{table}.{key}" for table in ("page", "cut", "show", "camera", "bar", "cameras", "colours") for key in
        ("width", "pixels", "dpi", "planes", "box", "hidden", "isolate", "from", "ticks", "a", "range", "scale")]  # fmt: skip


@example({"bar.ticks": []})
@given(st.dictionaries(st.sampled_from(KEYS), VALUES, max_size=4))
def test_any_file_gives_a_scene_or_a_parameter_error(data):
    import tomli_w

    tables = {}
    for name, value in data.items():
        table, key = name.split(".")
        tables.setdefault(table, {})[key] = value
    try:
        scene = from_toml(tomli_w.dumps(tables))
    except ParameterError:
        return
    assert from_toml(to_toml(scene)) == scene
