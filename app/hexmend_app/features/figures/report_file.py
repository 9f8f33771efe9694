"""Reports on the meshes of the window."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.io.storage.atomic import check_writable
from hexmend.io.storage.suffixes import suffix_for
from hexmend_app.features.figures.drawing import NamedVersion, version_of
from hexmend_app.picture import Scene
from hexmend_app.report.case import Case, Source
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.report.figure_set import Figure, Style
from hexmend_app.report.page import draw_chapter, page, write_page
from hexmend_app.report.pdf import check_pdf, write_pdf

#: Suffixes of reports.
_SUFFIXES = (".html", ".pdf")

#: Pixels per inch of the pictures.
_DPI = 220.0


def prepare_report(path: Path) -> None:
    """Check that a report can be written.

    Raises
    ------
    HexmendError
        If a library is missing, or the file cannot be written.
    """
    if suffix_for(path, "a report", _SUFFIXES) == ".pdf":
        check_pdf()
    check_writable(path)
    check_matplotlib()


def draw_report(
    path: str | Path, title: str, mesh: str, scene: Scene, versions: Sequence[NamedVersion], file: str = ""
) -> Generator[Figure]:
    """Yield figure by figure, then write the report, HTML or PDF by the suffix.

    Parameters
    ----------
    path : path-like
    title : str
    mesh : str
        Name of the mesh.
    scene : Scene
        Camera, cut and colours of the pictures.
    versions : sequence of NamedVersion
        Meshes to compare, the mesh as opened first.
    file : str
        File of the mesh; "" for none.
    """
    path = Path(path)
    interactive = suffix_for(path, "a report", _SUFFIXES) == ".html"
    source = Source.of(file) if file else None
    case = Case(mesh, source, tuple(map(version_of, versions)), stop=None)
    style = Style(replace(scene, page=replace(scene.page, dpi=_DPI)))
    chapter = yield from draw_chapter(case, style, [], interactive=interactive)
    (write_page if interactive else write_pdf)(path, page(title, [chapter], "", interactive=interactive))
