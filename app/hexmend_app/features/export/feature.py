"""Feature that exports pictures, films of runs, reports and figure sets."""

from __future__ import annotations

from collections.abc import Generator, Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QTimer

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.export.export_settings import ExportSettings, FilmOptions, FilmSettings, ReportSettings
from hexmend_app.features.export.page_dialog import PageDialog
from hexmend_app.features.export.picture_settings import PictureSettings
from hexmend_app.picture import Page, Scene
from hexmend_app.picture.picture_metadata import PicturedMesh, with_metadata
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from PIL import Image

    from hexmend_app.report.case import Version

#: Default width of a film, in pixels.
_FILM_WIDTH = 960


class FeatureExport(Feature):
    """Writes pictures of the view, films of the run, and the report or the figure set of the mesh before and after.

    Films, reports and figure sets are drawn in the background, picture by picture.
    """

    def __init__(self, host: Host):
        super().__init__(host)
        self._scene: Scene | None = None  # of the last picture
        self._film = FilmOptions()  # of the last film
        self._record: RunRecord | None = None  # of the film that is drawn
        self._subject, self._path, self._of = "", Path(), ""
        self._steps: Generator[Any] | None = None  # one for each turn of the event loop
        self._drawn = 0
        self._timer = QTimer(self, interval=0)
        self._timer.timeout.connect(self._draw_next)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that open the dialog for a picture, a film and a report."""
        yield Action(
            id="screenshot",
            text=tr("Save &picture…"),
            menu="File",
            section=1,
            keys="Ctrl+P",
            icon="camera-outline",
            help=tr("Save a picture of the view in any size."),
            tool=tr("Picture"),
            handle=lambda: self.ask("picture"),
            enabled=lambda: self.canvas is not None,
            in_view=True,
        )
        yield Action(
            id="report",
            text=tr("Export &report or figure set…"),
            menu="File",
            section=1,
            icon="file-document-outline",
            help=tr(
                "Save pictures, charts and tables of the mesh before and after: one page, HTML or PDF, or a folder "
                "of figures."
            ),
            handle=lambda: self.ask("report"),
            enabled=lambda: self.canvas is not None and not self.session.run.busy and not self.going_on,
        )
        yield Action(
            id="film",
            text=tr("Save fil&m…"),
            menu="Timeline",
            section=2,
            icon="movie-open-outline",
            help=tr("Save the iterations of the run as an animation, as shown in the view."),
            handle=lambda: self.ask("film"),
            enabled=lambda: self.canvas is not None and self.session.timeline.record is not None,
        )

    def close(self) -> None:
        """Cancel the export."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """True while pictures are being drawn."""
        return self._steps is not None

    def cancel(self) -> None:
        """Cancel the export; files already written are kept."""
        if self._steps is not None:
            self._timer.stop()
            self._steps.close()
            self._steps = None
            self.host.busy.done("export")

    def refresh(self) -> None:
        """Cancel the film if its run was deleted."""
        if self.going_on and self._record is not None and self._record not in self.session.history.records:
            self.cancel()
            self.host.messages.show_error(
                tr("Film not saved"), tr("The run was deleted before the last frame was drawn.")
            )

    def ask(self, chosen: str) -> None:
        """Ask for the settings and the path of an export, and write it."""
        dialog = self.dialog(chosen)
        if dialog.exec():
            self.write(dialog.settings, dialog.target.path())
        dialog.deleteLater()

    def dialog(self, chosen: str) -> PageDialog:
        """Return the dialog for an export with an id: picture, film, report or figures."""
        exports: list[ExportSettings] = [self._picture_settings()]
        if self.session.timeline.record is not None:
            exports.append(self._film_settings())
        if not self.session.run.busy:
            exports += self._report_settings()
        return PageDialog(exports, chosen, self.host.dialog_parent)

    def write(self, settings: ExportSettings, path: Path) -> None:
        """Write an export with the settings of the dialog."""
        if isinstance(settings, PictureSettings):
            self._scene = settings.scene()
            self.session.saved_cameras.add_all(self._scene.cameras)
            self.write_picture(path, self._scene)
        elif isinstance(settings, FilmSettings):
            self._film = settings.options()
            self.write_film(path, settings.scene(), self._film)
        elif settings.id == "report":
            self.write_report(path)
        else:
            self.write_figures(path)

    def _picture_settings(self) -> PictureSettings:
        """Return the settings of a picture, with the page, lines, colour bar and axes used last."""
        canvas, last = self.canvas, self._scene
        size = canvas.size() * self.host.dialog_parent.devicePixelRatioF()
        page = Page(pixels=(size.width(), size.height())) if last is None else last.page
        scene = canvas.scene(page, self.session.saved_cameras.all)
        if last is not None:
            lines = scene.lines if 0 in (scene.lines.edges, last.lines.edges) else last.lines
            scene = replace(scene, lines=lines, bar=last.bar, axes=last.axes)
        names = canvas.names if len(scene.panels) > 1 else ()
        return PictureSettings(
            scene, lambda scene: canvas.draw_page(scene).image(), f"{self.host.default_file_stem}.png", names
        )

    def _film_settings(self) -> FilmSettings:
        height = round(_FILM_WIDTH * self.canvas.height() / self.canvas.width() / 2) * 2
        scene, record = self.canvas.scene(Page(pixels=(_FILM_WIDTH, height))), self.session.timeline.record
        return FilmSettings(scene, self._film, self._pictures, record.newest, f"{self.host.default_file_stem}.gif")

    def _report_settings(self) -> list[ReportSettings]:
        def versions() -> list[Version]:
            from hexmend_app.features.export.report_files import versions_of

            return versions_of(self.session)

        kinds, stem, scene = tr("Web page (*.html);;PDF (*.pdf)"), self.host.default_file_stem, self._view_scene()
        report = tr("One page on the mesh before and after: pictures, quality, runs and advice.")
        figures = tr("A folder with pictures, distributions, convergence and a table, with captions and commands.")
        return [
            ReportSettings("report", tr("Report"), f"{stem}-report.html", kinds, report, scene, versions),
            ReportSettings("figures", tr("Figure set"), f"{stem}-figures", "", figures, scene, versions),
        ]

    def _view_scene(self) -> Scene:
        page = Page(pixels=(self.canvas.width(), self.canvas.height()))
        return self.canvas.scene(page, self.session.saved_cameras.all)

    # Pictures

    def write_picture(self, path: Path, scene: Scene) -> bool:
        """Write a picture of a scene; return True if it was written."""
        width, height = scene.page.size
        subject = tr("Picture of {width} × {height} pixels", width=width, height=height)
        return self.write_file(
            subject, path, lambda at: self.canvas.draw_page(scene).write(at, self._metadata(at, scene))
        )

    def _metadata(self, path: Path, scene: Scene) -> dict[str, str]:
        """Return the metadata of a picture: the scene, its meshes, and the recipe of the first mesh."""
        from hexmend_app.features.export.report_files import run_recipe

        document = self.session.document
        opened = document.start.mesh
        shown = [document.now, *(one.state for one in self.session.side_views.all)]
        meshes = [PicturedMesh.of(opened, state.mesh, document.path, path) for state in shown]
        return with_metadata(scene, meshes, run_recipe(self.session))

    # Films, reports and figure sets

    def write_film(self, path: Path, scene: Scene, options: FilmOptions) -> None:
        """Make a film of the current run; the file is written after the last frame is drawn."""
        from hexmend_app.scene.film.film_files import write_film

        def steps() -> Generator[Image.Image]:
            frames = []
            for picture in self._pictures(scene, options):
                frames.append(picture)
                yield picture
            write_film(path, frames, options.rate)

        self._start(tr("Film"), steps(), path, len(self._iterations(options)))
        self._record = self.session.timeline.record

    def _iterations(self, options: FilmOptions) -> list[int]:
        from hexmend_app.scene.film.film_frames import chosen_iterations

        return chosen_iterations(self.session.history, self.session.timeline.record, options.frames)

    def _pictures(self, scene: Scene, options: FilmOptions) -> Generator[Image.Image]:
        """Generate the frames of the current run."""
        from hexmend_app.scene.film.film_frames import pictures

        record, history, mesh = self.session.timeline.record, self.session.history, self.session.document.now.mesh
        movement, aspect = self.canvas.viewport.frame.movement, self.canvas.width() / self.canvas.height()
        return pictures(
            record,
            self._iterations(options),
            lambda number: history.state(RecordedIteration(record, number), mesh),
            scene,
            movement=movement,
            histogram=options.histogram,
            before=options.before,
            aspect=aspect,
        )

    def write_report(self, path: Path) -> None:
        """Write the report to a file, HTML or PDF by its suffix."""
        from hexmend_app.features.export.report_files import report

        self._start(tr("Report"), report(self.session, self._view_scene(), path, self.host.default_file_stem), path)

    def write_figures(self, folder: Path) -> None:
        """Write the figure set into a folder, which is created if missing."""
        from hexmend_app.features.export.report_files import figure_set

        self._start(
            tr("Figure set"), figure_set(self.session, self._view_scene(), folder, self.host.default_file_stem), folder
        )

    def _start(self, subject: str, steps: Generator[Any], path: Path, count: int | None = None) -> None:
        """Draw picture by picture in the background, in place of another export; the last step writes the file."""
        self.cancel()
        self._steps, self._drawn, self._record = steps, 0, None
        self._subject, self._path, self._of = subject, path, "" if count is None else tr(" of {count}", count=count)
        self._timer.start()
        self._show_progress()

    def _show_progress(self) -> None:
        number = self._drawn + 1
        text = tr("{name}: drawing picture {number}{of}…", name=self._path.name, number=number, of=self._of)
        help = tr("Cancel the export; files already written are kept.")
        self.host.busy.show_work("export", text, tr("Cancel"), help, self.cancel)

    def _draw_next(self) -> None:
        try:
            picture = next(self._steps, None)
        except Exception as error:  # any error is reported
            self.cancel()
            self.host.messages.show_error(tr("{subject} not saved", subject=self._subject), str(error))
            return
        if picture is None:
            self.cancel()
            text = tr("{subject} saved to {path}", subject=self._subject, path=self._path)
            self.host.messages.show_written(text, self._path)
        else:
            self._drawn += 1
            self._show_progress()
