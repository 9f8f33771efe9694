"""Metadata of pictures: written, read, and rejected if damaged or malicious."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image, ImageFile
from PIL.PngImagePlugin import PngInfo

from hexmend import FileError, ParameterError, Recipe
from hexmend_app.picture import Cut, Page, PicturePanel, Plane, Scene
from hexmend_app.picture.picture_metadata import PicturedMesh, digest, is_png, read_metadata, with_metadata
from tests.core.grids import grid

SCENE = Scene(cut=Cut((Plane(),)), panels=(PicturePanel(caption="Größe × ψ"),), page=Page(85, 60))


def written(path, metadata, compressed=False):
    info = PngInfo()
    for keyword, text in metadata.items():
        info.add_itxt(keyword, text, zip=compressed)
    Image.new("RGB", (40, 30)).save(path, pnginfo=info)
    return path


@pytest.fixture(autouse=True)
def strict(monkeypatch):
    """Let Pillow check what it reads; WeasyPrint, which another test may have imported, makes it lenient."""
    monkeypatch.setattr(ImageFile, "LOAD_TRUNCATED_IMAGES", False)


@pytest.fixture
def picture(tmp_path):
    meshes = [PicturedMesh.of(grid(2), grid(3), tmp_path / "up" / "mesh.vtu", tmp_path / "picture.png")]
    return written(tmp_path / "picture.png", with_metadata(SCENE, meshes, Recipe.of("getme", "mend")))


def test_written_metadata_are_read(picture):
    metadata = read_metadata(picture)
    assert (metadata.scene, metadata.recipe) == (SCENE, Recipe.of("getme", "mend"))
    assert metadata.first == PicturedMesh("up/mesh.vtu", digest(grid(2)), digest(grid(3)))
    with Image.open(picture) as image:
        image.load()
        assert image.text["hexmend scene"].startswith("# hexmend scene")


def test_a_digest_depends_on_hexes_and_positions():
    mesh = grid(2)
    assert digest(mesh) == digest(mesh.with_points(mesh.points.copy()))
    assert digest(mesh) != digest(mesh.with_points(mesh.points + 1e-12))
    assert digest(mesh) != digest(grid(3))


def test_the_mesh_is_found_at_its_path_or_next_to_the_picture(picture, tmp_path):
    first = read_metadata(picture).first
    assert first.candidates(picture) == []
    (tmp_path / "mesh.vtu").write_text("")
    assert first.candidates(picture) == [tmp_path / "mesh.vtu"]
    (tmp_path / "up").mkdir()
    (tmp_path / "up" / "mesh.vtu").write_text("")
    assert first.candidates(picture)[0] == tmp_path / "up" / "mesh.vtu"


@pytest.mark.parametrize("file", ["/etc/passwd", "\\\\host\\share\\a.vtu", "c:/mesh.vtu", "http://host/a"])
def test_paths_that_are_not_relative_are_rejected(file):
    with pytest.raises(ParameterError, match="is not a path relative to the picture"):
        PicturedMesh(file, "0" * 64, "0" * 64)


def test_a_picture_without_a_scene_is_an_error(tmp_path):
    Image.new("RGB", (4, 4)).save(tmp_path / "p.png")
    assert is_png(tmp_path / "p.png")
    with pytest.raises(FileError, match=r"p\.png: this picture contains no scene\. Open the mesh that it shows\."):
        read_metadata(tmp_path / "p.png")
    assert not is_png(tmp_path / "none.png")


def test_huge_compressed_texts_are_errors(tmp_path):
    metadata = {"hexmend scene": "# " + "a" * 40_000_000, "hexmend meshes": "x = 1"}
    path = written(tmp_path / "bomb.png", metadata, compressed=True)
    assert path.stat().st_size < 200_000
    with pytest.raises(FileError, match="the picture is damaged"):
        read_metadata(path)


def test_too_large_or_damaged_texts_are_errors(picture, tmp_path):
    large = written(tmp_path / "large.png", {"hexmend scene": "a" * 5_000_000, "hexmend meshes": ""})
    with pytest.raises(FileError, match="has 5,000,000 characters"):
        read_metadata(large)
    data = bytearray(picture.read_bytes())
    data[data.index(b"crinkle")] ^= 1
    (tmp_path / "damaged.png").write_bytes(data)
    with pytest.raises(FileError, match="damaged"):
        read_metadata(tmp_path / "damaged.png")
    (tmp_path / "short.png").write_bytes(picture.read_bytes()[:700])
    with pytest.raises(FileError, match="damaged"):
        read_metadata(tmp_path / "short.png")


INVALID_METADATA = [
    ("hexmend scene", "[bar]\ntick = 1", r"\[bar\] has an unknown key 'tick'"),
    ("hexmend scene", "[[panels]]\nmesh = 2", "panel 1 shows mesh 2, but there are 1"),
    ("hexmend meshes", "version = 1", "version = 1 is not a text"),
    ("hexmend meshes", "", "no mesh is listed"),
    ("hexmend meshes", "meshes = [{ file = 'a', opened = 'b', shown = 'c' }]", "is no digest"),
    ("hexmend recipe", "format = 1\n[[stage]]\nmethod = 'rm'", "there is no method 'rm'"),
]


@pytest.mark.parametrize(("keyword", "text", "message"), INVALID_METADATA)
def test_invalid_metadata_are_errors(tmp_path, keyword, text, message):
    metadata = with_metadata(SCENE, [PicturedMesh("", "0" * 64, "0" * 64)]) | {keyword: text}
    with pytest.raises(FileError, match=message):
        read_metadata(written(tmp_path / "p.png", metadata))


@pytest.mark.slow
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_any_picture_is_read_or_rejected(picture, tmp_path, data):
    whole = bytearray(picture.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(8, len(whole) - 1))
        whole[at : at + data.draw(st.integers(0, 6))] = data.draw(st.binary(max_size=6))
    (tmp_path / "other.png").write_bytes(whole)
    try:
        read_metadata(tmp_path / "other.png")
    except FileError as error:
        assert str(error).startswith("other.png: ")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.text(max_size=60), st.sampled_from(["hexmend scene", "hexmend meshes", "hexmend recipe"]))
def test_any_text_is_read_or_rejected(tmp_path, text, keyword):
    metadata = with_metadata(SCENE, [PicturedMesh("", "0" * 64, "0" * 64)]) | {keyword: text}
    try:
        read_metadata(written(tmp_path / "p.png", metadata))
    except FileError as error:
        assert str(error).startswith("p.png: ")
