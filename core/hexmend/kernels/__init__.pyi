"""Compiled kernels: functions of arrays and of views of arrays. Written by scripts/kernel_stubs.py."""

from hexmend.kernels import assembly as assembly
from hexmend.kernels import closest_point as closest_point
from hexmend.kernels import conjugate_gradients as conjugate_gradients
from hexmend.kernels import decimals as decimals
from hexmend.kernels import element_step as element_step
from hexmend.kernels import elements as elements
from hexmend.kernels import faces as faces
from hexmend.kernels import floor_barrier as floor_barrier
from hexmend.kernels import getme as getme
from hexmend.kernels import hex_mesh as hex_mesh
from hexmend.kernels import incidence as incidence
from hexmend.kernels import laplacian as laplacian
from hexmend.kernels import line_search as line_search
from hexmend.kernels import local as local
from hexmend.kernels import metrics as metrics
from hexmend.kernels import objective as objective
from hexmend.kernels import occlusion as occlusion
from hexmend.kernels import ordering as ordering
from hexmend.kernels import patches as patches
from hexmend.kernels import skin as skin
from hexmend.kernels import sliding_surface as sliding_surface
from hexmend.kernels import sparsity as sparsity
from hexmend.kernels import step_limits as step_limits
from hexmend.kernels import structure as structure
from hexmend.kernels import surface_fit as surface_fit
from hexmend.kernels import target as target
from hexmend.kernels import validity as validity
from hexmend.kernels import wavefronts as wavefronts
from hexmend.kernels import worst_first as worst_first

BUILD: str
BUILDS: tuple[str, ...]
LANES: int

def threads() -> int: ...
def set_threads(count: int) -> None: ...
def release_free_memory() -> None: ...
def return_freed_arrays() -> None: ...
