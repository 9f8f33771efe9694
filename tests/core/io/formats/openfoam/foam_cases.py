"""Cases of OpenFOAM for tests, written by hand: as text and binary, with cells of all kinds."""

import gzip
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

#: A cube of eight points; node i + 2 j + 4 k is at (i, j, k).
CUBE = [(float(x), float(y), float(z)) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
#: Its faces with normals out of it: x-, x+, y-, y+, z-, z+.
CUBE_FACES = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


def header(kind: str, name: str, encoding: str = "ascii", arch: str = "LSB;label=32;scalar=64") -> bytes:
    """Header of a file."""
    return (
        "/*--------*- C++ -*--------*\\\n| a banner with ( and { |\n\\*--------*/\n"
        f'FoamFile\n{{\n    version 2.0; // as ever\n    format {encoding};\n    arch "{arch}";\n'
        f'    class {kind};\n    location "constant/polyMesh";\n    object {name};\n}}\n// * * * //\n\n'
    ).encode()


def ascii_list(rows: Sequence[object]) -> bytes:
    """List of numbers or of rows of numbers in parentheses."""
    text = "\n".join(str(row) if np.ndim(row) == 0 else f"({' '.join(map(repr, row))})" for row in rows)
    return f"{len(rows)}\n(\n{text}\n)\n\n// * * * //\n".encode()


def ascii_faces(faces: Sequence[Sequence[int]]) -> bytes:
    """List of faces."""
    text = "\n".join(f"{len(face)}({' '.join(map(str, face))})" for face in faces)
    return f"{len(faces)}\n(\n{text}\n)\n".encode()


def binary_list(values: object, dtype: str, count: int | None = None) -> bytes:
    """List of numbers or vectors as bytes."""
    array = np.asarray(values, dtype)
    return f"{len(array) if count is None else count}\n(".encode() + array.tobytes() + b")\n"


def boundary(patches: Mapping[str, tuple[str, int, int]], more: str = "") -> bytes:
    """The list of patches: name, type, first face and number of faces."""
    text = "".join(
        f"    {name}\n    {{\n        type {kind};\n        inGroups List<word> 1(all);\n{more}"
        f"        nFaces {count}; /* so many */\n        startFace {first};\n    }}\n"
        for name, (kind, first, count) in patches.items()
    )
    return header("polyBoundaryMesh", "boundary") + f"{len(patches)}\n(\n{text})\n".encode()


def write_case(
    folder: Path,
    points: Sequence[Sequence[float]],
    faces: Sequence[Sequence[int]],
    owner: Sequence[int],
    neighbour: Sequence[int],
    patches: Mapping[str, tuple[str, int, int]],
    binary: tuple[int, int] | None = None,
    compressed: bool = False,
    order: str = "LSB",
) -> Path:
    """Write a case.

    Parameters
    ----------
    folder : Path
    points, faces, owner, neighbour, patches
        As in the files.
    binary : (int, int), optional
        Bits of labels and scalars; as text if None.
    compressed : bool
        Compress all files but boundary.
    order : str
        "LSB" or "MSB".

    Returns
    -------
    Path
        The polyMesh folder.
    """
    mesh = folder / "constant" / "polyMesh"
    mesh.mkdir(parents=True)
    content = {}
    if binary is None:
        content["points"] = header("vectorField", "points") + ascii_list([tuple(point) for point in points])
        content["faces"] = header("faceList", "faces") + ascii_faces(faces)
        for name, labels in (("owner", owner), ("neighbour", neighbour)):
            content[name] = header("labelList", name) + ascii_list(list(labels))
    else:
        sign = "<" if order == "LSB" else ">"
        label, scalar = f"{sign}i{binary[0] // 8}", f"{sign}f{binary[1] // 8}"
        arch = f"{order};label={binary[0]};scalar={binary[1]}"
        start = np.concatenate([[0], np.cumsum([len(face) for face in faces])])
        flat = [node for face in faces for node in face]
        content["points"] = header("vectorField", "points", "binary", arch) + binary_list(points, scalar)
        compact = binary_list(start, label) + b"\n" + binary_list(flat, label)
        content["faces"] = header("faceCompactList", "faces", "binary", arch) + compact
        for name, labels in (("owner", owner), ("neighbour", neighbour)):
            content[name] = header("labelList", name, "binary", arch) + binary_list(labels, label)
    for name, data in content.items():
        path = mesh / (f"{name}.gz" if compressed else name)
        path.write_bytes(gzip.compress(data) if compressed else data)
    (mesh / "boundary").write_bytes(boundary(patches))
    return mesh


def write_cube(folder: Path, **options: object) -> Path:
    """Write a case of one hex with two patches; see `write_case`."""
    patches = {"walls": ("wall", 0, 4), "ends": ("patch", 4, 2)}
    return write_case(folder, CUBE, CUBE_FACES, [0] * 6, [], patches, **options)
