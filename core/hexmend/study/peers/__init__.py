"""Programs that smooth hexahedral meshes, one module each; Hexmend itself is one of them."""

from hexmend.registry import Registry
from hexmend.study.peers.gmsh import GMSH
from hexmend.study.peers.hexmend_program import FIXED, SHAPE, SLIDE
from hexmend.study.peers.hexsmoothing import HEXSMOOTHING
from hexmend.study.peers.mesquite import MESQUITE
from hexmend.study.peers.peer import MissingPeer, Peer
from hexmend.study.peers.tmop import TMOP

#: All programs by name, in the order of tables.
PEERS: Registry[Peer] = Registry("program")

#: Runs of Hexmend itself.
OWN = FIXED, SLIDE, SHAPE

for _peer in (*OWN, HEXSMOOTHING, TMOP, GMSH, MESQUITE):
    PEERS.add(_peer.name, _peer)

__all__ = ["OWN", "PEERS", "MissingPeer", "Peer"]
