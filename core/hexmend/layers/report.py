"""Report on layers: heights, growth and angles at each wall before and after a run.

Change of the lengths of hexes by a run that does not aim at them.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.layers.targets import MAX_DISTORTED
from hexmend.layers.walls import Layers, Wall, nodes_of_faces
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend.target.sheets import DISTORTED, given_lengths, recovered_lengths
from hexmend.terminal_text import capitalised, count_phrase

#: Factor by which heights of the first layer may change in the mean before the layers count as lost.
LOST_FACTOR = 1.25


@dataclass(frozen=True)
class LayerState:
    """Figures of the layers on a wall.

    Parameters
    ----------
    first_height_min, first_height_mean : float
        Of the hexes at the wall, in the mesh's unit of length.
    growth : float
        Median over the columns of the mean ratio of successive heights.
    angle_mean, angle_max : float
        Angle between the edges that leave the wall and its normal, in degrees.
    """

    first_height_min: float
    first_height_mean: float
    growth: float
    angle_mean: float
    angle_max: float


@dataclass(frozen=True)
class LayerReport:
    """Layers on a wall before and after a run.

    Parameters
    ----------
    wall : str
    faces, layers : int
        Number of the wall's faces and of the layers on most of them.
    before, after : LayerState
        Where the mesh as given is noisy or tangled, the heights before, and those of hexes that did not move, are
        those recovered along its dual sheets.
    change : float
        Mean factor by which first heights differ from those before: 1 where all are kept.
    aimed_at : bool
        True if the run had a target that keeps the layers.
    """

    wall: str
    faces: int
    layers: int
    before: LayerState
    after: LayerState
    change: float
    aimed_at: bool = False

    @property
    def lost(self) -> bool:
        """True if the first layer is no longer as high as it was."""
        return self.change > LOST_FACTOR

    @property
    def loss(self) -> str:
        """The loss of the layers as a sentence; "" where they are kept."""
        if not self.lost:
            return ""
        heights = f"{self.before.first_height_mean:.3g} → {self.after.first_height_mean:.3g}"
        hint = "" if self.aimed_at else "; --target given-shape keeps them"
        return f"the layers at '{self.wall}' lose their grading: first height {heights}{hint}"

    @property
    def sentence(self) -> str:
        """The layers before and after, in a line."""
        was, now = self.before, self.after
        return (
            f"Layers at '{self.wall}' ({count_phrase(self.layers, 'layer')} on {count_phrase(self.faces, 'face')}): "
            f"first height {was.first_height_mean:.4g} → {now.first_height_mean:.4g} (least "
            f"{now.first_height_min:.4g}), growth {was.growth:.3f} → {now.growth:.3f}, {now.angle_mean:.1f}° from the "
            f"wall's normal (at most {now.angle_max:.1f}°)."
        )

    def to_dict(self) -> dict[str, Any]:
        """Convert it to values that JSON can hold."""
        return dataclasses.asdict(self) | {"lost": self.lost}


def layer_report(
    layers: Layers, before: Mesh, after: Mesh, lengths: np.ndarray, aimed_at: bool = False
) -> tuple[LayerReport, ...]:
    """Compare the layers of a mesh before and after a run.

    Parameters
    ----------
    layers : Layers
    before, after : Mesh
        Meshes of the same hexes.
    lengths : (m, 3) float64
        Lengths of the hexes before, of `hexmend.target.recovered_lengths`.
    aimed_at : bool
        See `LayerReport`.

    Returns
    -------
    tuple of LayerReport
        One for each wall.
    """
    unmoved = (after.points == before.points).all(axis=1)[after.elements].all(axis=1)
    new = np.where(unmoved[:, None], lengths, given_lengths(after))  # a hex that stays as it is loses nothing
    reports = []
    for wall in layers.walls:
        was, now = _state(wall, before, lengths), _state(wall, after, new)
        change = np.exp(np.abs(np.log(wall.of(new)[:, 0] / wall.of(lengths)[:, 0])).mean())
        reports.append(LayerReport(wall.name, wall.count, wall.depth, was, now, float(change), aimed_at))
    return tuple(reports)


def describe_losses(reports: Iterable[LayerReport]) -> str:
    """Tell which layers have lost their grading, in a sentence for each wall; "" if all have kept it."""
    return " ".join(capitalised(report.loss) for report in reports if report.lost)


def describe_layers(layers: Layers, mesh: Mesh, quality: ElementQuality | None = None) -> list[dict[str, Any]]:
    """Return the figures of the layers of a mesh, one dict for each wall.

    Parameters
    ----------
    layers : Layers
    mesh : Mesh
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.
    """
    lengths = recovered_lengths(mesh, quality) if layers else np.zeros((0, 3))
    return [
        {
            "wall": wall.name,
            "faces": wall.count,
            "layers": wall.depth,
            **dataclasses.asdict(_state(wall, mesh, lengths)),
        }
        for wall in layers.walls
    ]


def _state(wall: Wall, mesh: Mesh, lengths: np.ndarray) -> LayerState:
    """Figures of a wall's layers, with heights from the lengths (m, 3) of hexes."""
    heights = wall.of(lengths)
    count = (wall.hexes >= 0).sum(axis=1)
    last = heights[np.arange(len(heights)), count - 1]
    growth = (last / heights[:, 0]) ** (1 / np.maximum(count - 1, 1))
    angles = _angles(wall, mesh)
    first = heights[:, 0]
    return LayerState(*map(float, (first.min(), first.mean(), np.median(growth), angles.mean(), angles.max())))


def _angles(wall: Wall, mesh: Mesh) -> np.ndarray:
    """Angle between the wall's normal and the mean of the edges that leave each face, in degrees, (w,)."""
    faces = wall.faces[:, 0]
    near, far = (mesh.points[nodes_of_faces(mesh.elements, wall.hexes[:, 0], each)] for each in (faces, faces ^ 1))
    normal = -np.cross(near[:, 2] - near[:, 0], near[:, 3] - near[:, 1])
    means = near.mean(axis=1), far.mean(axis=1)
    twice = (near[:, 2] == near[:, 3]).all(axis=1)[:, None] / 3  # the last corner of a triangle
    along = means[1] - means[0] + twice * (means[1] - far[:, 3] - means[0] + near[:, 3])
    sizes = np.linalg.norm(normal, axis=1) * np.linalg.norm(along, axis=1)
    cosines = np.einsum("ij,ij->i", normal, along) / np.maximum(sizes, np.finfo(float).tiny)
    return np.degrees(np.arccos(np.clip(cosines, -1, 1)))


#: Factor beyond which a length has changed much, and the share of hexes with such a length that is worth a sentence.
_MUCH, _SHARE = 2.0, 0.05
#: Approximate number of hexes that are compared.
_SAMPLE = 50_000


def grading_message(before: Mesh, after: Mesh, quality: ElementQuality) -> str:
    """Tell by which factor lengths of hexes have changed, where many have changed much; "" otherwise.

    Parameters
    ----------
    before, after : Mesh
        Meshes of the same hexes.
    quality : ElementQuality
        Of the mesh before.
    """
    if np.mean(quality.scaled_jacobian < DISTORTED) > MAX_DISTORTED:
        return ""
    sample = np.arange(0, before.n_elements, before.n_elements // _SAMPLE + 1)
    factors = np.exp(np.abs(np.log(given_lengths(after, sample) / given_lengths(before, sample)))).max(axis=1)
    if np.mean(factors > _MUCH) < _SHARE:
        return ""
    return f"Edge lengths change by up to a factor of {factors.max():.1f}; --target given-shape keeps them."
