"""Studies: comparison of methods on one mesh, and recipes on many meshes."""
