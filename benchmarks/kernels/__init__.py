"""Speed of the kernels, of iterations and of linear solvers."""
