"""Parts of optimisation methods: search directions, line search, linear solvers, and the max-min problem."""
