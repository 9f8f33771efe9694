"""Current view, which ends a script."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.features.script.source_code import comment_text, multiline_source
from hexmend_app.picture import Scene, to_toml

#: First words of the comment on the view.
VIEW = "# Current view"


@dataclass(frozen=True)
class ViewLines:
    """Scene of the current view as source.

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
        parts = [part for panel in self.scene.panels for part in (panel, panel.wipe) if part is not None]
        meshes = " ".join(["MESH"] * max((part.mesh for part in parts), default=1))
        comment = (
            f"{VIEW}: {comment_text(self.name)}. To draw it, save this text as view.toml and run\n"
            f"# hexmend render --scene view.toml {meshes} -o PICTURE.png"
        )
        return f"{comment}\nscene = {multiline_source(to_toml(self.scene, whole=False))}"
