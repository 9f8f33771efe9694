"""Scenes: complete descriptions of still pictures and their pages, as values without Qt and VTK."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.conversion import option
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.camera import MAX_CAMERAS, MAX_PANELS, Camera, CameraPose, PicturePanel
from hexmend_app.picture.page import AxesStyle, ColourBarStyle

#: Number of the current format; lower numbers can be read.
FORMAT = 1

#: Tables that a scene shares with a look.
_OF_LOOK = tuple(field.name for field in fields(Look))

#: Maximum number of hexes that a scene hides, marks or isolates individually, and maximum length of the text that lists
#: the hexes which a cut leaves; the cut of a look with a longer text is evaluated when the picture is drawn.
_MAX_HEXES, _MAX_TEXT = 300_000, 2_000_000


@dataclass(frozen=True)
class Scene(Look):
    """Description of a picture: a look, cameras, panels and their labels; each field is a table of a scene file.

    Parameters
    ----------
    format : int
        Number of the file format.
    camera : Camera
        Camera of the picture.
    cameras : dict of Camera
        Named cameras.
    panels : tuple of PicturePanel
        Panels of the page, row by row; by default one panel for each mesh.
    bar : ColourBarStyle
        Colour bar.
    axes : AxesStyle
        Orientation axes in a corner.
    """

    format: int = option(FORMAT)
    camera: Camera = option(Camera)
    cameras: dict[str, Camera] = option(dict, most=MAX_CAMERAS)
    panels: tuple[PicturePanel, ...] = option((), most=MAX_PANELS)
    bar: ColourBarStyle = option(ColourBarStyle)
    axes: AxesStyle = option(AxesStyle)

    def check(self) -> None:
        """Raise `ParameterError` for another format, too many hexes, and panels with unknown cameras."""
        if self.format != FORMAT:
            problem = f"is not read: expected {FORMAT}; use the Hexmend that wrote it"
            raise ParameterError(f"format = {self.format} {problem}")
        isolated = () if self.show.isolate is None else self.show.isolate.hexes
        for name, hexes in (("hidden", self.show.hidden), ("marked", self.show.marked), ("isolate", isolated)):
            if len(hexes) > _MAX_HEXES:
                raise ParameterError(f"[show] {name} lists {len(hexes):,} hexes: expected {_MAX_HEXES:,} at most")
        for number, panel in enumerate(self.panels, 1):
            if panel.camera and panel.camera not in self.cameras:
                known = ", ".join(self.cameras) or "none"
                raise ParameterError(f"panel {number}: there is no camera {panel.camera!r}: [cameras] has {known}")

    @classmethod
    def of(cls, look: Look, pose: CameraPose | None = None, **tables: Any) -> Scene:
        """Return the scene with a look.

        Parameters
        ----------
        look : Look
        pose : CameraPose, optional
            Pose of the camera; by default the isometric view.
        tables
            Other tables: `bar`, `axes`, `panels`, `cameras`, and tables that replace those of the look.
        """
        tables = {**{name: getattr(look, name) for name in _OF_LOOK}, **tables}
        if pose is not None:
            tables["camera"] = Camera.at(pose)
        if len(tables["cut"].hexes) > _MAX_TEXT:
            tables["cut"] = tables["cut"].with_hexes(None)
        return cls(**tables)

    def look(self, mesh: Mesh) -> Look:
        """Return the look of the scene for a mesh.

        Raises
        ------
        ParameterError
            If the scene refers to a hex that does not exist in the mesh.
        """
        return Look(**{name: getattr(self, name) for name in _OF_LOOK}).on(mesh)

    def camera_of(self, panel: PicturePanel) -> Camera:
        """Return the camera of a panel."""
        return self.cameras[panel.camera] if panel.camera else self.camera

    def panels_of(self, meshes: int) -> tuple[PicturePanel, ...]:
        """Return the panels of the page for a number of meshes.

        Raises
        ------
        ParameterError
            If a panel refers to a mesh that does not exist, or there are too many meshes.
        """
        if not self.panels and meshes > MAX_PANELS:
            raise ParameterError(f"there are {meshes} meshes: expected at most {MAX_PANELS}")
        panels = self.panels or tuple(PicturePanel(mesh=number) for number in range(1, meshes + 1))
        for number, panel in enumerate(panels, 1):
            for mesh in (panel.mesh, panel.mesh if panel.wipe is None else panel.wipe.mesh):
                if mesh > meshes:
                    raise ParameterError(f"panel {number} shows mesh {mesh}, but there are {meshes}: name more meshes")
        return panels
