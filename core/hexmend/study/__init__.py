"""Studies: comparison of methods, batches, benchmarks, the experiments of the thesis and its claims."""
