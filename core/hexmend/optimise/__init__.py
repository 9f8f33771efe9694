"""Parts of optimisation methods: search directions, line search, linear solvers, and floors of quality."""
