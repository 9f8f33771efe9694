"""Parts of optimisation methods: search directions, line search, linear solvers, and the max-min problem."""

from hexmend.aliases import exports

__getattr__ = exports(__name__)
