// Which build of the kernels this processor can run: asked before any of them is loaded.
#define PY_SSIZE_T_CLEAN
#include <Python.h>

static const char *level(void) {
#if defined(__x86_64__) || defined(_M_X64)
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("ssse3") || !__builtin_cpu_supports("popcnt"))
        return "v1";
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi") ||
        !__builtin_cpu_supports("bmi2"))
        return "v2";
    if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512bw") ||
        !__builtin_cpu_supports("avx512cd") || !__builtin_cpu_supports("avx512dq") ||
        !__builtin_cpu_supports("avx512vl"))
        return "v3";
    return "v4";
#else
    return "native";
#endif
}

static struct PyModuleDef processor = {PyModuleDef_HEAD_INIT, "_processor", NULL, -1, NULL, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit__processor(void) {
    PyObject *module = PyModule_Create(&processor);
    if (module && PyModule_AddStringConstant(module, "LEVEL", level()) < 0) Py_CLEAR(module);
    return module;
}
