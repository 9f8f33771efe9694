"""VTK's formats: legacy (.vtk), XML (.vtu and .pvtu) and HDF5 (.vtkhdf)."""

from hexmend.io.formats.vtk import legacy_reader, pvtu, vtkhdf, vtu

__all__ = ["legacy_reader", "pvtu", "vtkhdf", "vtu"]
