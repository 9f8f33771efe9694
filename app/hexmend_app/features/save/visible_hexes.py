"""Export of some hexes as a mesh."""

from __future__ import annotations

from pathlib import Path

from hexmend.doctor.removal import extract_hexes
from hexmend.errors import ParameterError
from hexmend.io import unsupported_data, write
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.number_ranges import mask_of, parse_ranges


def write_hexes(path: str | Path, mesh: Mesh, hexes: str) -> list[str]:
    """Write some hexes of a mesh as a mesh, with their nodes, sets, data and materials.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format.
    mesh : Mesh
    hexes : str
        Ranges of numbers from 0, for example "0-120, 130".

    Returns
    -------
    list of str
        What the file does not store of these hexes, in words; see `hexmend.io.unsupported_data`.

    Raises
    ------
    FileError
        For an unknown suffix, and where the file cannot be written; an existing file is left unchanged.
    ParameterError
        For invalid ranges, and a hex that does not exist in the mesh.
    """
    try:
        ranges = parse_ranges(hexes)
    except ValueError as error:
        raise ParameterError(f"hexes: {error}") from None
    if ranges[-1][1] >= mesh.n_hexes:
        raise ParameterError(f"there is no hex {ranges[-1][1]:,}: expected one of the mesh, below {mesh.n_hexes:,}")
    part = extract_hexes(mesh, mask_of(ranges, mesh.n_hexes))
    write(path, part)
    return unsupported_data(path, part)
