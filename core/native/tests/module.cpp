// Extension module of the native functions that only tests call. Wheels do not contain it.
#include <nanobind/nanobind.h>

namespace nb = nanobind;

#define HEXMEND_TEST_FAMILIES(family) \
    family(barrier) family(element_step) family(hexahedron) family(symmetric) family(tournament)

namespace hexmend {
#define DECLARE(name) void bind_##name(nb::module_ &);
HEXMEND_TEST_FAMILIES(DECLARE)
}  // namespace hexmend

NB_MODULE(hexmend_test_kernels, m) {
#define BIND(name)                                   \
    {                                                \
        nb::module_ family = m.def_submodule(#name); \
        hexmend::bind_##name(family);                \
    }
    HEXMEND_TEST_FAMILIES(BIND)
}
