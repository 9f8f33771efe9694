"""Phrases for captions: direction of view, cut and colours of a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hexmend_app.picture import Camera, Colours, Cut, Plane
from hexmend_app.picture.camera_pose import Vector
from hexmend_app.picture.colours import colour_quantity
from hexmend_app.picture.cut import CutStyle
from hexmend_app.scene.camera.directions import direction_of

_AXES = "xyz"


def listed(names: Sequence[str]) -> str:
    """Join names with commas and "and".

    >>> listed(["initial", "laplacian", "mend"])
    'initial, laplacian and mend'
    """
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def opposite(camera: Camera) -> Camera:
    """Return the camera on the opposite side, with the same axis up.

    >>> opposite(Camera(from_="+x")).from_
    (-1.0, -0.0, -0.0)
    """
    if camera.pose is None:
        x, y, z = direction_of(camera.direction, camera.up)
        return replace(camera, from_=(-x, -y, -z))
    x, y, z = (2 * focal - place for focal, place in zip(camera.focal, camera.position, strict=True))
    return replace(camera, position=(x, y, z))


def seen_from(camera: Camera) -> str:
    """Return the direction of view.

    >>> seen_from(Camera()), seen_from(Camera(from_="-y")), seen_from(Camera(from_=(1.0, 0.5, 0.0)))
    ('seen from a corner', 'seen from -y', 'seen from direction (1, 0.5, 0)')
    """
    if camera.pose is not None:
        return "seen as in the scene"
    if camera.direction == "iso":
        return "seen from a corner"
    return f"seen from {camera.direction if isinstance(camera.direction, str) else _named(camera.direction)}"


def cut_open(cut: Cut) -> str:
    """Return the description of a cut.

    >>> cut_open(Cut((Plane(position=0.25),)))
    'cut across x at 25 % of its extent'
    >>> cut_open(Cut((Plane((0.0, 0.0, -1.0), point=(0.0, 0.0, 2.0)), Plane()), style=CutStyle.SMOOTH))
    'cut across -z through (0, 0, 2) and across x at 50 % of its extent, through the hexes'
    >>> from hexmend_app.picture import Slab, Sphere
    >>> cut_open(Cut(slab=Slab(thickness=0.2))), cut_open(Cut(sphere=Sphere((0, 0, 1), 2), notch=True))
    ('cut by a slab across x at 50 % of its extent', 'cut by a sphere, without its inside')
    """
    if cut.slab is not None:
        place = f"by a slab {_plane(cut.slab)}"
    elif cut.planes:
        place = listed([_plane(one) for one in cut.planes])
    else:
        place = f"by a {cut.kind}" if cut.depth is None else "by the depth of hexes"
    inside = ", without its inside" if cut.notch and not cut.planes else ""
    return f"cut {place}{inside}{', through the hexes' if cut.style is CutStyle.SMOOTH else ''}"


def coloured_by(colours: Colours, invalid: bool) -> str:
    """Return a sentence about the colours, with the colours of invalid hexes if `invalid` is True.

    >>> coloured_by(Colours("scaled-jacobian"), invalid=True)
    'Coloured by Scaled Jacobian; inverted hexes are magenta, those invalid inside light magenta.'
    """
    text = "Without colours" if colours.neutral else f"Coloured by {colour_quantity(colours.metric).title}"
    return f"{text}; inverted hexes are magenta, those invalid inside light magenta." if invalid else f"{text}."


def _plane(plane: Plane) -> str:
    if plane.point is not None:
        place = f"through {_vector(plane.point)}"
    else:
        place = f"at {100 * (0.5 if plane.position is None else plane.position):.3g} % of its extent"
    return f"across {_named(plane.normal)} {place}"


def _named(direction: Vector) -> str:
    """Return an axis with its sign, or the components of a direction.

    >>> _named((0.0, -2.0, 0.0)), _named((1.0, 1.0, 0.0))
    ('-y', 'direction (1, 1, 0)')
    """
    (*along,) = (k for k, part in enumerate(direction) if part)
    if len(along) == 1:
        return f"{'-' if direction[along[0]] < 0 else ''}{_AXES[along[0]]}"
    return f"direction {_vector(direction)}"


def _vector(parts: Sequence[float]) -> str:
    return f"({', '.join(f'{part:.4g}' for part in parts)})"
