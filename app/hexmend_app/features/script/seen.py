"""What is seen now, as the end of a script."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.features.script.words import comment_of, lines_of
from hexmend_app.state.scene import Scene, to_toml

#: How it begins.
SEEN = "# What is seen now"


@dataclass(frozen=True)
class Seen:
    """What the views show.

    Parameters
    ----------
    scene : Scene
    name : str
        What the mesh of the first view is.
    """

    scene: Scene
    name: str

    @property
    def source(self) -> str:
        """A comment that says how to draw it, and the scene, which costs nothing."""
        shown = [one for panel in self.scene.panels for one in (panel, panel.wipe) if one is not None]
        meshes = " ".join(["MESH"] * max((one.mesh for one in shown), default=1))
        comment = (
            f"{SEEN}: {comment_of(self.name)}. Saved as view.toml, this text is drawn by\n"
            f"# hexmend render --scene view.toml {meshes} -o PICTURE.png"
        )
        return f"{comment}\nscene = {lines_of(to_toml(self.scene, whole=False))}"
