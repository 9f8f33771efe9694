// Module with the processor's level, which decides the build of the kernels to load.
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#endif

static const char *level() {
#if defined(_WIN32) && defined(__x86_64__)
    // Clang's __builtin_cpu_supports does not link on Windows. Feature 41 is AVX-512 F, 40 AVX2, 38 SSE 4.2; processors
    // with these have the other features of the level.
    return IsProcessorFeaturePresent(41) ? "v4"
         : IsProcessorFeaturePresent(40) ? "v3"
         : IsProcessorFeaturePresent(38) ? "v2"
                                         : "v1";
#elif defined(__x86_64__) && !defined(__clang__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("x86-64-v4") ? "v4"
         : __builtin_cpu_supports("x86-64-v3") ? "v3"
         : __builtin_cpu_supports("x86-64-v2") ? "v2"
                                               : "v1";
#elif defined(__x86_64__)  // Clang knows levels by name from version 18 on
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

static PyModuleDef processor = {
    PyModuleDef_HEAD_INIT, "_processor", nullptr, -1, nullptr, nullptr, nullptr, nullptr, nullptr};

PyMODINIT_FUNC PyInit__processor() {
    PyObject *module = PyModule_Create(&processor);
    if (module && PyModule_AddStringConstant(module, "LEVEL", level()) < 0) Py_CLEAR(module);
    return module;
}
