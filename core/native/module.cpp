// The extension module; each family of kernels is a submodule. HEXMEND_MODULE is the name of the build, after the
// processors that it is for. Arguments and results of kernels are described where they are bound, in bindings.
#include <nanobind/nanobind.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "simd/lanes.hpp"
#include "simd/threads.hpp"

namespace nb = nanobind;

#define HEXMEND_FAMILIES(family)                                                                                       \
    family(hex_mesh) family(line_search) family(target) family(assembly) family(closest_point)                         \
        family(conjugate_gradients) family(sparsity) family(decimals) family(element_step) family(floor_barrier)       \
            family(elements) family(faces) family(getme) family(incidence) family(laplacian) family(patches)           \
                family(local) family(metrics) family(objective) family(occlusion) family(ordering) family(step_limits) \
                    family(skin) family(sliding_surface) family(surface_fit) family(structure) family(validity)        \
                        family(wavefronts) family(worst_first)

namespace hexmend {
#define DECLARE(name) void bind_##name(nb::module_);
HEXMEND_FAMILIES(DECLARE)
}  // namespace hexmend

NB_MODULE(HEXMEND_MODULE, m) {
    using namespace nb::literals;
    nb::set_leak_warnings(false);  // objects of meshes may live until the process ends
    m.attr("LANES") = hexmend::LANES;
    m.def(
        "release_free_memory",
        [] {
#ifdef __GLIBC__
            malloc_trim(0);
#endif
        },
        "Return free memory that the allocator retains to the system, where the C library can.",
        nb::call_guard<nb::gil_scoped_release>());
    m.def(
        "return_freed_arrays",
        [] {
#ifdef __GLIBC__
            mallopt(M_MMAP_THRESHOLD, 4 << 20);
            mallopt(M_TRIM_THRESHOLD, 32 << 20);  // it no longer adapts, and smaller arrays would come anew each time
#endif
        },
        "From now on return arrays of 4 MiB and more to the system when they are freed, where the C library can.\n\n"
        "Others may fill their place only in part, and a process would hold more than it needs.");
    m.def("threads", &hexmend::threads, "Number of threads that run a loop of the calling thread.");
    m.def("set_threads", &hexmend::set_threads, "count"_a, "Set the number of threads of the calling thread.");
    m.def("set_default_threads", &hexmend::set_default_threads, "count"_a,
          "Set the number for threads that have not set one.");
#define BIND(name) hexmend::bind_##name(m.def_submodule(#name));
    HEXMEND_FAMILIES(BIND)
}
