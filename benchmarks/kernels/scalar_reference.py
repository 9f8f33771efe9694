"""Scalar reference of the kernels, for the build that is loaded; scripts/build-kernels builds it."""

from importlib import import_module

from hexmend import kernels

_native = import_module(f"benchmarks.kernels.scalar_reference_{kernels.BUILD}")
energies, gradient, hessian_product, sweep = (
    getattr(_native, name) for name in ("energies", "gradient", "hessian_product", "sweep")
)
