"""The formats of meshes, one module or package each; each registers itself in FORMATS."""
