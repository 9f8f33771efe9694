"""The figure set, drawn figure by figure while the window goes on."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.scene import Page
from hexmend_app.widgets.pieces import Pieces
from hexmend_app.widgets.questions import ask_figures

if TYPE_CHECKING:
    from hexmend_app.report.figure_set import Figure

#: Kinds of file that every figure is written as.
_FORMATS = ("png", "pdf", "svg")


class FeatureFigures(Feature):
    """Writes pictures before and after as they are looked at, plots and the table into a folder."""

    order = 13

    def __init__(self, host: Host):
        super().__init__(host)
        self._folder = Path()
        self._again: list[str] = []
        self._drawing = Pieces(host.busy, "figures", "Give the rest up; what is written stays.", self)
        self._drawing.finished.connect(self._on_drawn)
        self._drawing.failed.connect(self._on_failed)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Sequence[Action]:
        """Export the figure set."""
        return (
            Action(
                id="figure_set",
                text="E&xport the figure set…",
                menu="File",
                part=1,
                icon="image-multiple-outline",
                help="Save before and after, distributions, convergence and the table, with captions and commands.",
                handle=self.ask,
                enabled=lambda: self.canvas is not None and not self.session.smoothing.busy and not self.going_on,
            ),
        )

    def close(self) -> None:
        """Give up what is being written."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """Whether figures are being drawn."""
        return self._drawing.going_on

    def ask(self) -> None:
        """Ask where the folder goes, and write into it."""
        folder = ask_figures(self.host.window, self.host.stem)
        if folder:
            self.write(Path(folder))

    def write(self, folder: Path) -> None:
        """Write the figure set into a folder, which is made; its captions come last."""
        self.cancel()
        try:
            self._begin(folder)
        except HexmendError as error:
            self.host.messages.show_error("The figures were not made", str(error))

    def cancel(self) -> None:
        """Give up what is being drawn; figures that are written stay."""
        self._drawing.cancel()

    def _begin(self, folder: Path) -> None:
        from hexmend.io.recipes import write_recipe
        from hexmend.report import made_folder
        from hexmend.report.charts import check_matplotlib
        from hexmend_app.features.figures.session_case import case_of, recipes_of
        from hexmend_app.report.figure_set import Style, stationary, write_figures
        from hexmend_app.state.scene import write_scene

        check_matplotlib()
        made_folder(folder)
        page = Page(pixels=(self.canvas.width(), self.canvas.height()))
        scene = stationary(self.canvas.scene(page, self.session.cameras.all))
        write_scene(folder / "scene.toml", scene)
        recipes = recipes_of(self.session)
        for name, recipe in recipes.items():
            write_recipe(folder / name, recipe)
        path = self.session.document.path
        methods = ",".join(str(folder / name) for name in recipes) or "none"
        self._again = ["figures", str(path) if path is not None else "MESH", "--methods", methods]
        self._again += ["--scene", str(folder / "scene.toml"), "--format", ",".join(_FORMATS), "-o", str(folder)]
        case = case_of(self.session)
        self._folder = folder
        self._drawing.begin(write_figures(case, folder, Style(scene, formats=_FORMATS)), _said)

    def _on_failed(self, error: Exception) -> None:
        self.host.messages.show_error("The figures were not made", f"One of them could not be drawn: {error}")

    def _on_drawn(self, drawn: list[Figure]) -> None:
        self.host.said(
            "The captions were not written",
            lambda: self._write_captions(drawn),
            f"Figure set saved to {self._folder}",
        )

    def _write_captions(self, drawn: list[Figure]) -> None:
        from hexmend_app.report.captions import write_captions
        from hexmend_app.report.case import command_line

        figures = [(one, command_line([*self._again, "--only", one.part])) for one in drawn]
        write_captions(self._folder, self.host.stem, figures)


def _said(drawn: int) -> str:
    """What is being done once so many figures are drawn."""
    from hexmend_app.report.figure_set import PARTS

    at = min(drawn, len(PARTS) - 1)
    return f"Drawing figure {at + 1} of {len(PARTS)}: {list(PARTS)[at]}…"
