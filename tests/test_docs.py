"""The pages of docs: their pictures are there, and none stands there that no page shows."""

import importlib.util
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGES = sorted(DOCS.glob("*.md"))
PICTURES = re.compile(r"!\[[^]]+\]\(([^)\s]+)\)")

spec = importlib.util.spec_from_file_location("draw_method_figures", DOCS.parent / "scripts/draw_method_figures.py")
draw_method_figures = importlib.util.module_from_spec(spec)
spec.loader.exec_module(draw_method_figures)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_pictures_of_a_page_are_there(page):
    for file in PICTURES.findall(page.read_text(encoding="utf-8")):
        assert (DOCS / file).is_file(), f"{page.name} shows {file}, which is not there"


def test_no_picture_is_left_over():
    shown = {file for page in PAGES for file in PICTURES.findall(page.read_text(encoding="utf-8"))}
    assert {path.name for path in DOCS.iterdir() if path.suffix in (".png", ".svg")} <= shown


def test_the_figures_of_the_mathematics_are_drawn_as_they_stand_there(tmp_path, capsys):
    """Their files and what is written in them, not how a version of matplotlib draws it."""
    draw_method_figures.main(tmp_path)
    assert capsys.readouterr().out.count("kB") == len(draw_method_figures.FIGURES)
    for file in draw_method_figures.FIGURES:
        assert f"]({file})" in (DOCS / "method.md").read_text(encoding="utf-8")
        for folder in (tmp_path, DOCS):
            assert (folder / file).stat().st_size < 100_000
        texts = [re.findall(r"<!-- (.+?) -->", (at / file).read_text(encoding="utf-8")) for at in (tmp_path, DOCS)]
        assert texts[0] == texts[1], f"{file}: run make docs"


@pytest.mark.parametrize("scene", re.findall(r"```toml\n(.*?)```", (DOCS / "figures.md").read_text("utf-8"), re.DOTALL))
def test_the_scenes_of_the_docs_are_scenes(scene):
    from hexmend_app.state.scene import Scene, from_toml

    assert from_toml(scene) != Scene()
