"""Case of a study that is another program, which is run on each mesh with the nodes of the boundary fixed."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.errors import FileError, HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend.study.peers import PEERS, Peer

#: Share of a task's time limit that the program has; the rest is for reading and measuring.
_SHARE = 0.95


@dataclass(frozen=True)
class PeerCase:
    """Program of a version.

    Parameters
    ----------
    peer : Peer
    version : str
        `Peer.version`: a result of another version is not reused.
    """

    peer: Peer
    version: str

    #: A surface of the study is for methods of Hexmend.
    slides = False

    @property
    def name(self) -> str:
        """Name in tables."""
        return self.peer.title

    @property
    def method(self) -> str:
        """Name of the program."""
        return self.peer.name

    @property
    def parameters(self) -> str:
        """Version of the program."""
        return self.version

    def values(self) -> dict[str, Any]:
        """Return the case as data."""
        return {"peer": self.peer.name, "version": self.version}

    def run(self, mesh: Mesh, max_seconds: float) -> tuple[Mesh, float]:
        """Run the program on a mesh.

        Parameters
        ----------
        mesh : Mesh
            From `bare_mesh`.
        max_seconds : float
            Time limit of the task; 0 for none.

        Returns
        -------
        mesh : Mesh
        seconds : float
            Seconds of its process.

        Raises
        ------
        HexmendError
            If it fails.
        subprocess.TimeoutExpired
            If it exceeds its share of the limit.
        """
        with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
            try:
                points, seconds = self.peer.smooth(mesh, Path(folder), _SHARE * max_seconds or None)
            except FileError as error:  # which is not one of the mesh of the task
                raise HexmendError(f"it left no mesh: {error}") from None
        return mesh.with_points(points), seconds


def read_peer_case(data: Mapping[str, Any]) -> PeerCase:
    """Make a case from its `values`; raises `ParameterError` for a program that is not known."""
    return PeerCase(PEERS[data["peer"]], data["version"])


def bare_mesh(mesh: Mesh) -> Mesh:
    """Return the mesh of linear hexes with the nodes that they use, of which only those of the boundary are fixed."""
    used = np.unique(mesh.hexes)
    return Mesh(mesh.points[used], np.searchsorted(used, mesh.hexes), name=mesh.name)
