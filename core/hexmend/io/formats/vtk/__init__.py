"""VTK's formats: legacy (.vtk), XML (.vtu, .pvtu, .vts, .vtr, .vti and .vtm) and HDF5 (.vtkhdf)."""

from hexmend.io.formats.vtk import legacy_reader, pvtu, structured, vtkhdf, vtu

__all__ = ["legacy_reader", "pvtu", "structured", "vtkhdf", "vtu"]
