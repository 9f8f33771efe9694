"""The pages of docs as a site: it is built without a warning, whole, and needs no network; what is wrong is told."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.browsers import chromium

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[1]


def build(folder, config="mkdocs.yml"):
    """The process that has built a site into a folder."""
    words = [sys.executable, "-m", "mkdocs", "build", "--config-file", config, "--site-dir", folder]
    environment = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
    return subprocess.run(words, cwd=ROOT, env=environment, capture_output=True, text=True)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    done = build(folder)
    assert done.returncode == 0, done.stderr
    return folder


def test_every_formula_is_mathml(site):
    for path in site.rglob("*.html"):
        written = (ROOT / "docs" / path.relative_to(site)).with_suffix(".md")
        text = path.read_text(encoding="utf-8")
        assert "arithmatex" not in text
        if written.exists():
            prose = re.sub(r"```.*?```|`[^`\n]*`", "", written.read_text(encoding="utf-8"), flags=re.DOTALL)
            assert text.count("<math") == len(re.findall(r"\$\$.+?\$\$|\$[^$]+\$", prose, re.DOTALL))
    assert (site / "fonts/math.ttf").stat().st_size > 100_000


@pytest.fixture(scope="module")
def opened(site, tmp_path_factory):
    """A page of the site in Debian's browser, read from the disk, and what the browser asked for."""
    with chromium(tmp_path_factory.mktemp("browser")) as launch, launch() as browser:
        page, asked = browser.new_page(viewport={"width": 1366, "height": 768}), []
        page.on("request", lambda request: asked.append(request.url))
        page.goto((site / "reference/formats.html").as_uri())
        yield page, asked


def test_search_finds_pages_that_are_read_from_the_disk(opened, site):
    page, asked = opened
    page.get_by_placeholder("Search").click()
    page.keyboard.type("crinkle")
    found = page.locator(".md-search-result__item a").first
    found.wait_for()
    assert found.get_attribute("href").startswith(site.as_uri())
    assert all(url.startswith((site.as_uri(), "about:")) for url in asked)


@pytest.mark.parametrize(("words", "file"), [
    ("abaqus", "abaqus.html"),
    ("material", "interfaces.html"),
    ("boundary layers", "targets.html"),
    ("symmetry", "interfaces.html"),
    ("stopping criteria", "api/run.html"),
])  # fmt: skip
def test_search_finds_the_page_of_a_task(opened, words, file):
    page, _ = opened
    page.reload()
    page.get_by_placeholder("Search").click()
    page.keyboard.type(words)
    page.locator(".md-search-result__item a").first.wait_for()
    links = page.locator(".md-search-result__item a").evaluate_all("all => all.map((one) => one.href)")
    found = [link.split("#")[0].split("?")[0] for link in links]
    pages = list(dict.fromkeys(found))
    assert any(link.endswith(f"/{file}") for link in pages[: 3 if "/" not in file else 8]), pages


@pytest.fixture
def other(tmp_path):
    """A way to build a site of other pages in the same manner; gives the process. Nothing but index.md is led to."""
    config = tmp_path / "mkdocs.yml"
    config.write_text(
        f"INHERIT: {ROOT}/mkdocs.yml\ndocs_dir: docs\nhooks: [{ROOT}/scripts/site_hooks.py]\nextra_css: []\n"
        "plugins: [search, offline]\n"
        "nav: [{Start: [index.md]}]\n"
    )
    (tmp_path / "docs").mkdir()

    def made(**pages):
        for name, text in pages.items():
            (tmp_path / "docs" / f"{name}.md").write_text(f"# Page\n\n{text}\n")
        return build(tmp_path / "site", str(config))

    return made


def test_pages_without_fault_are_built(other):
    assert other(index="See [this](#page): $x^2$.").returncode == 0


@pytest.mark.parametrize(("pages", "complaint"), [
    ({"index": "See [that](nowhere.md)."}, "nowhere.md"),
    ({"index": "$\\left( x$"}, "cannot be read"),
    ({"index": "![far](https://example.org/far.png)"}, "fetches from elsewhere"),
])  # fmt: skip
def test_what_is_wrong_is_told(other, pages, complaint):
    done = other(**pages)
    assert done.returncode != 0
    assert complaint in done.stderr
