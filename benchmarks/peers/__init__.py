"""Programs that smooth hexahedral meshes, one module each; Hexmend itself is one of them."""

from benchmarks.peers.gmsh import GMSH
from benchmarks.peers.hexmend_program import FIXED, SHAPE, SLIDE
from benchmarks.peers.hexsmoothing import HEXSMOOTHING
from benchmarks.peers.mesquite import MESQUITE
from benchmarks.peers.tmop import TMOP

#: All programs in the order of tables; the runs of Hexmend first.
PEERS = FIXED, SLIDE, SHAPE, HEXSMOOTHING, TMOP, GMSH, MESQUITE
