"""Laplacian smoothing and smart Laplacian smoothing."""
