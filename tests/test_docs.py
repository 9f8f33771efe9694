"""The pages of docs: what they say can be done."""

import argparse
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from hexmend import io, smooth
from hexmend.cli.main import commands, main
from hexmend.run import recipe
from hexmend_app.formats.session import session_file
from hexmend_app.picture import scene
from hexmend_app.scene.film.film_page import FilmPage
from tests.examples import blocks, run_page

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGES = sorted(path for path in DOCS.rglob("*.md") if path.parent.name != "api")


def test_every_script_of_pictures_is_run_by_make_pictures():
    scripts = {path.stem for path in (DOCS.parent / "scripts/pictures").glob("*.py")} - {"screenshots"}
    text = (DOCS.parent / "scripts/take-pictures").read_text(encoding="utf-8")
    listed = " ".join(re.findall(r"for script in (.*); do", text)).split()
    single = re.findall(r"^(?: *|\[.*\] \|\| )take (\w+)", text, re.MULTILINE)
    assert {*listed, *single} == scripts


@pytest.mark.slow
def test_the_animation_of_the_readme_says_the_truth(tmp_path, monkeypatch):
    """The figures in its first and last frames are those that the commands of its page lead to."""
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```\n(hexmend gallery five-side.*?)```", (DOCS / "methods/watch.md").read_text(), re.DOTALL)
    make, draw = block.replace("\\\n", " ").splitlines()
    assert main(shlex.split(make)[1:]) == 0
    captions = []
    compose = FilmPage.compose

    def record(self, picture, texts, viewport, initial):
        captions.append((initial.captions[0], texts[0]))
        return compose(self, picture, texts, viewport, initial)

    monkeypatch.setattr(FilmPage, "compose", record)
    assert main([*shlex.split(draw)[1:], "--frames", "2"]) == 0
    mesh = io.read("five-side.vtu")
    after = smooth(mesh)
    inside = after.before.invalid - after.before.inverted
    first = f"q min {after.before.q_min:.4f}, {after.before.inverted:,} inverted, {inside} invalid inside"
    last = f"q min {after.after.q_min:.4f}, none invalid"
    count = after.iterations
    assert captions[0] == (f"Before: {first}", f"Mend, iteration 0 of {count}: {first}")
    assert captions[-1] == (f"Before: {first}", f"Mend, iteration {count} of {count}: {last}")


@pytest.mark.slow
def test_the_animation_of_the_readme_is_as_it_is_drawn(tmp_path):
    """In processes of their own: pixels depend on what graphics a process has used before."""
    (block,) = re.findall(r"```\n(hexmend gallery five-side.*?)```", (DOCS / "methods/watch.md").read_text(), re.DOTALL)
    for line in block.replace("\\\n", " ").splitlines():
        subprocess.run([sys.executable, "-m", *shlex.split(line)], cwd=tmp_path, check=True, capture_output=True)
    with Image.open(tmp_path / "before-after.gif") as made, Image.open(DOCS / "pictures/before-after.gif") as kept:
        assert (made.n_frames, made.size) == (kept.n_frames, kept.size)
        difference = abs(np.asarray(made.convert("RGB")).astype(int) - np.asarray(kept.convert("RGB")))
        assert difference.mean() < 1, "docs/pictures/before-after.gif: run make pictures"


@pytest.mark.slow
def test_what_the_tutorial_says_can_be_done(tmp_path, monkeypatch, capsys):
    text = (DOCS / "start/tutorial.md").read_text(encoding="utf-8")
    listed = "".join(re.findall(r"^```\n(.*?)^```", text, re.DOTALL | re.MULTILINE))
    commands = [line.split()[1:] for line in re.findall(r"^hexmend .+", listed, re.MULTILINE)]
    assert {words[0] for words in commands} == {"gallery", "info", "smooth", "compare", "render", "report"}
    monkeypatch.chdir(tmp_path)
    assert [main(words) for words in commands] == [0] * len(commands)
    for words in commands:
        for file in re.findall(r"\S+\.(?:vtu|pdf|json|html)", " ".join(words)):
            assert (tmp_path / file).is_file()
    said = capsys.readouterr().out
    for figure in re.findall(r"[\d,]+(?= hexes| of them inverted| iterations)", text):
        assert figure in said
    (program,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(program, "tutorial.md", "exec"), {})
    assert io.read("mended.vtu").n_hexes == io.read("bridge.vtu").n_hexes


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", [page for page in PAGES if blocks(page) and page.name != "tutorial.md"], ids=lambda page: page.name
)
def test_the_python_of_a_page_runs_as_it_stands(page, tmp_path):
    """That of the tutorial is run by the test above, after its commands; that of the README by its own."""
    run_page(page, tmp_path)


def test_every_block_of_python_is_known_by_its_fence():
    for page in (*PAGES, DOCS.parent / "README.md"):
        text = page.read_text(encoding="utf-8")
        assert not re.search(
            r"^ *(```|~~~) *(py|pycon|python3|ipython)\b|^ *~~~ *python|^ +```python|^```python .", text, re.MULTILINE
        ), page.name
        assert text.count("```python") == len(blocks(page))


@pytest.mark.parametrize(
    "scene", re.findall(r"```toml\n(.*?)```", (DOCS / "results/figures.md").read_text("utf-8"), re.DOTALL)
)
def test_the_scenes_of_the_docs_are_scenes(scene):
    from hexmend_app.picture import Scene, from_toml

    assert from_toml(scene) != Scene()


def command_lines():
    """List the commands in blocks of the pages, each with its page."""
    for page in (*PAGES, DOCS.parent / "README.md"):
        for block in re.findall(r"^```(?:sh)?\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE):
            for line in block.replace("\\\n", " ").splitlines():
                if found := re.match(r"(?:srun \S+ |mpiexec -n \d+ )?(?:\S*/)?hexmend( .*|$)", line):
                    yield page.name, found[1].partition("  #")[0].strip()


@pytest.mark.parametrize("page", sorted({page for page, _ in command_lines()}))
def test_the_options_of_commands_exist(page):
    loaders = commands()
    for name, line in command_lines():
        name_of_command, *arguments = shlex.split(line.replace("…", "").replace("[OPTION]...", "")) or ["view"]
        if name != page or name_of_command not in loaders:
            assert (
                name != page or name_of_command.startswith("-") or "." in name_of_command or name_of_command.isupper()
            )
            continue
        parser = argparse.ArgumentParser(allow_abbrev=False, exit_on_error=False)
        loaders[name_of_command]().arguments(parser)
        known = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", parser.format_help()))
        used = {word for word in arguments if re.match(r"--?[a-z]", word)}
        assert used <= known, f"{name}: hexmend {line}"


def test_the_versions_of_files_are_those_of_the_program():
    text = (DOCS / "reference/versions.md").read_text(encoding="utf-8")
    for kind, version in (("recipe", recipe.FORMAT), ("scene", scene.FORMAT), ("session", session_file.VERSION)):
        (line,) = re.findall(rf"^\| {kind} .*", text, re.MULTILINE)
        assert [cell.strip() for cell in line.split("|")][3] == str(version)
    assert f"`version` ({session_file.VERSION})" in (DOCS / "results/session.md").read_text(encoding="utf-8")
