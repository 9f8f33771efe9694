"""All sections of the benchmark."""

from benchmarks.kernels.iterations import ITERATIONS
from benchmarks.kernels.kernels import KERNELS, PRECONDITIONERS
from benchmarks.mend.boundaries import BOUNDARIES
from benchmarks.mend.default_method import OPTIMA, SIZES, UNTANGLING
from benchmarks.mend.freedom import FREEDOM
from benchmarks.mend.goals import GOALS
from benchmarks.mend.padding import PADDING
from benchmarks.mend.surface_quality import SURFACE_QUALITY
from benchmarks.mend.surfaces import SURFACES
from benchmarks.scale.files import FILES
from benchmarks.scale.memory import MEMORY
from benchmarks.scale.processes import PROCESSES
from benchmarks.scale.scale import SCALE
from benchmarks.scale.scaling import SCALING
from benchmarks.thesis.offsets import OFFSETS
from benchmarks.thesis.remarks import REMARKS
from benchmarks.window.filters import FILTERS
from benchmarks.window.start import START
from benchmarks.window.viewer import VIEWER
from benchmarks.window.views import VIEWS
from benchmarks.window.watching import WATCHING

#: Sections by name, in the order in which they are measured.
SECTIONS = {
    section.name: section
    for section in (
        *(KERNELS, ITERATIONS, PRECONDITIONERS),
        *(PROCESSES, SCALING, SCALE, FILES, MEMORY, SIZES),
        *(OPTIMA, UNTANGLING, GOALS, BOUNDARIES, FREEDOM, SURFACES, SURFACE_QUALITY, PADDING),
        *(OFFSETS, REMARKS),
        *(START, VIEWER, FILTERS, VIEWS, WATCHING),
    )
}
