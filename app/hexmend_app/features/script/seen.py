"""Current view, as the end of a script."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.features.script.source_code import comment_of, lines_of
from hexmend_app.picture import Scene, to_toml

#: First words of its comment.
SEEN = "# Current view"


@dataclass(frozen=True)
class ViewLines:
    """Scene of the views.

    Parameters
    ----------
    scene : Scene
    name : str
        Name of the mesh in the first view.
    """

    scene: Scene
    name: str

    @property
    def source(self) -> str:
        """The scene as source, with a comment on how to draw it."""
        shown = [one for panel in self.scene.panels for one in (panel, panel.wipe) if one is not None]
        meshes = " ".join(["MESH"] * max((one.mesh for one in shown), default=1))
        comment = (
            f"{SEEN}: {comment_of(self.name)}. To draw it, save this text as view.toml and run\n"
            f"# hexmend render --scene view.toml {meshes} -o PICTURE.png"
        )
        return f"{comment}\nscene = {lines_of(to_toml(self.scene, whole=False))}"
