"""All that decides what a still picture shows, and on what page: values without Qt and without VTK."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.appearance import Look, Structure, Traces
from hexmend_app.picture.camera import MOST, Camera, PicturePanel
from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.named_cameras import MOST as MOST_CAMERAS
from hexmend_app.picture.page import AxesStyle, ColourBarStyle, LineStyle, Page
from hexmend_app.picture.visibility import Colours, Show

#: The number of the format that is written; lower ones can be read.
FORMAT = 1


@dataclass(frozen=True)
class Scene(ConfigTable):
    """A scene; each key is a table of a file.

    Parameters
    ----------
    format : int
        Of the file.
    camera : Camera
        From where the mesh is looked at.
    cameras : dict of Camera
        Others, by name.
    panels : tuple of Panel
        The pictures on the page, row by row; without them, one of each mesh.
    cut : Cut
        Where the mesh is cut open.
    show : Show
        Which elements are shown.
    structure : Structure
        What is drawn of the mesh's structure.
    movement : Traces
        What is drawn of how the mesh has moved.
    colours : Colours
        What the colours show.
    lines : Lines
        How thick lines are.
    bar : Bar
        The colour bar.
    axes : Axes
        The axes in a corner.
    page : Page
        Size, paper and what is written.
    """

    format: int = option(FORMAT, low=1)
    camera: Camera = option(Camera)
    cameras: dict[str, Camera] = option(dict, most=MOST_CAMERAS)
    panels: tuple[PicturePanel, ...] = option((), most=MOST)
    cut: Cut = option(Cut)
    show: Show = option(Show)
    structure: Structure = option(Structure)
    movement: Traces = option(Traces)
    colours: Colours = option(Colours)
    lines: LineStyle = option(LineStyle)
    bar: ColourBarStyle = option(ColourBarStyle)
    axes: AxesStyle = option(AxesStyle)
    page: Page = option(Page)

    def check(self) -> None:
        """A format that can be read, and cameras that there are."""
        if self.format > FORMAT:
            raise ParameterError(f"format = {self.format} is newer than this version of Hexmend, which reads {FORMAT}")
        for number, panel in enumerate(self.panels, 1):
            if panel.camera and panel.camera not in self.cameras:
                known = ", ".join(self.cameras) or "none"
                raise ParameterError(f"panel {number}: there is no camera {panel.camera!r}: [cameras] has {known}")

    @classmethod
    def of(cls, look: Look, stand: CameraPose | None = None, **tables: Any) -> Scene:
        """The scene that shows what a look shows.

        Parameters
        ----------
        look : Look
        stand : Stand, optional
            Where the camera stands; without it, the mesh is seen from a corner.
        tables
            Others: `page`, `bar`, `axes`, `lines`, `panels`, `cameras`. The look says if there are edges and shading.
        """
        page = replace(tables.pop("page", Page()), shading=look.shading)
        lines = tables.pop("lines", LineStyle())
        if not look.edges:
            lines = replace(lines, edges=0.0)
        elif lines.edges == 0:
            lines = replace(lines, edges=None)
        if stand is not None:
            tables["camera"] = Camera.at(stand)
        return cls(
            cut=Cut.as_in(look.clip, look.left),
            show=Show.as_in(look),
            structure=look.structure,
            movement=look.traces,
            colours=Colours.as_in(look),
            lines=lines,
            page=page,
            **tables,
        )

    def look(self, mesh: Mesh) -> Look:
        """The look that shows the same of a mesh.

        Raises
        ------
        ParameterError
            Where hexes are named that the mesh has not.
        """
        self.show.check_numbers(mesh.n_hexes)
        return Look(
            clip=self.cut.of(mesh),
            left=self.cut.left(mesh),
            scale=self.colours.scale,
            edges=self.lines.edges != 0,
            shading=self.page.shading,
            neutral=self.colours.neutral,
            structure=self.structure,
            traces=self.movement,
            **self.show.fields(),
        )

    def camera_of(self, panel: PicturePanel) -> Camera:
        """The camera of one of its panels."""
        return self.cameras[panel.camera] if panel.camera else self.camera

    def panels_of(self, meshes: int) -> tuple[PicturePanel, ...]:
        """The pictures on the page of so many meshes.

        Raises
        ------
        ParameterError
            Where a panel shows a mesh that there is not, or there are more meshes than panels.
        """
        if not self.panels and meshes > MOST:
            raise ParameterError(f"there are {meshes} meshes: expected {MOST} at most")
        panels = self.panels or tuple(PicturePanel(mesh=number) for number in range(1, meshes + 1))
        for number, panel in enumerate(panels, 1):
            for mesh in (panel.mesh, panel.mesh if panel.wipe is None else panel.wipe.mesh):
                if mesh > meshes:
                    raise ParameterError(f"panel {number} shows mesh {mesh}, and there are {meshes}: name more meshes")
        return panels
